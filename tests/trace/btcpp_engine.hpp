// SPDX-License-Identifier: MIT
//
// A small executor that does what BehaviorTree.CPP 4.10 does (executeTick,
// haltNode, resetChildren and the tick of each node type, without the yields of
// its Repeat and SequenceWithMemory), tells every change of a status as its
// loggers would, and records the phases of the nodes along the way. So there is
// a run of btcheck's kind and, from another hand, the log that belongs to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "trace/logs/behavior_log.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

class BtcppEngine {
 public:
  // What a leaf answers when it is ticked.
  using World = std::function<LogStatus(std::uint32_t leaf)>;
  struct Event {
    std::uint32_t node;
    LogStatus status;
    friend bool operator==(const Event&, const Event&) = default;
  };

  BtcppEngine() {
    run_.tree = "t.btf";
    run_.property = "p";
    run_.formula = "[] a";
    run_.verdict = "VIOLATED";
    run_.ticks = "root";
    add("BehaviorTree", "main", {});
  }

  // The new node's number. The tree has one top node, number 1.
  std::uint32_t add(const std::string& type, const std::string& name,
                    std::optional<std::uint32_t> parent) {
    const auto number = static_cast<std::uint32_t>(run_.nodes.size());
    RecordedNode node;
    node.key = name + "_btn" + std::to_string(number);
    node.type = type;
    node.name = name;
    node.line = number + 1;
    node.column = 1;
    node.parent = parent;
    run_.nodes.push_back(node);
    nodes_.emplace_back();
    if (parent) nodes_[*parent].children.push_back(number);
    return number;
  }

  // One tick of the whole tree.
  LogStatus tick(const World& world) {
    if (run_.states.empty()) record("start");
    world_ = &world;
    ++tick_;
    nodes_[0].is_active = true;
    record("the root is ticked");
    const LogStatus answer = execute(1);
    if (is_completed(answer)) set(1, LogStatus::Idle);
    nodes_[0].is_active = false;
    nodes_[0].last = phase_of(answer);
    nodes_[0].last_tick = tick_;
    record("the tick ends");
    return answer;
  }

  RecordedRun& run() { return run_; }
  const std::vector<Event>& events() const { return events_; }
  const std::vector<std::uint32_t>& children(std::uint32_t node) const {
    return nodes_[node].children;
  }

 private:
  struct State {
    std::vector<std::uint32_t> children;
    LogStatus status = LogStatus::Idle;
    std::size_t next = 0;  // the child, or how often it was repeated
    bool is_active = false;
    bool is_halting = false;
    Phase last = Phase::Unvisited;
    int last_tick = 0;
  };

  static Phase phase_of(LogStatus status) {
    if (status == LogStatus::Success) return Phase::Success;
    if (status == LogStatus::Failure) return Phase::Failure;
    return Phase::Running;
  }

  const std::string& type(std::uint32_t node) const {
    return run_.nodes[node].type;
  }

  void record(const std::string& step,
              std::optional<std::uint32_t> mover = {}) {
    RecordedState state;
    state.time = tick_;
    state.tick = tick_;
    state.step = step;
    state.mover = mover;
    if (mover && nodes_[*mover].children.empty()) {
      state.event = step;
      state.is_chosen = true;
    }
    for (const State& node : nodes_) {
      Phase phase = node.last;
      if (node.is_active) {
        bool waits = false;
        for (const std::uint32_t child : node.children) {
          waits |= nodes_[child].is_active;
        }
        phase = waits ? Phase::Waiting : Phase::Here;
        if (node.is_halting) phase = Phase::Halting;
      }
      state.phases.push_back(phase);
      state.is_stale.push_back(!node.is_active &&
                               node.last != Phase::Unvisited &&
                               node.last_tick < tick_);
      state.statuses.emplace_back();
      state.locations.emplace_back();
    }
    state.values.resize(run_.variables.size());
    run_.states.push_back(std::move(state));
  }

