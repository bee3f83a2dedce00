// SPDX-License-Identifier: MIT
//
// The search under strong fairness against naive ones, on random toy systems.
//
// Once with random formulas, against the tableau of the formula that the
// conditions are part of; once without a formula, on larger systems and more
// conditions, so that components fall apart several times, against all choices
// of what is granted. Every run told is held against the definitions.
#include <doctest/doctest.h>

#include <algorithm>

#include "ltl/buchi/translate.hpp"
#include "ltl/product/accepting_cycle.hpp"
#include "ltl/product/product.hpp"
#include "reference/effort.hpp"
#include "reference/random_ltl.hpp"
#include "reference/strong_fairness.hpp"
#include "reference/tableau.hpp"

namespace btcheck::reference::strong_fairness_cross_check_test {

namespace {

struct Census {
  int cases = 0;
  int violated = 0;
  int violated_without = 0;  // without the conditions
  int told = 0;              // steps, of all runs
};

std::mt19937 generator(unsigned seed) {
  return std::mt19937(shifted_seed(seed));
}

std::vector<Condition> random_conditions(std::mt19937& random, unsigned count,
                                         std::uint32_t propositions) {
  std::vector<Condition> conditions(count);
  for (Condition& condition : conditions) {
    condition.requested = static_cast<std::uint32_t>(random() % propositions);
    const auto further =
        static_cast<std::uint32_t>(random() % (propositions - 1));
    condition.granted = (condition.requested + 1 + further) % propositions;
  }
  return conditions;
}

// What is wrong with a lasso that is said to be a fair run that satisfies the
// formula, or nullptr.
const char* flaw(const ToySystem& system, const FormulaPool& pool, FormulaId id,
                 const std::vector<Condition>& conditions, const Lasso& lasso) {
  if (lasso.prefix.empty() || lasso.cycle.empty()) return "a part is empty";
  if (!is_run(system, lasso)) return "it is no run";
  if (!is_fair(lasso)) return "it makes no progress";
  LassoWord word;
  for (const RunState& moment : lasso.prefix) {
    word.prefix.push_back(system.label(moment.state));
  }
  for (const RunState& moment : lasso.cycle) {
    word.cycle.push_back(system.label(moment.state));
  }
  if (!is_strongly_fair(word, conditions)) return "it is not strongly fair";
  if (!holds(pool, id, word)) return "it does not satisfy the formula";
  return nullptr;
}

// Searches for a fair run that satisfies the formula, and says what is wrong
// with the answer, or nullptr.
const char* searched(const ToySystem& system, Justice justice,
                     FormulaPool& pool, FormulaId id,
                     const std::vector<Condition>& conditions, bool expected,
                     Census& census) {
  const auto automaton = translate(pool, id);
  if (!automaton) return "it is too large";
  const Product product(system, *automaton, justice);
  const ToyFairness asked(system, conditions);
  const StrongFairness fairness = asked.fairness();
  const Limits limits;
  const RunSearch search = find_accepting_cycle(product, limits, fairness);
  ++census.cases;
  if (find_accepting_cycle(product, limits).lasso) ++census.violated_without;
  if (search.outcome == SearchOutcome::GaveUp) return "it gave up";
  if (asked.asked() > search.progress.states) return "it asks twice";
  if ((search.outcome == SearchOutcome::Found) != expected) {
    return expected ? "there is a run" : "there is no run";
  }
  if (search.lasso.has_value() != expected) return "the run is missing";
  if (!expected) return nullptr;
  ++census.violated;
  census.told += static_cast<int>(length(*search.lasso));
  return flaw(system, pool, id, conditions, *search.lasso);
}

void show(const Census& census) {
  const auto share = [&](int part) { return 100 * part / census.cases; };
  MESSAGE(census.cases << " cases, " << share(census.violated)
                       << " % violated, "
                       << share(census.violated_without - census.violated)
                       << " % only without the conditions, " << census.told
                       << " steps told");
}

Justice justice_of_round(int round) {
  return round % 2 == 0 ? Justice::EveryStepIsProgress
                        : Justice::SomeStepsAreNot;
}

// States with few propositions and few steps, mostly to their neighbours.
ToySystem random_ring(std::mt19937& random, std::uint32_t propositions,
                      Justice justice) {
  const auto below = [&](std::uint32_t bound) {
    return static_cast<std::uint32_t>(random() % bound);
  };
  ToySystem system;
  const std::uint32_t size = 6 + below(20);
  for (std::uint32_t i = 0; i < size; ++i) {
    PropositionSet label = 0;
    for (std::uint32_t k = below(4); k > 0; --k) {
      label |= PropositionSet{1} << below(propositions);
    }
    system.add(label);
  }
  std::uint32_t edge = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    const auto step = [&](std::uint32_t target) {
      const bool progress =
          justice == Justice::EveryStepIsProgress || below(5) != 0;
      system.add_step(i, target, {edge++, 0, progress});
    };
    if (below(5) != 0) step((i + 1) % size);
    if (below(2) != 0) step((i + size - 1 - below(4)) % size);
    if (below(6) == 0) step(below(size));
    if (below(8) == 0) step(i);
  }
  system.add_initial(below(size));
  return system;
}

}  // namespace

TEST_CASE("conditions change a verdict as they do as part of the formula") {
  constexpr std::uint32_t kAtoms = 3;
  std::mt19937 random = generator(41);
  Census census;
  const int rounds = by_effort(1000, 20000);
  for (int round = 0; round < rounds; ++round) {
    const Justice justice = justice_of_round(round);
    const ToySystem system = random_system(random, kAtoms, justice);
    FormulaPool pool;
    const auto count = std::min(static_cast<unsigned>(random() % 7), 3u);
    const auto conditions = random_conditions(random, count, kAtoms);
    const int size = 1 + static_cast<int>(random() % (8 - count));
    const FormulaId id = random_formula(pool, random, size, kAtoms);
    const FormulaId negated = pool.unary(FormulaKind::Not, id);
    const bool expected = some_run_satisfies(
        system, pool,
        pool.unary(FormulaKind::Not, under_conditions(pool, conditions, id)));
    const char* wrong =
        searched(system, justice, pool, negated, conditions, expected, census);
    const std::string text =
        shown(pool, under_conditions(pool, conditions, id));
    CAPTURE(round);
    CAPTURE(text);
    REQUIRE(wrong == nullptr);
  }
  show(census);
  CHECK_COVERED(census.violated > rounds / 5);
  CHECK_COVERED(census.violated_without - census.violated > rounds / 25);
}

TEST_CASE("a strongly fair run is found iff a choice of grants has one") {
  constexpr std::uint32_t kPropositions = 8;
  std::mt19937 random = generator(42);
  Census census;
  const int rounds = by_effort(3000, 60000);
  for (int round = 0; round < rounds; ++round) {
    const Justice justice = justice_of_round(round);
    const ToySystem system = random_ring(random, kPropositions, justice);
    const auto conditions = random_conditions(
        random, static_cast<unsigned>(random() % 7), kPropositions);
    FormulaPool pool;
    const char* wrong =
        searched(system, justice, pool, pool.constant(true), conditions,
                 has_strongly_fair_run(system, conditions), census);
    CAPTURE(round);
    REQUIRE(wrong == nullptr);
  }
  show(census);
  CHECK_COVERED(census.violated > rounds / 5);
  CHECK_COVERED(census.violated_without - census.violated > rounds / 25);
}

}  // namespace btcheck::reference::strong_fairness_cross_check_test
