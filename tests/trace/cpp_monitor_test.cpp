// SPDX-License-Identifier: MIT
//
// Monitors as C++, compiled and run: of each log they say what `trace --prop`
// says of it.
#include "trace/watch/cpp_monitor.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "check/simulate/simulation.hpp"
#include "model/btf_text.hpp"
#include "model/lowering.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"
#include "trace/run/record.hpp"
#include "trace/watch/monitor_table.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck::cpp_monitor_test {
namespace {

// Reads "tick UNITS", "end" and "NODE BEFORE AFTER", and "log", at which it
// says what became of the rules; with a number as argument, how long an event
// takes.
constexpr std::string_view kDriver =
    R"cpp(#include "monitor.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

          using btcheck_monitor::Monitor;
          using btcheck_monitor::Status;

          int main(int argc, char** argv) {
            struct Event {
              int kind;
              std::uint64_t a, b, c;
            };
            std::vector<std::vector<Event>> logs(1);
            for (std::string word; std::cin >> word;) {
              Event event{};
              if (word == "log") {
                logs.emplace_back();
                continue;
              }
              if (word == "end") event.kind = 1;
              if (word == "tick") {
                event.kind = 0;
                std::cin >> event.a;
              }
              if (word != "end" && word != "tick") {
                event.kind = 2;
                event.a = std::stoull(word);
                std::cin >> event.b >> event.c;
              }
              logs.back().push_back(event);
            }
            logs.pop_back();
            const int rounds = argc > 1 ? std::atoi(argv[1]) : 1;
            std::size_t events = 0;
            std::size_t told = 0;
            const auto begin = std::chrono::steady_clock::now();
            for (int round = 0; round < rounds; ++round) {
              for (const auto& log : logs) {
                Monitor monitor;
                monitor.on_verdict = [&](std::size_t,
                                         btcheck_monitor::Verdict) { ++told; };
                for (const Event& event : log) {
                  if (event.kind == 0) monitor.begin_tick(event.a);
                  if (event.kind == 1) monitor.end_tick();
                  if (event.kind == 2) {
                    monitor.change(event.a, static_cast<Status>(event.b),
                                   static_cast<Status>(event.c));
                  }
                }
                events += log.size();
                if (rounds > 1) continue;
                for (std::size_t r = 0; r < Monitor::rule_count(); ++r) {
                  std::cout << static_cast<int>(monitor.verdict(r));
                }
                std::cout << "\n";
              }
            }
            if (rounds > 1) {
              const std::chrono::duration<double, std::nano> spent =
                  std::chrono::steady_clock::now() - begin;
              std::printf("%.0f ns per event, %zu rules\n",
                          spent.count() / events, Monitor::rule_count());
            }
            return told == SIZE_MAX;
          }
    )cpp";

constexpr std::string_view kRules = R"(
property low: never land@23.failure
property at_once:
  whenever start_drone.success then takeoff.success within 0 ticks
property takes_off: takeoff.success precedes goto_waypoint@39.ticked
property watched:
  whenever goto_waypoint@27.ticked then measure_battery.ticked within 1 ticks
property tick_rule: in no tick: start_drone.answer == failure
property answers: never measure_battery.running
property past: never land@46.ticked and not once takeoff.success
property left: never goto_waypoint@39.halted
property can: possible root.success
property starts: (not root.failure) U start_drone.success
property works: always (camera_track.status == running => camera_track.active)
property above: Fallback18.ticked precedes measure_battery.ticked
property begins: Repeat36.ticked precedes goto_waypoint@39.ticked
property calls: whenever Fallback18.ticked then fail@19.ticked within 0 ticks
property order: in no tick: localization_ok.answered failure and previously localization_ok.answered failure
)";

// As a logger of the engine would have written it: not at our times.
BehaviorLog some_log(const BehaviorTree& tree, const Network& network,
                     std::uint64_t seed) {
  Simulation simulation(tree, network, Interleaving::Open);
  SplitMix64 random(seed);
  while (simulation.end() == RunEnd::None &&
         simulation.ticks(tree.roots[0]) <= 12) {
    simulation.take(random_choice(simulation.choices(), random));
  }
  const RecordedRun run = recorded(tree, network, simulation.run(), {});
  auto log = read_log("a.btlog", btlog_bytes(run, 1));
  REQUIRE(log.value);
  log.value->begin += 1;
  return std::move(*log.value);
}

