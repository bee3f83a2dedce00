// SPDX-License-Identifier: MIT
//
// Each form of property, holding and violated, on trees small enough to know
// the answer by looking.
#include "check/search/engine.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"
#include "check/replay/replay.hpp"

namespace btcheck::engine_test {
namespace {

// c, then a: a may run for ever.
constexpr std::string_view kTree =
    "(BehaviorTree :name t (Sequence :name s"
    " (Condition :ID c) (Action :ID a)))";

std::string_view word(Verdict verdict) {
  return verdict == Verdict::Holds      ? "holds"
         : verdict == Verdict::Violated ? "violated"
                                        : "undecided";
}

// "holds", "violated" or "undecided"; " run" when a run is told, "/loop" when
// it goes on for ever.
std::string answer(const PropertyVerdict& verdict) {
  std::string text(word(verdict.verdict));
  if (verdict.run) text += " run";
  if (verdict.run && verdict.run->loop != kNoLoop) text += "/loop";
  return text;
}

struct Row {
  std::string property;
  std::string expected;
};

void check_rows(std::string_view tree, const std::vector<Row>& table,
                TickSemantics ticks = TickSemantics::Root) {
  const Lowered model(tree, ticks);
  for (const Row& row : table) {
    CAPTURE(row.property);
    const Verified verified(model, "prove " + row.property + "\n");
    CHECK(answer(verified.verdicts[0]) == row.expected);
  }
}

TEST_CASE("never asks that no reachable state is so") {
  check_rows(kTree, {{"never a.halted", "holds"},
                     {"never a.failure", "violated run"},
                     {"never (c.failure and a.ticked)", "holds"},
                     {"absent root.success", "violated run"}});
}

TEST_CASE("always, of a state, asks that every reachable state is so") {
  check_rows(kTree, {{"always not a.halted", "holds"},
                     {"always a.status != running", "violated run"},
                     {"always s.next_seq in 1..2", "holds"},
                     {"always s.next_seq == 1", "violated run"},
                     {"always not dead", "violated run"}});
}

TEST_CASE("possible asks for a state, and shows it") {
  check_rows(kTree, {{"possible root.success", "holds run"},
                     {"possible a.running", "holds run"},
                     {"possible a.halted", "violated"},
                     {"possible dead", "holds run"},
                     {"possible stuck", "violated"}});
}

TEST_CASE("deadlockfree holds of a mission that begins again") {
  check_rows(kTree, {{"deadlockfree", "violated run"}});
  check_rows("(BehaviorTree :name t :loop 1 (Action :ID a))",
             {{"deadlockfree", "holds"}});
}

TEST_CASE("a linear formula is about every run") {
  check_rows(kTree,
             {{"ltl [] (a.failure => <> root.failure)", "holds"},
              {"ltl [] (a.ticked => <> root.ended)", "violated run/loop"},
              {"ltl <> tick", "holds"},
              {"ltl <> (root.ended or a.running)", "holds"},
              {"ltl [] <> a.ticked", "violated run/loop"},
              {"ltl (not a.ticked) W c.success", "holds"},
              {"ltl (not c.failure) U root.ended", "violated run"},
              {"ltl [] (root.success => [] root.success)", "holds"},
              {"ltl [] (dead => root.ended)", "holds"}});
}

TEST_CASE("a response has to come within its interval") {
  check_rows(kTree,
             {{"c.success leadsto a.ticked within [0,0]", "holds"},
              {"a.failure leadsto root.failure within [0,0]", "holds"},
              {"a.running leadsto a.ticked within [0,1]", "holds"},
              {"a.running leadsto a.ticked within [1,1]", "holds"},
              {"a.running leadsto a.ticked within [0,0]", "violated run"},
              {"a.running leadsto root.ended within [0,3]", "violated run"},
              {"a.halted leadsto root.ended within [0,0]", "holds"}});
}

TEST_CASE("a response that holds knows the longest time an answer took") {
  const Lowered model(kTree, TickSemantics::Nodes);
  const Verified verified(
      model,
      "property one is c.success leadsto a.failure within [0,9]\n"
      "property two is c.success leadsto (a.failure or a.success or a.running)"
      " within [0,9]\n"
      "property three is a.halted leadsto a.failure within [0,9]\n");
  CHECK(verified.verdicts[0].verdict == Verdict::Violated);
  CHECK(verified.verdicts[1].longest_answer == 1);
  CHECK(verified.verdicts[2].verdict == Verdict::Holds);
  CHECK(verified.verdicts[2].longest_answer == -1);
}

TEST_CASE("a run that is not answered names the state that asked") {
  const Lowered model(kTree);
  const Verified verified(model,
                          "prove a.running leadsto root.ended within [0,1]\n");
  const PropertyVerdict& verdict = verified.verdicts[0];
  REQUIRE(verdict.run.has_value());
  const NetworkInterpreter interpreter(model.network);
  CHECK(interpreter.is_true(verified.bound.properties[0].timed.predicates[0],
                            verdict.run->state(verdict.trigger_state)));
}

TEST_CASE("the weather cannot keep the tree from going on") {
  check_rows(
      "(defsv w :states (Calm Storm))"
      "(BehaviorTree :name t (Eval :name e (= w Calm)))",
      {{"ltl <> root.ended", "holds"},
       {"ltl <> w == Storm", "violated run/loop"},
       {"possible (root.failure and w == Calm)", "holds run"},
       {"tick leadsto root.ended within [0,1]", "holds"}});
}

TEST_CASE("the shortest run is told") {
  const Lowered model(kTree);
  const Verified verified(model, "prove never a.success\n");
  REQUIRE(verified.verdicts[0].run.has_value());
  // start_, tick, the sequence and c are called and answer, then a.
  std::size_t ticks = 0;
  for (const RunStep& step : verified.verdicts[0].run->steps) {
    ticks += step.step.elapsed;
  }
  CHECK(ticks == 1);
  const Verified deep(model, "prove never a.success\n",
                      {SearchOrder::DepthFirst, Reduction::Full});
  REQUIRE(deep.verdicts[0].run.has_value());
  CHECK(verified.verdicts[0].run->steps.size() <=
        deep.verdicts[0].run->steps.size());
}

constexpr std::string_view kManyProperties = R"(
prove never a.halted
prove never a.failure
prove always not c.success
prove possible root.failure
prove possible stuck
prove deadlockfree
prove always s.next_seq in 1..2
prove never (a.running and c.ticked)
prove ltl <> root.ended
prove a.running leadsto root.ended within [0,1]
)";

TEST_CASE("the order of the search changes no verdict") {
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes}) {
    CAPTURE(tick_name(ticks));
    const Lowered model(kTree, ticks);
    const std::string text(kManyProperties);
    const Verified wide(model, text);
    const Verified deep(model, text,
                        {SearchOrder::DepthFirst, Reduction::Full});
    for (std::size_t i = 0; i < wide.verdicts.size(); ++i) {
      CAPTURE(wide.file.properties[i].text);
      CHECK(answer(wide.verdicts[i]) == answer(deep.verdicts[i]));
      CHECK(wide.verdicts[i].property == &wide.file.properties[i]);
    }
  }
}

