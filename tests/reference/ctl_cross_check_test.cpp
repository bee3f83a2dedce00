// SPDX-License-Identifier: MIT
//
// CTL on stored graphs against enumeration, on random systems and formulas.
//
// Every state of every system is compared, under justice and up to two random
// strong fairness conditions; every path told in favour of a formula or
// against it is taken as evidence and examined. Where CTL and LTL meet, E over
// one operator, the tableau of the LTL tests is asked as well.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "ltl/branching/ctl.hpp"
#include "reference/ctl_evidence.hpp"
#include "reference/effort.hpp"
#include "reference/naive_ctl.hpp"
#include "reference/random_ctl.hpp"
#include "reference/random_ltl.hpp"
#include "reference/tableau.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference::ctl_cross_check_test {

namespace {

constexpr std::uint32_t kAtoms = 3;
constexpr int kLargest = 9;

int cases() { return by_effort(500, 20000); }

StoredGraph stored(const ToySystem& system) {
  StoredGraph graph;
  for (std::uint32_t s = 0; s < system.size(); ++s) {
    for (const ToySystem::ToyStep& step : system.steps(s)) {
      graph.add(StateId{s}, step.step, StateId{step.target});
    }
  }
  graph.close(system.size());
  return graph;
}

StateSet set_of(StateMask states, std::size_t size) {
  return StateSet(size, states);
}

std::vector<StateSet> propositions(const ToySystem& system) {
  std::vector<StateSet> sets(kAtoms, StateSet(system.size()));
  for (std::size_t s = 0; s < system.size(); ++s) {
    for (std::uint32_t atom = 0; atom < kAtoms; ++atom) {
      if ((system.label_of(s) >> atom & 1) != 0) sets[atom].set(s);
    }
  }
  return sets;
}

std::vector<FairnessSets> converted(
    const std::vector<NaiveFairness>& conditions, std::size_t size) {
  std::vector<FairnessSets> converted;
  for (const NaiveFairness& condition : conditions) {
    converted.push_back(
        {set_of(condition.requested, size), set_of(condition.granted, size)});
  }
  return converted;
}

// Requested where one state in two is, granted where one in four.
std::vector<NaiveFairness> random_conditions(std::mt19937& random, int count,
                                             std::size_t size) {
  const StateMask all = (StateMask{1} << size) - 1;
  std::vector<NaiveFairness> conditions;
  for (int i = 0; i < count; ++i) {
    const auto requested = static_cast<StateMask>(random());
    const auto granted = static_cast<StateMask>(random() & random());
    conditions.push_back({requested & all, granted & all});
  }
  return conditions;
}

// One system with its fairness, for both engines.
struct Subject {
  Subject(std::mt19937& random, int round)
      : system(random_system(random, kAtoms,
                             round / 3 % 2 == 0 ? Justice::EveryStepIsProgress
                                                : Justice::SomeStepsAreNot)),
        graph(stored(system)),
        conditions(random_conditions(random, round % 3, system.size())),
        naive(system, conditions) {}

  ToySystem system;
  StoredGraph graph;
  std::vector<NaiveFairness> conditions;
  NaiveCtl naive;
};

struct Count {
  int formulas = 0;
  int states = 0;
  int satisfying = 0;
  int unfair_states = 0;
  int paths = 0;
  int lassos = 0;
  int proofs = 0;
  std::size_t steps = 0;
};

// What is wrong with a path that is told, or with there being none.
std::string path_flaw(const Subject& subject, CtlChecker& checker, Claim claim,
                      StateId state, Count& count) {
  const FormulaPool& pool = checker.formulas();
  if (demonstrate(checker, {claim.formula, !claim.holds}, state)) {
    return "a path for what is not so";
  }
  const auto path = demonstrate(checker, claim, state);
  const FormulaKind kind = pool[claim.formula].kind;
  if (!path) {
    const bool is_about_a_run =
        is_leaf(kind) || (is_path_quantifier(kind) &&
                          claim.holds == (kind == FormulaKind::ExistsPath));
    return is_about_a_run ? "no path" : "";
  }
  ++count.paths;
  count.lassos += path->loop != GraphPath::kFinite;
  count.proofs += path->is_complete();
  count.steps += path->states.size() - 1;
  const char* found = flaw(subject.system, subject.naive, subject.conditions,
                           pool, *path, claim, index(state));
  return found ? found : "";
}

std::string compare(const Subject& subject, FormulaPool& pool, FormulaId id,
                    Count& count) {
  if (first_non_ctl(pool, id)) return "called no CTL";
  const std::size_t size = subject.system.size();
  const auto runs = std::make_shared<FairRuns>(
      subject.graph, converted(subject.conditions, size));
  CtlChecker checker(runs, pool, propositions(subject.system));
  if (checker.runs().starts() != set_of(subject.naive.fair_within(~0u), size)) {
    return "the fair states differ";
  }
  const StateSet found = checker.satisfying(id);
  const StateSet expected = set_of(subject.naive.satisfying(pool, id), size);
  if (found != expected) return "the states differ";
  ++count.formulas;
  count.states += static_cast<int>(size);
  count.satisfying += static_cast<int>(found.count());
  count.unfair_states +=
      static_cast<int>(size - checker.runs().starts().count());
  for (std::uint32_t s = 0; s < size; ++s) {
    const std::string problem =
        path_flaw(subject, checker, {id, found[s]}, StateId{s}, count);
    if (!problem.empty()) return "a path from some state: " + problem;
  }
  return {};
}

}  // namespace

