// SPDX-License-Identifier: MIT
//
// A run is executed again from the tables: one that was tampered with is
// refused, and one that does not show what it should is seen through.
#include "check/replay.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"
#include "explore/breadth_first.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kTree =
    "(defsv w :states (Calm Storm))"
    "(BehaviorTree :name t (Sequence :name s (Wait :name z :duration 2)"
    " (Eval :name e (= w Calm)) (Action :ID a)))";

StatePredicate predicate(const Lowered& model, const std::string& text) {
  const PropertyFile file = properties_of("prove never " + text + "\n");
  const std::string source = "prove never " + text + "\n";
  auto made = bind_properties(model.tree, model.network, file,
                              SourceText("p.ltl", source));
  REQUIRE(made.value.has_value());
  return (*made.value)[0].predicate;
}

// The shortest run to a state that satisfies the predicate, as searches tell
// it.
Lasso found_run(const Lowered& model, const StatePredicate& goal) {
  struct Goal : ReachabilityVisitor {
    Goal(const CompiledNetwork& system, const StatePredicate& goal)
        : labels(system, {goal}) {}
    GoOn expanded(StateId id, StateView state, bool is_dead) {
      if (!labels.holds(0, state, is_dead)) return GoOn::Yes;
      found = id;
      return GoOn::No;
    }
    LabelledNetwork labels;
    std::optional<StateId> found;
  };
  const Limits limits;
  BreadthFirst search(model.system, limits);
  Goal visitor(model.system, goal);
  search.run(visitor);
  REQUIRE(visitor.found.has_value());
  return {search.path_to(*visitor.found), {}, {}};
}

std::string complaint_about(const Lowered& model, const Lasso& run) {
  std::string error;
  const auto replayed = replay(model.system, run, error);
  CHECK(replayed.has_value() == error.empty());
  return error;
}

TEST_CASE("a run is replayed step by step") {
  const Lowered model(kTree);
  const StatePredicate goal = predicate(model, "a.running");
  const Lasso found = found_run(model, goal);
  std::string error;
  const auto run = replay(model.system, found, error);
  REQUIRE(run.has_value());
  CHECK(error == "");
  CHECK(run->loop == kNoLoop);
  CHECK(run->state_count() == found.prefix.size());
  CHECK(ends_with(model.network, *run, goal));
  for (std::size_t i = 0; i < run->state_count(); ++i) {
    for (std::uint32_t v = 0; v < model.network.variables.size(); ++v) {
      CHECK(run->state(i).variables[v] ==
            model.system.value(found.prefix[i].state, VariableId{v}));
    }
  }
}

TEST_CASE("a run that begins elsewhere is refused") {
  const Lowered model(kTree);
  Lasso run = found_run(model, predicate(model, "a.running"));
  run.prefix.erase(run.prefix.begin());
  CHECK(complaint_about(model, run) ==
        "the run does not begin with the initial state");
}

TEST_CASE("a run with a step left out is refused") {
  const Lowered model(kTree);
  const Lasso run = found_run(model, predicate(model, "a.running"));
  for (std::size_t at = 1; at < run.prefix.size(); ++at) {
    Lasso shorter = run;
    shorter.prefix.erase(shorter.prefix.begin() +
                         static_cast<std::ptrdiff_t>(at));
    // Leaving out the last step leaves a run, only a shorter one.
    if (at + 1 == run.prefix.size()) {
      CHECK(complaint_about(model, shorter) == "");
    } else {
      CAPTURE(at);
      CHECK(complaint_about(model, shorter) != "");
    }
  }
}

TEST_CASE("a run with any variable changed in any state is refused") {
  const Lowered model(kTree);
  const Lasso run = found_run(model, predicate(model, "a.running"));
  for (std::size_t at = 0; at < run.prefix.size(); ++at) {
    for (std::uint32_t v = 0; v < model.network.variables.size(); ++v) {
      const Variable& variable = model.network.variables[v];
      if (variable.domain_size() == 1) continue;
      Lasso changed = run;
      const Field& field = model.system.layout().fields[v];
      Word* state = changed.prefix[at].state.data();
      field.put(state, field.get(state) == variable.min ? variable.min + 1
                                                        : variable.min);
      CAPTURE(at);
      CAPTURE(variable.name);
      CHECK(complaint_about(model, changed) != "");
    }
  }
}

TEST_CASE("a run with a step named wrongly is refused") {
  const Lowered model(kTree);
  const Lasso run = found_run(model, predicate(model, "a.running"));
  for (std::size_t at = 1; at < run.prefix.size(); ++at) {
    Lasso changed = run;
    Step& step = changed.prefix[at].step;
    step.edge = step.edge == kTimeStep ? 0 : kTimeStep;
    CAPTURE(at);
    const std::string complaint = complaint_about(model, changed);
    CHECK(complaint.starts_with("step " + std::to_string(at) + ", "));
    CHECK(complaint.ends_with(" when replayed"));
  }
}

TEST_CASE("a loop that does not close is refused") {
  const Lowered model(kTree);
  Lasso lasso = found_run(model, predicate(model, "a.running"));
  lasso.cycle = {lasso.prefix.back()};
  lasso.prefix.pop_back();
  lasso.closing = kIdleStep;
  CHECK(complaint_about(model, lasso) != "");
}

