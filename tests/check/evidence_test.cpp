// SPDX-License-Identifier: MIT
//
// A run that does not show what it should is seen through.
#include "check/replay/evidence.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"
#include "check/replay/replay.hpp"

namespace btcheck::evidence_test {
namespace {

// A run to the end of the tree, and on for ever.
Run ended_run(const Lowered& model) {
  Lasso lasso =
      found_run(model, predicate(model, "(root.success and w == Calm)"));
  const StateVector last = lasso.prefix.back().state;
  lasso.cycle = {{last, kIdleStep}};
  lasso.closing = kIdleStep;
  std::string error;
  auto run = replay(Replayer(model.system), lasso, error);
  REQUIRE(run.has_value());
  return *std::move(run);
}

TEST_CASE("a run that does not end where it should is seen through") {
  const Lowered model(kWaitingTree);
  const Run run = ended_run(model);
  CHECK(ends_with(model.network, run, predicate(model, "root.success")));
  CHECK(!ends_with(model.network, run, predicate(model, "root.failure")));
  CHECK(!ends_with(model.network, run, predicate(model, "stuck")));
  const Lowered still("(BehaviorTree :name t (Action :ID a :SF))");
  std::string error;
  const auto dead_run =
      replay(Replayer(still.system), found_run(still, predicate(still, "dead")),
             error);
  REQUIRE(dead_run.has_value());
  CHECK(ends_with(still.network, *dead_run, predicate(still, "dead")));
  CHECK(!ends_with(still.network, *dead_run, predicate(still, "stuck")));
}

// A formula over two conditions, 0 and 1.
struct TwoConditions {
  TwoConditions(const Lowered& model, const std::string& first,
                const std::string& second) {
    bound.propositions = {{predicate(model, first), {}, {}},
                          {predicate(model, second), {}, {}}};
  }

  BoundFormula with(FormulaId formula) {
    bound.formula = formula;
    return bound;
  }
  FormulaId unary(FormulaKind kind, FormulaId of) {
    return bound.pool.unary(kind, of);
  }
  FormulaId atom(std::uint32_t number) { return bound.pool.atom(number); }

  BoundFormula bound;
};

TEST_CASE("a run that satisfies a formula does not violate it") {
  const Lowered model(kWaitingTree);
  const Run run = ended_run(model);
  TwoConditions two(model, "root.success", "root.failure");
  const FormulaId succeeds = two.unary(FormulaKind::Eventually, two.atom(0));
  const FormulaId stays = two.unary(FormulaKind::Always, succeeds);
  const FormulaId fails = two.unary(FormulaKind::Eventually, two.atom(1));
  CHECK(!violates(model.network, run, two.with(succeeds)));
  CHECK(!violates(model.network, run, two.with(stays)));
  CHECK(violates(model.network, run, two.with(fails)));
  CHECK(violates(model.network, run,
                 two.with(two.unary(FormulaKind::Always, two.atom(0)))));
  Run finite = run;
  finite.loop = kNoLoop;
  CHECK(!violates(model.network, finite, two.with(fails)));
}

TEST_CASE("a loop in which only free variables move shows nothing") {
  const Lowered model(kWaitingTree);
  Run run = ended_run(model);
  TwoConditions two(model, "root.failure", "tick");
  const BoundFormula fails =
      two.with(two.unary(FormulaKind::Eventually, two.atom(0)));
  CHECK(violates(model.network, run, fails));
  for (std::size_t i = run.loop; i < run.steps.size(); ++i) {
    run.steps[i].step.progress = false;
    run.steps[i].step.elapsed = 0;
  }
  CHECK(!violates(model.network, run, fails));
}

TEST_CASE("events of steps are read off the steps of the run") {
  const Lowered model(kWaitingTree);
  const Run run = ended_run(model);
  BoundFormula ever;
  ever.propositions = {
      {predicate(model, "z.running"), PropositionKind::Enter, {}},
      {predicate(model, "z.running"), PropositionKind::Leave, {}},
      {{}, PropositionKind::Passes, {}},
      {{}, PropositionKind::Moves, {model.network.node_automaton[2]}},
      {predicate(model, "root.failure"), PropositionKind::Enter, {}}};
  for (std::uint32_t i = 0; i < 5; ++i) {
    CAPTURE(i);
    ever.formula = ever.pool.unary(FormulaKind::Eventually, ever.pool.atom(i));
    CHECK(violates(model.network, run, ever) == (i == 4));
  }
}

TEST_CASE("a loop that asks and is never granted is not fair") {
  const Lowered model(kWaitingTree);
  const Run run = ended_run(model);
  const StatePredicate ended = predicate(model, "root.success");
  const StatePredicate never = predicate(model, "root.failure");
  CHECK(is_fair(model.network, run, {}));
  CHECK(is_fair(model.network, run, {{never, never}, {ended, ended}}));
  CHECK(!is_fair(model.network, run, {{never, never}, {ended, never}}));
}

// Of `z.running leadsto ANSWER within [from, to]` on the run to the end: Wait 2
// runs first at time 1, e is ticked at time 3.
std::optional<std::size_t> occurrence(const Lowered& model, const Run& run,
                                      const std::string& answer,
                                      TimedPattern pattern) {
  return violated_occurrence(
      model.network, run,
      {{predicate(model, "z.running"), predicate(model, answer),
        predicate(model, "root.success")},
       {},
       pattern});
}

TEST_CASE("an occurrence is violated by its time and not by another") {
  const Lowered model(kWaitingTree);
  Run run = ended_run(model);
  const auto is_violated = [&](const std::string& answer,
                               TimedPattern pattern) {
    return occurrence(model, run, answer, pattern).has_value();
  };
  CHECK(is_violated("e.ticked", {.from = 0, .to = 1}));
  CHECK(!is_violated("e.ticked", {.from = 0, .to = 2}));
  CHECK(is_violated("e.ticked", {.from = 2, .to = 2}));
  CHECK(is_violated("root.failure", {.from = 0, .to = 1}));
  CHECK(!is_violated("root.failure", {.from = 0, .to = 99}));
  CHECK(is_violated("root.failure", {.from = 0, .to = kNoEnd}));
  TimedPattern none{.from = 0, .to = 2, .demand = Demand::NoAnswer};
  CHECK(is_violated("e.ticked", none));
  none.to = 0;
  CHECK(!is_violated("e.ticked", none));
  TimedPattern closing{.from = 0, .to = kNoEnd, .closing = 4};
  CHECK(is_violated("root.failure", closing));
  CHECK(!is_violated("e.ticked", closing));
}

}  // namespace
}  // namespace btcheck::evidence_test