TEST_CASE("CTL agrees with enumeration in every state, and paths are proofs") {
  std::mt19937 random(shifted_seed(21));
  Count count;
  for (int round = 0; round < cases(); ++round) {
    const Subject subject(random, round);
    FormulaPool pool;
    const int size = 2 + static_cast<int>(random() % (kLargest - 1));
    const FormulaId id = random_ctl(pool, random, size, kAtoms);
    std::string problem = compare(subject, pool, id, count);
    if (problem.empty()) continue;
    Count ignored;
    const FormulaId small = shrunk(pool, id, [&](FormulaId smaller) {
      return !first_non_ctl(pool, smaller) &&
             !compare(subject, pool, smaller, ignored).empty();
    });
    problem = compare(subject, pool, small, ignored);
    FAIL("round ", round, ": ", shown(pool, small), ": ", problem);
  }
  MESSAGE(count.formulas, " formulas; ", count.satisfying, " of ", count.states,
          " states satisfy theirs; no fair run begins in ",
          count.unfair_states);
  MESSAGE(count.paths, " paths of ", count.steps, " steps, ", count.lassos,
          " end with a cycle, ", count.proofs, " leave nothing unshown");
  CHECK_COVERED(count.satisfying > count.states / 3);
  CHECK_COVERED(count.satisfying < 2 * count.states / 3);
  CHECK_COVERED(count.unfair_states > count.states / 50);
  CHECK_COVERED(count.proofs > count.paths / 2);
  CHECK_COVERED(count.lassos > count.paths / 20);
}

TEST_CASE("where CTL and LTL meet, the tableau agrees") {
  std::mt19937 random(shifted_seed(22));
  int found = 0;
  for (int round = 0; round < cases(); ++round) {
    const Subject subject(random, 3 * round);
    FormulaPool pool;
    // One operator over formulas about a state.
    const auto state_formula = [&] {
      FormulaId id{};
      do {
        id = random_ctl(pool, random, 1 + static_cast<int>(random() % 3),
                        kAtoms);
      } while (!pool.is_state_formula(id));
      return id;
    };
    constexpr FormulaKind kPath[] = {
        FormulaKind::Next,  FormulaKind::Eventually, FormulaKind::Always,
        FormulaKind::Until, FormulaKind::WeakUntil,  FormulaKind::Release};
    const FormulaKind kind = kPath[random() % std::size(kPath)];
    const FormulaId left = state_formula();
    const FormulaId path = is_unary(kind)
                               ? pool.unary(kind, left)
                               : pool.binary(kind, left, state_formula());
    // If b is seen infinitely often, so is c.
    const auto infinitely_often = [&](std::uint32_t atom) {
      return pool.unary(FormulaKind::Always,
                        pool.unary(FormulaKind::Eventually, pool.atom(atom)));
    };
    const FormulaId fair = pool.binary(
        FormulaKind::Implies, infinitely_often(1), infinitely_often(2));
    const std::vector<StateSet> sets = propositions(subject.system);
    const auto runs = std::make_shared<FairRuns>(
        subject.graph, std::vector<FairnessSets>{{sets[1], sets[2]}});
    CtlChecker checker(runs, pool, sets);
    const StateSet& expected =
        checker.satisfying(pool.unary(FormulaKind::ExistsPath, path));
    bool some = false;
    for (const std::uint32_t s : subject.system.initial()) {
      some = some || expected[s];
    }
    const std::string text = shown(pool, path);
    CAPTURE(round);
    CAPTURE(text);
    REQUIRE(some_run_satisfies(subject.system, pool,
                               pool.binary(FormulaKind::And, path, fair)) ==
            some);
    found += some;
  }
  CHECK_COVERED(found > cases() / 4);
  CHECK_COVERED(found < cases() * 9 / 10);
}

}  // namespace btcheck::reference::ctl_cross_check_test