TEST_CASE("a finished tree stays as it is while time passes") {
  const Lowered model(kTree);
  const StatePredicate ended = predicate(model, "(root.ended and w == Calm)");
  Lasso lasso = found_run(model, ended);
  const RunState last = lasso.prefix.back();
  lasso.cycle = {{last.state, kIdleStep}};
  lasso.closing = kIdleStep;
  std::string error;
  const auto run = replay(model.system, lasso, error);
  REQUIRE(run.has_value());
  CHECK(run->loop == lasso.prefix.size());
  CHECK(run->state(run->steps.size()) == run->state(run->loop));
}

// A run to the end of the tree, and on for ever.
Run ended_run(const Lowered& model) {
  Lasso lasso =
      found_run(model, predicate(model, "(root.success and w == Calm)"));
  const StateVector last = lasso.prefix.back().state;
  lasso.cycle = {{last, kIdleStep}};
  lasso.closing = kIdleStep;
  std::string error;
  auto run = replay(model.system, lasso, error);
  REQUIRE(run.has_value());
  return *std::move(run);
}

TEST_CASE("a run that does not end where it should is seen through") {
  const Lowered model(kTree);
  const Run run = ended_run(model);
  CHECK(ends_with(model.network, run, predicate(model, "root.success")));
  CHECK(!ends_with(model.network, run, predicate(model, "root.failure")));
  CHECK(!ends_with(model.network, run, predicate(model, "stuck")));
  const Lowered still("(BehaviorTree :name t (Action :ID a :SF))");
  std::string error;
  const auto dead_run =
      replay(still.system, found_run(still, predicate(still, "dead")), error);
  REQUIRE(dead_run.has_value());
  CHECK(ends_with(still.network, *dead_run, predicate(still, "dead")));
  CHECK(!ends_with(still.network, *dead_run, predicate(still, "stuck")));
}

TEST_CASE("a run that satisfies a formula does not violate it") {
  const Lowered model(kTree);
  const Run run = ended_run(model);
  FormulaPool pool;
  const FormulaId succeeds = pool.unary(FormulaKind::Eventually, pool.atom(0));
  const FormulaId stays = pool.unary(FormulaKind::Always, succeeds);
  const FormulaId fails = pool.unary(FormulaKind::Eventually, pool.atom(1));
  const std::vector<StatePredicate> atoms = {predicate(model, "root.success"),
                                             predicate(model, "root.failure")};
  CHECK(!violates(model.network, run, pool, succeeds, atoms));
  CHECK(!violates(model.network, run, pool, stays, atoms));
  CHECK(violates(model.network, run, pool, fails, atoms));
  CHECK(violates(model.network, run, pool,
                 pool.unary(FormulaKind::Always, pool.atom(0)), atoms));
  Run finite = run;
  finite.loop = kNoLoop;
  CHECK(!violates(model.network, finite, pool, fails, atoms));
}

TEST_CASE("a loop in which only free variables move shows nothing") {
  const Lowered model(kTree);
  Run run = ended_run(model);
  FormulaPool pool;
  const FormulaId fails = pool.unary(FormulaKind::Eventually, pool.atom(0));
  const std::vector<StatePredicate> atoms = {predicate(model, "root.failure")};
  CHECK(violates(model.network, run, pool, fails, atoms));
  for (std::size_t i = run.loop; i < run.steps.size(); ++i) {
    run.steps[i].step.progress = false;
    run.steps[i].step.elapsed = 0;
  }
  CHECK(!violates(model.network, run, pool, fails, atoms));
  CHECK(!leaves_unanswered(model.network, run, predicate(model, "tick"),
                           predicate(model, "root.failure"), 0, 50, 1));
}

// The first state of the run in which the predicate holds.
std::size_t first_state(const Lowered& model, const Run& run,
                        const StatePredicate& sought) {
  const NetworkInterpreter interpreter(model.network);
  std::size_t at = 0;
  while (at < run.state_count() && !interpreter.is_true(sought, run.state(at)))
    ++at;
  REQUIRE(at < run.state_count());
  return at;
}

TEST_CASE("a run that answers in time leaves nothing unanswered") {
  const Lowered model(kTree);
  Run run = ended_run(model);
  const StatePredicate first = predicate(model, "z.running");
  const StatePredicate second = predicate(model, "e.ticked");
  const StatePredicate never = predicate(model, "root.failure");
  const std::size_t at = first_state(model, run, first);
  const auto unanswered = [&](const StatePredicate& answer, int from, int to,
                              std::size_t state) {
    return leaves_unanswered(model.network, run, first, answer, from, to,
                             state);
  };
  // Wait 2: first running at time 1, e is ticked at time 3.
  CHECK(unanswered(second, 0, 1, at));
  CHECK(!unanswered(second, 0, 2, at));
  CHECK(!unanswered(second, 2, 2, at));
  CHECK(!unanswered(second, 0, 9, at));
  CHECK(unanswered(never, 0, 1, at));
  CHECK(!unanswered(never, 0, 1, 0));
  CHECK(!unanswered(never, 0, 99, at));
  run.loop = kNoLoop;
  CHECK(!unanswered(never, 0, 99, at));
}

TEST_CASE("the interpreter takes the steps that the search sees") {
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
        TickSemantics::None}) {
    CAPTURE(tick_name(ticks));
    const Lowered model(kTree, ticks);
    struct Counter : ReachabilityVisitor {
      GoOn expanded(StateId id, StateView, bool) {
        last = id;
        return GoOn::Yes;
      }
      StateId last{};
    } counter;
    const Limits limits;
    BreadthFirst search(model.system, limits);
    search.run(counter);
    for (std::uint32_t id = 0; id <= index(counter.last); ++id) {
      CHECK(complaint_about(model, {search.path_to(StateId{id}), {}, {}}) ==
            "");
    }
  }
}

}  // namespace
}  // namespace btcheck