TEST_CASE("one search for many answers each as a search of its own") {
  const Lowered model(kTree);
  const Verified together(model, std::string(kManyProperties));
  for (std::size_t i = 0; i < together.verdicts.size(); ++i) {
    const std::string text = together.file.properties[i].text;
    CAPTURE(text);
    const Verified alone(model, "prove " + text + "\n");
    CHECK(answer(alone.verdicts[0]) == answer(together.verdicts[i]));
    if (!alone.verdicts[0].run) continue;
    CHECK(alone.verdicts[0].run->steps.size() ==
          together.verdicts[i].run->steps.size());
  }
}

void check_undecided(const Lowered& model, const std::string& properties,
                     SearchOrder order, const Limits& limits,
                     StopReason reason) {
  const Verified verified(model, properties, {order, Reduction::None}, limits);
  for (const PropertyVerdict& verdict : verified.verdicts) {
    CAPTURE(verdict.property->text);
    CHECK(answer(verdict) == "undecided");
    CHECK(verdict.stopped == reason);
    CHECK(verdict.met_expectation());
  }
}

TEST_CASE("a limit gives no verdict, and its reason") {
  const Lowered model(kTree);
  const std::string of_states =
      "prove never a.halted\nprove possible root.failure\nprove deadlockfree\n";
  for (const SearchOrder order :
       {SearchOrder::BreadthFirst, SearchOrder::DepthFirst}) {
    check_undecided(model, of_states, order, {.max_states = 1},
                    StopReason::MaxStates);
    check_undecided(model, of_states, order, {.max_bytes = 1},
                    StopReason::Memory);
  }
}

