// SPDX-License-Identifier: MIT
//
// Recorded runs made by hand: a tree, a script that says what its leaves
// answer, and the steps that the paper's automata would take. Simple semantics,
// no search: for tests of what shows runs, not of what finds them.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// What a leaf does when it is ticked.
struct LeafAnswer {
  Phase phase = Phase::Success;  // Running, Success or Failure
  bool is_chosen = false;
  std::size_t variable = kNoState;  // that it sets
  std::string value = {};
};

class HandMadeRun {
 public:
  // The leaf's number, and which tick it is.
  using Script = std::function<LeafAnswer(std::uint32_t, int)>;
  // The truth of the run's atoms in a state.
  using Atoms = std::function<std::vector<bool>(const RecordedState&)>;

  // `about` has everything but states.
  HandMadeRun(RecordedRun about, std::vector<std::string> initial_values,
              Script script)
      : run_(std::move(about)),
        script_(std::move(script)),
        children_(run_.nodes.size()),
        next_(run_.nodes.size()) {
    for (std::uint32_t n = 0; n < run_.nodes.size(); ++n) {
      if (run_.nodes[n].parent) children_[*run_.nodes[n].parent].push_back(n);
    }
    now_.phases.resize(run_.nodes.size(), Phase::Unvisited);
    now_.is_stale.resize(run_.nodes.size());
    now_.statuses.resize(run_.nodes.size(), "no_ret_status");
    now_.locations.resize(run_.nodes.size(), "start_");
    now_.values = std::move(initial_values);
    now_.step = "start";
    run_.states.push_back(now_);
  }

  // The whole tree, once.
  void tick() {
    ++now_.tick;
    for (std::uint32_t n = 0; n < run_.nodes.size(); ++n) {
      now_.is_stale[n] = now_.phases[n] != Phase::Unvisited;
    }
    begin(0);
    ++now_.time;
    take("time passes", std::nullopt);
    work(0);
    now_.phases[0] = answered_;
    const bool is_over = answered_ != Phase::Running;
    const std::string word = text(answered_);
    now_.statuses[0] = word;
    move(0, word, "", is_over ? run_.nodes[0].name + " -> " + word : "");
    if (!is_over) move(0, "start_");
  }

  std::size_t last() const { return run_.states.size() - 1; }
  // The first state after `from` that the event led to.
  std::size_t where(std::string_view event, std::size_t from = 0) const {
    for (std::size_t i = from; i < run_.states.size(); ++i) {
      if (run_.states[i].event == event) return i;
    }
    return kNoState;
  }
  std::size_t first_of_tick(int tick) const {
    std::size_t i = 0;
    while (run_.states[i].tick != tick) ++i;
    return i;
  }

  // The run, cut to so many states.
  RecordedRun finished(std::size_t count = kNoState,
                       const Atoms& atoms = {}) const {
    RecordedRun run = run_;
    run.states.resize(std::min(count, run.states.size()));
    for (RecordedState& state : run.states) {
      if (atoms) state.atoms = atoms(state);
      state.atoms.resize(run.atoms.size());
    }
    return run;
  }

 private:
  static std::string text(Phase phase) {
    return std::string(kPhaseNames[static_cast<std::size_t>(phase)]);
  }
  const std::string& key(std::uint32_t node) const {
    return run_.nodes[node].key;
  }
  std::string short_name(std::uint32_t node) const {
    const auto bearers = std::count_if(
        run_.nodes.begin(), run_.nodes.end(), [&](const RecordedNode& other) {
          return other.name == run_.nodes[node].name;
        });
    return bearers == 1 ? run_.nodes[node].name
                        : run_.nodes[node].name + "@" +
                              std::to_string(run_.nodes[node].line);
  }

  void take(std::string step, std::optional<std::uint32_t> mover,
            std::string event = "", bool is_chosen = false) {
    now_.step = std::move(step);
    now_.mover = mover;
    now_.event = std::move(event);
    now_.is_chosen = is_chosen;
    run_.states.push_back(now_);
  }
  void move(std::uint32_t node, const std::string& to,
            const std::string& updates = "", std::string event = "",
            bool is_chosen = false) {
    const std::string from = std::exchange(now_.locations[node], to);
    take(key(node) + ": " + from + " -> " + to + updates, node,
         std::move(event), is_chosen);
  }

  void begin(std::uint32_t node) {
    now_.phases[node] = Phase::Here;
    now_.is_stale[node] = false;
    now_.statuses[node] = "no_ret_status";
    move(node, "tick_node", ", " + key(node) + ".rstatus := no_ret_status");
  }