// As if every leaf that answers at once were a SimpleActionNode, which is
// RUNNING before it calls its function.
BehaviorLog with_simple_actions(BehaviorLog log) {
  std::vector<LogTransition> records;
  for (LogTransition record : log.transitions) {
    const bool is_leaf = std::ranges::none_of(
        log.nodes,
        [&](const LogNode& node) { return node.parent == record.uid; });
    if (is_leaf && is_completed(record.after) &&
        record.before != LogStatus::Running) {
      records.push_back(
          {record.time, record.uid, record.before, LogStatus::Running});
      record.before = LogStatus::Running;
    }
    records.push_back(record);
  }
  log.transitions = std::move(records);
  return log;
}

bool is_below(const BehaviorLog& log, std::uint16_t uid, std::uint16_t above) {
  const LogNode* node = log.find(uid);
  while (node->uid != above && node->parent) node = log.find(*node->parent);
  return node->uid == above;
}

// As if every node with children were a Switch, which sets no RUNNING before
// its child is ticked: its record comes when its tick returns.
BehaviorLog with_late_parents(BehaviorLog log) {
  std::vector<LogTransition> records;
  std::vector<LogTransition> held;  // outermost first
  TickCounter ticks(log, {.tick_time = kTickTime});
  std::int64_t tick = 0;
  for (LogTransition record : log.transitions) {
    const std::int64_t now = ticks.tick_at(record.time);
    while (
        !held.empty() &&
        (now != tick || !is_below(log, record.uid, held.back().uid) ||
         (held.back().uid == record.uid && record.after == LogStatus::Idle))) {
      held.back().time = records.back().time;
      records.push_back(held.back());
      held.pop_back();
    }
    tick = now;
    const bool is_parent = std::ranges::any_of(
        log.nodes,
        [&](const LogNode& node) { return node.parent == record.uid; });
    if (is_parent && record.after == LogStatus::Running) {
      held.push_back(record);
      continue;
    }
    if (!held.empty() && held.back().uid == record.uid) {
      record.before = held.back().before;
      held.pop_back();
    }
    records.push_back(record);
  }
  for (; !held.empty(); held.pop_back()) {
    held.back().time = records.back().time;
    records.push_back(held.back());
  }
  log.transitions = std::move(records);
  return log;
}

std::string events_of(const BehaviorLog& log) {
  std::string text;
  TickCounter ticks(log, {.tick_time = kTickTime});
  std::int64_t tick = 0;
  bool has_ended = false;
  for (const LogTransition& record : log.transitions) {
    const std::int64_t now = ticks.tick_at(record.time);
    if (now != tick) text += fmt::format("tick {}\n", now - tick);
    if (now != tick) has_ended = false;
    tick = now;
    text +=
        fmt::format("{} {} {}\n", record.uid, static_cast<int>(record.before),
                    static_cast<int>(record.after));
    const LogNode* node = log.find(record.uid);
    has_ended |= !node->parent && is_completed(record.after);
  }
  return text + (has_ended ? "end\nlog\n" : "log\n");
}