TEST_CASE("a limit on a search for runs gives no verdict either") {
  const Lowered model(example("drone3.btf"));
  const std::string of_runs =
      "prove ltl [] (root.success => <> root.ended)\n"
      "prove root.success leadsto root.ended within [0,3]\n";
  const SearchOrder order = SearchOrder::BreadthFirst;
  check_undecided(model, of_runs, order, {.max_states = 5000},
                  StopReason::MaxStates);
  check_undecided(model, of_runs, order, {.max_bytes = 100'000},
                  StopReason::Memory);
}

TEST_CASE("what was found before the limit is a verdict all the same") {
  const Lowered model(example("drone3.btf"));
  const Limits few{.max_states = 5000};
  const Verified verified(model,
                          "prove possible start_drone.running\n"
                          "prove possible root.success\n"
                          "prove never start_drone.halted\n",
                          {SearchOrder::BreadthFirst, Reduction::None}, few);
  CHECK(answer(verified.verdicts[0]) == "holds run");
  CHECK(verified.verdicts[0].stopped == StopReason::None);
  CHECK(answer(verified.verdicts[1]) == "undecided");
  CHECK(answer(verified.verdicts[2]) == "undecided");
  CHECK(verified.verdicts[2].progress.states >= 5000);
}

TEST_CASE("a bound on time is refused where no time passes") {
  const Lowered model(kTree, TickSemantics::None);
  const std::string text = "prove a.running leadsto root.ended within [0,1]\n";
  const PropertyFile file = properties_of(text);
  const auto made =
      bind_properties(model.tree, model.network, file,
                      SourceText("p.ltl", text), ExtraAssumption::None);
  CHECK(!made.value.has_value());
  CHECK(codes_of(made.diagnostics) == "BT1108");
}

TEST_CASE("every wrong atom of every property is reported") {
  const Lowered model(kTree);
  const std::string text =
      "prove never x.ticked\nprove possible y.ticked\n"
      "prove ltl <> (a.ticked and z.ticked)\n";
  const PropertyFile file = properties_of(text);
  const auto made =
      bind_properties(model.tree, model.network, file,
                      SourceText("p.ltl", text), ExtraAssumption::None);
  CHECK(!made.value.has_value());
  CHECK(codes_of(made.diagnostics) == "BT1101 BT1101 BT1101");
}

TEST_CASE("expectations are met by verdicts, and by none") {
  const Lowered model(kTree);
  const Verified verified(model,
                          "property p expect violated: never a.failure\n"
                          "property q expect holds: never a.failure\n"
                          "property r expect violated: never a.halted\n"
                          "property s: never a.halted\n");
  CHECK(verified.verdicts[0].met_expectation());
  CHECK(!verified.verdicts[1].met_expectation());
  CHECK(!verified.verdicts[2].met_expectation());
  CHECK(verified.verdicts[3].met_expectation());
}

}  // namespace
}  // namespace btcheck::engine_test