  void set(std::uint32_t node, LogStatus status) {
    if (nodes_[node].status == status) return;
    nodes_[node].status = status;
    events_.push_back({node, status});
  }

  LogStatus execute(std::uint32_t node) {
    nodes_[node].is_active = true;
    record("a node is ticked");
    const LogStatus answer = tick_node(node);
    set(node, answer);
    nodes_[node].is_active = false;
    nodes_[node].last = phase_of(answer);
    nodes_[node].last_tick = tick_;
    record(run_.nodes[node].name + " -> " +
               std::string(
                   kPhaseNames[static_cast<std::size_t>(phase_of(answer))]),
           node);
    return answer;
  }

  void reset(std::uint32_t node) {
    if (nodes_[node].status == LogStatus::Running) halt(node);
    set(node, LogStatus::Idle);
  }

  void halt(std::uint32_t node) {
    nodes_[node].is_active = nodes_[node].is_halting = true;
    record("a node is halted");
    reset_children(node);
    if (type(node) != "SequenceWithMemory") nodes_[node].next = 0;
    set(node, LogStatus::Idle);
    nodes_[node].is_active = nodes_[node].is_halting = false;
    nodes_[node].last = Phase::Halted;
    nodes_[node].last_tick = tick_;
    record("a node has been halted", node);
  }

  void reset_children(std::uint32_t node, std::size_t first = 0) {
    for (std::size_t i = first; i < nodes_[node].children.size(); ++i) {
      reset(nodes_[node].children[i]);
    }
  }

  LogStatus tick_node(std::uint32_t node) {
    if (nodes_[node].children.empty()) return (*world_)(node);
    set(node, LogStatus::Running);
    const std::string& word = type(node);
    if (word.starts_with("Reactive")) return tick_reactive(node);
    if (word == "ParallelAll") return tick_parallel(node);
    if (nodes_[node].children.size() == 1 && word != "Sequence" &&
        word != "Fallback" && word != "SequenceWithMemory") {
      return tick_decorator(node);
    }
    return tick_row(node);
  }

  // What lets a row go on, of a Sequence or a Fallback.
  LogStatus going_on(std::uint32_t node) const {
    return type(node).find("Fallback") != std::string::npos
               ? LogStatus::Failure
               : LogStatus::Success;
  }

  LogStatus tick_row(std::uint32_t node) {
    State& here = nodes_[node];
    while (here.next < here.children.size()) {
      const LogStatus answer = execute(here.children[here.next]);
      if (answer == LogStatus::Running) return answer;
      if (answer == going_on(node)) {
        ++here.next;
        continue;
      }
      if (type(node) == "SequenceWithMemory") {
        reset_children(node, here.next);
      } else {
        reset_children(node);
        here.next = 0;
      }
      return answer;
    }
    reset_children(node);
    here.next = 0;
    return going_on(node);
  }

  LogStatus tick_reactive(std::uint32_t node) {
    for (const std::uint32_t child : nodes_[node].children) {
      const LogStatus answer = execute(child);
      if (answer == going_on(node)) continue;
      if (answer != LogStatus::Running) {
        reset_children(node);
        return answer;
      }
      for (const std::uint32_t other : nodes_[node].children) {
        if (other != child) reset(other);
      }
      return answer;
    }
    reset_children(node);
    return going_on(node);
  }

  LogStatus tick_parallel(std::uint32_t node) {
    bool runs = false;
    bool fails = false;
    for (const std::uint32_t child : nodes_[node].children) {
      LogStatus answer = nodes_[child].status;
      if (!is_completed(answer)) answer = execute(child);
      runs |= answer == LogStatus::Running;
      fails |= answer == LogStatus::Failure;
    }
    if (runs) return LogStatus::Running;
    reset_children(node);
    return fails ? LogStatus::Failure : LogStatus::Success;
  }