TEST_CASE("monitors as C++ say of logs what trace says") {
  const InputFile file{"drone3.btf", example("drone3.btf")};
  const TreeInput input(file);
  auto tree = read_tree(file.name, file.text, {});
  REQUIRE(tree.value);
  const Network network = lower(*tree.value, TickSemantics::Root);
  const auto rules = read_properties("r.ltl", std::string(kRules));
  REQUIRE(rules.value);
  const SourceText source("r.ltl", kRules);
  const RecordedRun nodes = recorded_tree(*tree.value, input);
  const auto table = monitor_table(*tree.value, nodes, *rules.value, source);
  for (const Diagnostic& found : table.diagnostics) MESSAGE(render(found));
  REQUIRE(table.value);

  const TemporaryFolder folder;
  std::ofstream(folder.path() / "monitor.hpp") << cpp_monitor(*table.value, "");
  std::ofstream(folder.path() / "main.cpp") << kDriver;
  // A monitor is told the ticks, so the log is read with them.
  const LogReading reading{kTickTime, true, kTickPause};
  std::string events;
  std::string expected;
  int decided = 0;
  std::size_t added = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const BehaviorLog log = some_log(*tree.value, network, seed);
    const BehaviorLog simple = with_simple_actions(log);
    const BehaviorLog late = with_late_parents(log);
    added += simple.transitions.size() - log.transitions.size();
    events += events_of(log) + events_of(simple) + events_of(late);
    // The lines of the tree are not in its log: rules are asked by its names.
    for (std::size_t n = 0; n < log.nodes.size(); ++n) {
      REQUIRE(log.nodes[n].uid == n + 1);
    }
    const auto told =
        watch_log_as(nodes, "a.btlog", log, reading, *rules.value, source);
    REQUIRE(told.value);
    std::string outlooks;
    for (const WatchedRule& rule : told.value->rules) {
      outlooks += static_cast<char>('0' + static_cast<int>(rule.outlook));
      decided += rule.outlook != Outlook::Open;
    }
    outlooks += '\n';
    expected += outlooks + outlooks + outlooks;
    for (const BehaviorLog* respelt : {&simple, &late}) {
      CAPTURE(respelt == &late);
      const auto same = watch_log_as(nodes, "a.btlog", *respelt, reading,
                                     *rules.value, source);
      REQUIRE(same.value);
      for (std::size_t i = 0; i < same.value->rules.size(); ++i) {
        CAPTURE(i);
        CHECK(same.value->rules[i].outlook == told.value->rules[i].outlook);
      }
    }
  }
  CHECK(decided > 75);
  CHECK(added > 100);
  std::ofstream(folder.path() / "events") << events;
  const Outcome compiled = run_in(
      folder.path(),
      "c++ -std=c++17 -O2 -Wall -Wextra -Wshadow -Werror main.cpp -o monitor "
      "2>&1");
  REQUIRE_MESSAGE(compiled.code == 0, compiled.text);
  const Outcome ran = run_in(folder.path(), "./monitor < events");
  CHECK(ran.code == 0);
  CHECK(ran.text == expected);
  MESSAGE(run_in(folder.path(), "./monitor 200 < events").text);
}

TEST_CASE("what a log does not show is no monitor") {
  const InputFile file{"drone3.btf", example("drone3.btf")};
  auto tree = read_tree(file.name, file.text, {});
  REQUIRE(tree.value);
  const RecordedRun nodes = recorded_tree(*tree.value, TreeInput(file));
  const auto refusal = [&](const std::string& text) {
    const auto rules = read_properties("r.ltl", text);
    REQUIRE(rules.value);
    const auto made = monitor_table(*tree.value, nodes, *rules.value,
                                    SourceText("r.ltl", text));
    CHECK(!made.value);
    REQUIRE(!made.diagnostics.empty());
    return made.diagnostics.front().code;
  };
  CHECK(refusal("property p: never battery == Low") == "BT1101");
  CHECK(refusal("property p: never dead") == "BT1805");
  CHECK(refusal("property p: never Sequence17.next_seq == 2") == "BT1805");
  CHECK(refusal("property p: AG EF root.success") == "BT1801");
  CHECK(refusal("property p: [] (takeoff.moves => X takeoff.success)") ==
        "BT1805");
}

// --- In a program ---------------------------------------------------------

// As much of BehaviorTree.CPP as a logger sees of it.
constexpr std::string_view kEngine =
    R"cpp(#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

          namespace BT {
          using Duration = std::chrono::high_resolution_clock::duration;
          enum class NodeStatus { IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED };

          class TreeNode {
           public:
            TreeNode(std::string name, std::string id)
                : name_(std::move(name)), id_(std::move(id)) {}
            virtual ~TreeNode() = default;
            const std::string& name() const { return name_; }
            const std::string& registrationName() const { return id_; }

           private:
            std::string name_;
            std::string id_;
          };
          class ControlNode : public TreeNode {
           public:
            using TreeNode::TreeNode;
            const std::vector<TreeNode*>& children() const { return all; }
            std::vector<TreeNode*> all;
          };
          class DecoratorNode : public TreeNode {
           public:
            using TreeNode::TreeNode;
            const TreeNode* child() const { return one; }
            TreeNode* one = nullptr;
          };
          struct Tree {
            TreeNode* root = nullptr;
            TreeNode* rootNode() const { return root; }
          };
          inline void applyRecursiveVisitor(
              const TreeNode* node,
              const std::function<void(const TreeNode*)>& visit) {
            visit(node);
            if (auto* control = dynamic_cast<const ControlNode*>(node)) {
              for (const TreeNode* child : control->all) {
                applyRecursiveVisitor(child, visit);
              }
            }
            if (auto* above = dynamic_cast<const DecoratorNode*>(node)) {
              applyRecursiveVisitor(above->one, visit);
            }
          }
          class StatusChangeLogger {
           public:
            explicit StatusChangeLogger(TreeNode*) {}
            virtual ~StatusChangeLogger() = default;
            virtual void callback(Duration, const TreeNode&, NodeStatus, NodeStatus) = 0;
            virtual void flush() = 0;
          };
          }  // namespace BT
    )cpp";

