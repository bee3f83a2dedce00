// SPDX-License-Identifier: MIT
//
// The leaves against their rows in docs/semantics.md: Action, Condition, SetSV,
// Eval, Wait, :duration and contracts.
#include <doctest/doctest.h>

#include <string>

#include "model/lowering.hpp"
#include "model/network_text.hpp"

namespace btcheck::mapping_leaf_test {
namespace {

std::string in_tree(const std::string& leaf, const std::string& before = "") {
  return before + "(BehaviorTree :name t " + leaf + ")";
}

std::string leaf_table(const std::string& leaf, const std::string& before = "",
                       TickSemantics ticks = TickSemantics::Root) {
  return table_of(in_tree(leaf, before), "n", ticks);
}

constexpr std::string_view kBattery =
    "(defsv battery :states (Good Low Bad)"
    " :transitions ((Good Low) (Low Bad)))";
constexpr std::string_view kLevel = "(defsv level :min 0 :max 3)";
const std::string battery(kBattery);
const std::string level(kLevel);

TEST_CASE("an action answers as it likes, each time it is ticked") {
  const std::string table = R"(
    tick_node -> success
    tick_node -> failure
    tick_node -> running
    halt -> halted)";
  CHECK(leaf_table("(Action :name n)") == framed(table));
  CHECK(leaf_table("(Action :ID n :args (x 1))") == framed(table));
}

TEST_CASE("an action takes its unit on the choice itself") {
  for (const TickSemantics ticks :
       {TickSemantics::Leaves, TickSemantics::Nodes}) {
    CHECK(leaf_table("(Action :name n)", "", ticks) == framed(R"(
      tick_node -> success @[1,1]
      tick_node -> failure @[1,1]
      tick_node -> running @[1,1]
      halt -> halted)"));
  }
}

TEST_CASE("an action with :SF never runs and is never halted") {
  CHECK(leaf_table("(Action :name n :SF)") == short_framed(R"(
    tick_node -> success
    tick_node -> failure)"));
  CHECK(leaf_table("(Action :name n :SF)", "", TickSemantics::Nodes) ==
        short_framed(R"(
    tick_node -> success @[1,1]
    tick_node -> failure @[1,1])"));
}

TEST_CASE("a condition succeeds or fails") {
  CHECK(leaf_table("(Condition :name n)") == short_framed(R"(
    tick_node -> success
    tick_node -> failure)"));
  CHECK(leaf_table("(Condition :name n)", "", TickSemantics::Leaves) ==
        short_framed(R"(
    tick_node -> success @[1,1]
    tick_node -> failure @[1,1])"));
}

TEST_CASE("SetSV finds the present value or one that it may change to") {
  CHECK(leaf_table("(SetSV :name n :sv battery)", battery) == short_framed(R"(
    tick_node -> success [battery = Good] battery := Good
    tick_node -> success [battery = Low or battery = Good] battery := Low
    tick_node -> success [battery = Bad or battery = Low] battery := Bad)"));
  CHECK(leaf_table("(SetSV :name n :sv v)", "(defsv v :states (x y))",
                   TickSemantics::Leaves) == short_framed(R"(
    tick_node -> evaluate @[1,1]
    evaluate -> success v := x
    evaluate -> success v := y)"));
}

TEST_CASE("SetSV of a number finds any value of its range") {
  CHECK(leaf_table("(SetSV :name n :sv k)", "(defsv k :min -1 :max 1)") ==
        short_framed(R"(
    tick_node -> success k := -1
    tick_node -> success k := 0
    tick_node -> success k := 1)"));
}

TEST_CASE("Eval answers by the value of its expression") {
  CHECK(leaf_table("(Eval :name n (= battery Low))", battery) ==
        short_framed(R"(
    tick_node -> success [battery = Low]
    tick_node -> failure [not (battery = Low)])"));
  CHECK(leaf_table("(Eval :name n (= battery Low))", battery,
                   TickSemantics::Nodes) == short_framed(R"(
    tick_node -> evaluate @[1,1]
    evaluate -> success [battery = Low]
    evaluate -> failure [not (battery = Low)])"));
}

TEST_CASE("Eval reads the statuses of other nodes") {
  CHECK(table_of("(BehaviorTree :name t (Sequence (Action :name a)"
                 " (Eval :name n (= a.rstatus success))))",
                 "n") == short_framed(R"(
    tick_node -> success [a.rstatus = success]
    tick_node -> failure [not (a.rstatus = success)])"));
}

TEST_CASE("a division by zero in an Eval is a fault") {
  CHECK(leaf_table("(Eval :name n (= (/ 6 level) 2))", level) ==
        short_framed(R"(
    tick_node -> success [level ~= 0 and 6 / level = 2]
    tick_node -> failure [level ~= 0 and not (6 / level = 2)]
    tick_node -> error [not (level ~= 0)] fault := true)"));
}

TEST_CASE("an assignment that leaves its range is a fault") {
  CHECK(leaf_table("(Eval :name n (:= level (+ 1 level)))", level) ==
        short_framed(R"(
    tick_node -> success [1 + level >= 0 and 1 + level <= 3] level := 1 + level
    tick_node -> error [not (1 + level >= 0 and 1 + level <= 3)]
      + fault := true)"));
  CHECK(leaf_table("(Eval :name n (:= battery Bad))", battery) ==
        short_framed("tick_node -> success battery := Bad"));
}

TEST_CASE("the fault variable is there only if something can fail") {
  const auto has_fault = [](const std::string& leaf) {
    return lower(tree_of(in_tree(leaf, level)), TickSemantics::Root)
        .fault.has_value();
  };
  CHECK(!has_fault("(Eval (= level 2))"));
  CHECK(!has_fault("(Eval (:= level 2))"));
  CHECK(has_fault("(Eval (:= level (+ level 1)))"));
  CHECK(has_fault("(Eval (= (mod 4 level) 1))"));
}

TEST_CASE("Wait answers running until its timer is due") {
  const std::string text = in_tree("(Wait :name n :duration 3)");
  CHECK(table_of(text, "n") == framed(R"(
    tick_node -> look [n_timer.location = idle] n_timer.location := counting
    tick_node -> look [n_timer.location ~= idle]
    look -> running [n_timer.location = counting]
    look -> success [n_timer.location = due] n_timer.location := idle
    halt -> halted n_timer.location := idle)"));
  CHECK(table_of(text, "n_timer") == rows("counting -> due @[3,3]"));
  CHECK(leaf_table("(Wait :name n :duration 0)") ==
        short_framed("tick_node -> success"));
}

TEST_CASE("an action with a :duration is due once within it") {
  const std::string text = in_tree("(Action :name n :duration [2,5])");
  CHECK(table_of(text, "n", TickSemantics::Leaves) == framed(R"(
    tick_node -> evaluate @[1,1]
    evaluate -> look [n_timer.location = idle] n_timer.location := counting
    evaluate -> look [n_timer.location ~= idle]
    look -> running [n_timer.location = counting]
    look -> success [n_timer.location = due] n_timer.location := idle
    look -> failure [n_timer.location = due] n_timer.location := idle
    halt -> halted n_timer.location := idle)"));
  CHECK(table_of(text, "n_timer", TickSemantics::Leaves) ==
        rows("counting -> due @[2,5]"));
  CHECK(table_of(in_tree("(Action :name n :duration [0,5])"), "n_timer") ==
        rows("counting -> due @[0,5]"));
}

TEST_CASE("an action with a :duration of no ticks never runs") {
  CHECK(leaf_table("(Action :name n :duration 0)") == short_framed(R"(
    tick_node -> success
    tick_node -> failure)"));
}

TEST_CASE("the timer belongs to its node and begins idle") {
  const BehaviorTree tree = tree_of(in_tree("(Wait :name n :duration 3)"));
  const Network network = lower(tree, TickSemantics::Root);
  const Automaton& timer = automaton_called(network, "n_timer");
  CHECK(timer.kind == AutomatonKind::Timer);
  CHECK(timer.node == NodeId{1});
  CHECK(!timer.gate.has_value());
  CHECK(network.variable(timer.location)
            .value_name(network.variable(timer.location).initial) == "idle");
}

TEST_CASE(":returns removes answers") {
  CHECK(leaf_table("(Action :ID n)",
                   "(defaction n :returns (success running))") == framed(R"(
    tick_node -> success
    tick_node -> running
    halt -> halted)"));
  CHECK(
      leaf_table("(Condition :ID n)", "(defcondition n :returns (failure))") ==
      short_framed("tick_node -> failure"));
  CHECK(leaf_table("(Action :ID n :SF)",
                   "(defaction n :returns (success running))") ==
        short_framed("tick_node -> success"));
}

TEST_CASE("effects happen on the edge to the answer") {
  CHECK(leaf_table("(Action :ID n)", battery + level + R"(
      (defaction n :on-success ((:= level 0) (:= battery Good))
                   :on-failure ((:= battery Bad))))") == framed(R"(
    tick_node -> success level := 0, battery := Good
    tick_node -> failure battery := Bad
    tick_node -> running
    halt -> halted)"));
  CHECK(leaf_table("(Action :ID n :SF)",
                   level + "(defaction n :on-success ((:= level 0)))",
                   TickSemantics::Leaves) == short_framed(R"(
    tick_node -> evaluate @[1,1]
    evaluate -> success level := 0
    evaluate -> failure)"));
}

TEST_CASE("a later effect reads what an earlier one assigned") {
  CHECK(leaf_table("(Condition :ID n)", level + R"(
      (defsv k :max 5)
      (defcondition n :returns (success)
       :on-success ((:= k 2) (:= level (+ k 1)))))") == short_framed(R"(
    tick_node -> success [2 + 1 >= 0 and 2 + 1 <= 3] k := 2, level := k + 1
    tick_node -> error [not (2 + 1 >= 0 and 2 + 1 <= 3)] fault := true)"));
}

TEST_CASE("where its requirement is false an action can only fail") {
  const std::string requires_good = " :requires (= battery Good))";
  CHECK(leaf_table("(Action :ID n)",
                   battery + "(defaction n" + requires_good) == framed(R"(
    tick_node -> success [battery = Good]
    tick_node -> failure
    tick_node -> running [battery = Good]
    halt -> halted)"));
  CHECK(leaf_table("(Action :ID n)",
                   battery + "(defaction n :returns (success running)" +
                       requires_good) == framed(R"(
    tick_node -> success [battery = Good]
    tick_node -> failure [not (battery = Good)]
    tick_node -> running [battery = Good]
    halt -> halted)"));
}

TEST_CASE("an action that becomes impossible fails before it is due") {
  CHECK(leaf_table("(Action :ID n)", battery + R"((defaction n
      :returns (success running) :duration 3
      :requires (= battery Good)))") == framed(R"(
    tick_node -> look [n_timer.location = idle] n_timer.location := counting
    tick_node -> look [n_timer.location ~= idle]
    look -> running [n_timer.location = counting and battery = Good]
    look -> failure [n_timer.location = counting and not (battery = Good)]
      + n_timer.location := idle
    look -> success [n_timer.location = due and battery = Good]
      + n_timer.location := idle
    look -> failure [n_timer.location = due and not (battery = Good)]
      + n_timer.location := idle
    halt -> halted n_timer.location := idle)"));
}

}  // namespace
}  // namespace btcheck::mapping_leaf_test