  LogStatus tick_decorator(std::uint32_t node) {
    State& here = nodes_[node];
    const std::string& word = type(node);
    for (;;) {
      const LogStatus answer = execute(here.children[0]);
      if (answer == LogStatus::Running) return answer;
      reset(here.children[0]);
      const bool is_success = answer == LogStatus::Success;
      if (word == "Inverter") {
        return is_success ? LogStatus::Failure : LogStatus::Success;
      }
      if (word == "ForceSuccess") return LogStatus::Success;
      if (word == "KeepRunningUntilFailure" && is_success) {
        return LogStatus::Running;
      }
      if (word == "Repeat" && is_success && ++here.next < 2) continue;
      here.next = 0;
      return answer;
    }
  }

  RecordedRun run_;
  std::vector<State> nodes_;
  std::vector<Event> events_;
  const World* world_ = nullptr;
  int tick_ = 0;
};

// A tree of up to so many nodes below the root, all kinds of them.
inline void add_random_tree(BtcppEngine& engine, std::mt19937& random,
                            std::uint32_t parent, std::size_t& left) {
  static const char* const kRows[] = {"Sequence",           "Fallback",
                                      "SequenceWithMemory", "ReactiveSequence",
                                      "ReactiveFallback",   "ParallelAll"};
  static const char* const kDecorators[] = {"Inverter", "ForceSuccess",
                                            "KeepRunningUntilFailure", "Repeat",
                                            "SubTree"};
  const auto number = std::to_string(engine.run().nodes.size());
  if (left > 0) --left;
  const auto choice = random() % 10;
  if (left == 0 || choice < 3) {
    const bool is_condition = random() % 3 == 0;
    engine.add(is_condition ? "Condition" : "Action", "leaf" + number, parent);
  } else if (choice < 5) {
    const auto node =
        engine.add(kDecorators[random() % 5], "decorator" + number, parent);
    add_random_tree(engine, random, node, left);
  } else {
    const auto node = engine.add(kRows[random() % 6], "row" + number, parent);
    const auto count = 1 + random() % 4;
    for (std::size_t i = 0; i < count; ++i) {
      add_random_tree(engine, random, node, left);
    }
  }
}

// A tree and some ticks of it. Conditions never run; the node of a ParallelAll
// that has one child is a row here and a Control in the log.
inline BtcppEngine random_execution(std::mt19937& random) {
  BtcppEngine engine;
  std::size_t left = 2 + random() % 20;
  add_random_tree(engine, random, 0, left);
  const BtcppEngine::World world = [&](std::uint32_t leaf) {
    const bool may_run = engine.run().nodes[leaf].type == "Action";
    return static_cast<LogStatus>(may_run ? 1 + random() % 3
                                          : 2 + random() % 2);
  };
  const auto ticks = 1 + random() % 8;
  for (std::size_t i = 0; i < ticks; ++i) engine.tick(world);
  return engine;
}

// Any phases at all, sensible or not.
inline RecordedRun random_phases(std::mt19937& random) {
  BtcppEngine engine;
  std::size_t left = 2 + random() % 10;
  add_random_tree(engine, random, 0, left);
  RecordedRun run = engine.run();
  const std::size_t count = 1 + random() % 30;
  int tick = 0;
  for (std::size_t i = 0; i < count; ++i) {
    RecordedState state;
    tick += random() % 4 == 0;
    state.tick = tick;
    for (std::size_t n = 0; n < run.nodes.size(); ++n) {
      const bool stays = i > 0 && random() % 2 == 0;
      state.phases.push_back(stays ? run.states[i - 1].phases[n]
                                   : static_cast<Phase>(random() % 8));
      state.is_stale.push_back(random() % 4 == 0);
      state.statuses.emplace_back();
      state.locations.emplace_back();
    }
    run.states.push_back(std::move(state));
  }
  if (random() % 2 == 0) run.loop = random() % count;
  return run;
}

}  // namespace btcheck