constexpr std::string_view kPatrol = R"(<root BTCPP_format="4">
  <BehaviorTree ID="Main">
    <Sequence>
      <Inverter><Wait name="low"/></Inverter>
      <Move/>
      <Wait/>
    </Sequence>
  </BehaviorTree>
</root>
)";

// A folder with headers of rules for that tree, and the stand-in.
class Program {
 public:
  void export_header(const std::string& file, const std::string& rules,
                     const std::string& space = "") {
    const InputFile input{"patrol.xml", std::string(kPatrol)};
    auto tree = read_tree(input.name, input.text, {});
    REQUIRE(tree.value);
    const auto read = read_properties(file + ".ltl", rules);
    REQUIRE(read.value);
    const auto table =
        monitor_table(*tree.value, recorded_tree(*tree.value, TreeInput(input)),
                      *read.value, SourceText(file + ".ltl", rules));
    REQUIRE(table.value);
    write(file + ".hpp", cpp_monitor(*table.value, space));
  }
  void write(const std::string& file, std::string_view text) {
    std::ofstream(folder_.path() / file) << text;
  }
  // What it prints, built of all its sources.
  std::string run() {
    write("engine.hpp", kEngine);
    const Outcome compiled = run_in(
        folder_.path(),
        "c++ -std=c++17 -Wall -Wextra -Wshadow -Werror *.cpp -o program 2>&1");
    REQUIRE_MESSAGE(compiled.code == 0, compiled.text);
    return run_in(folder_.path(), "./program 2>&1").text;
  }

 private:
  TemporaryFolder folder_;
};

TEST_CASE("a monitor refuses another tree, by its first node that differs") {
  Program program;
  program.export_header("rules", "property p: never Move.failure");
  program.write("main.cpp", R"cpp(
#include <iostream>

#include "engine.hpp"
#define BTCHECK_MONITOR_BTCPP
#include "rules.hpp"

    using Inner = BT::ControlNode;

    void log(BT::TreeNode* top) {
      btcheck_monitor::Monitor monitor;
      try {
        btcheck_monitor::BtcppLogger logger(BT::Tree{top}, monitor);
        std::cout << "fits\n";
      } catch (const btcheck_monitor::WrongTree& wrong) {
        std::cout << wrong.what() << "\n";
      }
    }

    int main() {
      BT::TreeNode low("low", "Wait"), move("Move", "Move"),
          wait("Wait", "Wait"), spin("low", "Spin"), more("x", "X");
      Inner top("Sequence", "Sequence"), other("Sequence", "Fallback");
      BT::DecoratorNode inverter("Inverter", "Inverter");
      inverter.one = &low;
      top.all = {&inverter, &move, &wait};
      log(&top);
      other.all = top.all;
      log(&other);
      top.all = {&inverter, &wait, &move};
      log(&top);
      top.all = {&inverter, &move, &wait, &more};
      log(&top);
      top.all = {&inverter, &move};
      log(&top);
      inverter.one = &spin;
      log(&top);
      Inner flat("Sequence", "Sequence"), empty("Inverter", "Inverter");
      flat.all = {&empty, &low, &move, &wait};
      log(&flat);
    }
  )cpp");
  const std::string wrong =
      "btcheck: another tree runs than the one of the rules: ";
  CHECK(program.run() ==
        "fits\n" + wrong +
            "its node 1 is `Sequence` (Fallback) at the top, where patrol.xml "
            "has `Sequence` at the top\n" +
            wrong +
            "its node 4 is `Wait` below node 1, where patrol.xml has `Move` "
            "below node 1\n" +
            wrong + "it has 6 nodes, patrol.xml has 5\n" + wrong +
            "it has 4 nodes, patrol.xml has 5\n" + wrong +
            "its node 3 is `low` (Spin) below node 2, where patrol.xml has "
            "`low` (Wait) below node 2\n" +
            wrong +
            "its node 3 is `low` (Wait) below node 1, where patrol.xml has "
            "`low` (Wait) below node 2\n");
}