  // Ticks a child; what it answered is in answered_.
  void call(std::uint32_t parent, std::uint32_t child) {
    move(parent, key(child));
    now_.phases[parent] = Phase::Waiting;
    now_.phases[child] = Phase::Here;
    now_.is_stale[child] = false;
    move(parent, key(child) + "_done",
         ", " + key(child) + ".caller := " + key(parent));
    begin(child);
    work(child);
    const std::string word = text(answered_);
    now_.statuses[child] = word;
    move(child, "done", ", " + key(child) + ".rstatus := " + word);
    now_.phases[child] = answered_;
    now_.phases[parent] = Phase::Here;
    move(child, "start_", ", " + key(child) + ".caller := None");
  }

  // From tick_node to the node's answer.
  void work(std::uint32_t node) {
    if (children_[node].empty()) return answer(node);
    const std::string& type = run_.nodes[node].type;
    if (type == "Parallel" || type == "ParallelAll") {
      work_parallel(node);
    } else if (type == "ForceFailure") {
      call(node, children_[node][0]);
      if (answered_ == Phase::Success) answered_ = Phase::Failure;
    } else if (type == "Repeat") {
      work_repeat(node);
    } else {
      work_in_turn(node);
    }
    if (node != 0) move(node, text(answered_));
  }

  void answer(std::uint32_t leaf) {
    const LeafAnswer found = script_(leaf, now_.tick);
    answered_ = found.phase;
    const std::string word = text(found.phase);
    std::string event = short_name(leaf) + " -> " + word;
    std::string update;
    if (found.variable != kNoState) {
      now_.values[found.variable] = found.value;
      const std::string assigned =
          run_.variables[found.variable] + " := " + found.value;
      event = short_name(leaf) + ": " + assigned;
      update = ", " + assigned;
    }
    move(leaf, word, update, event, found.is_chosen);
  }

  void work_in_turn(std::uint32_t node) {
    const std::string& type = run_.nodes[node].type;
    const bool is_reactive = type.rfind("Reactive", 0) == 0;
    const Phase goes_on = type.find("Fallback") == std::string::npos
                              ? Phase::Success
                              : Phase::Failure;
    const auto& children = children_[node];
    std::size_t& next = next_[node];
    if (is_reactive) next = 0;
    for (; next < children.size(); ++next) {
      call(node, children[next]);
      if (answered_ == goes_on) continue;
      for (std::size_t k = next + 1; is_reactive && k < children.size(); ++k) {
        if (now_.phases[children[k]] == Phase::Running) halt(children[k]);
      }
      if (answered_ != Phase::Running) next = 0;
      return;
    }
    next = 0;
  }

  void work_parallel(std::uint32_t node) {
    const bool one_is_enough = run_.nodes[node].type == "Parallel";
    std::size_t succeeded = 0;
    bool is_running = false;
    for (const std::uint32_t child : children_[node]) {
      call(node, child);
      succeeded += answered_ == Phase::Success;
      is_running |= answered_ == Phase::Running;
    }
    const std::size_t wanted = one_is_enough ? 1 : children_[node].size();
    answered_ = succeeded >= wanted ? Phase::Success
                : is_running        ? Phase::Running
                                    : Phase::Failure;
  }

  void work_repeat(std::uint32_t node) {
    for (; next_[node] < 3; ++next_[node]) {
      call(node, children_[node][0]);
      if (answered_ != Phase::Success) break;
    }
    if (answered_ != Phase::Running) next_[node] = 0;
  }

  void halt(std::uint32_t node) {
    const Phase kept = answered_;
    now_.phases[node] = Phase::Halting;
    now_.is_stale[node] = false;
    next_[node] = 0;
    now_.statuses[node] = "halt_me";
    move(node, "halt");
    for (const std::uint32_t child : children_[node]) {
      if (now_.phases[child] == Phase::Running) halt(child);
    }
    const bool is_leaf = children_[node].empty();
    move(node, "halted", "", is_leaf ? short_name(node) + " is halted" : "");
    now_.phases[node] = Phase::Halted;
    now_.statuses[node] = "halted";
    move(node, "start_", ", " + key(node) + ".caller := None");
    answered_ = kept;
  }

  RecordedRun run_;
  Script script_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::size_t> next_;  // by node: the child whose turn it is
  RecordedState now_;
  Phase answered_ = Phase::Unvisited;
};

}  // namespace btcheck