TEST_CASE("a deadline is told in the tick in which it is lost") {
  Program program;
  program.export_header("rules",
                        "property soon: whenever Move.failure then Move.success"
                        " within 1 tick\n"
                        "property now: whenever Move.failure then Move.success"
                        " within 0 ticks\n"
                        "property first: Move.ticked U Move.success\n");
  program.write("main.cpp", R"cpp(
#include <iostream>

#include "rules.hpp"

    using btcheck_monitor::Status;

    int main() {
      int tick = 0;
      btcheck_monitor::Monitor monitor;
      monitor.on_verdict = [&](std::size_t rule,
                               btcheck_monitor::Verdict verdict) {
        std::cout << monitor.name(rule) << " " << int(verdict) << " in tick "
                  << tick << "\n";
      };
      try {
        monitor.change(1, Status::Idle, Status::Running);
      } catch (const std::logic_error& error) {
        std::cout << error.what() << "\n";
      }
      while (++tick < 4) {
        monitor.begin_tick();
        if (tick == 2) monitor.change(4, Status::Idle, Status::Failure);
        monitor.end_tick();
        std::cout << "end of tick " << tick << "\n";
      }
      try {
        monitor.change(6, Status::Idle, Status::Running);
      } catch (const std::out_of_range& error) {
        std::cout << error.what() << "\n";
      }
    }
  )cpp");
  CHECK(program.run() ==
        "btcheck: begin_tick() comes before the first change\n"
        "first 2 in tick 1\n"
        "end of tick 1\n"
        "now 2 in tick 2\n"
        "end of tick 2\n"
        "soon 2 in tick 3\n"
        "end of tick 3\n"
        "btcheck: there is no node 6\n");
}

TEST_CASE("several monitors stand in one program, and in one file") {
  Program program;
  program.export_header("one", "property a: never Move.failure");
  program.export_header("two", "property b: never Move.success");
  program.export_header("three", "property c: never Move.ticked",
                        "robot::rules");
  program.write("main.cpp", R"cpp(
#include "one.hpp"
#include "three.hpp"
#include "two.hpp"
#include <iostream>

    const char* alone();
    int main() {
      std::cout << btcheck_monitor::of_one_for_patrol::Monitor::name(0)
                << btcheck_monitor::of_two_for_patrol::Monitor::name(0)
                << robot::rules::Monitor::name(0) << alone() << "\n";
    }
  )cpp");
  program.write("alone.cpp", R"cpp(
#include "two.hpp"

    const char* alone() {
      return btcheck_monitor::Monitor::name(0);
    }
  )cpp");
  CHECK(program.run() == "abcb\n");
}

TEST_CASE("what a log does not show is told once for each cause") {
  const InputFile file{"drone3.btf", example("drone3.btf")};
  auto tree = read_tree(file.name, file.text, {});
  REQUIRE(tree.value);
  const std::string text = example("demo.ltl");
  const auto rules = read_properties("demo.ltl", text);
  REQUIRE(rules.value);
  const auto made =
      monitor_table(*tree.value, recorded_tree(*tree.value, TreeInput(file)),
                    *rules.value, SourceText("demo.ltl", text));
  CHECK(!made.value);
  REQUIRE(made.diagnostics.size() == 1);
  CHECK(made.diagnostics[0].code == "BT1805");
  CHECK(made.diagnostics[0].message ==
        "a log does not show `goto_waypoint@27.z`, `goto_waypoint@39.z`, "
        "`goto_waypoint@40.z` and 5 more");
}

}  // namespace
}  // namespace btcheck::cpp_monitor_test
