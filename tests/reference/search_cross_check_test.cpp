// SPDX-License-Identifier: MIT
//
// The searches for runs against naive ones, on random toy systems.
#include <doctest/doctest.h>

#include <algorithm>

#include "ltl/buchi/translate.hpp"
#include "ltl/product/accepting_cycle.hpp"
#include "ltl/product/product.hpp"
#include "ltl/timed/pattern_search.hpp"
#include "reference/effort.hpp"
#include "reference/fair_graph.hpp"
#include "reference/late_response.hpp"
#include "reference/ltl_on_lassos.hpp"
#include "reference/random_ltl.hpp"
#include "reference/tableau.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference::search_cross_check_test {

namespace {

constexpr std::uint32_t kAtoms = 3;

LassoWord word_of(const ToySystem& system, const Lasso& lasso) {
  LassoWord word;
  for (const RunState& moment : lasso.prefix) {
    word.prefix.push_back(system.label(moment.state));
  }
  for (const RunState& moment : lasso.cycle) {
    word.cycle.push_back(system.label(moment.state));
  }
  return word;
}

Justice justice_of_round(int round) {
  return round % 2 == 0 ? Justice::EveryStepIsProgress
                        : Justice::SomeStepsAreNot;
}

// What is wrong with a lasso that is said to satisfy the formula, or nullptr.
const char* flaw(const ToySystem& system, const FormulaPool& pool, FormulaId id,
                 const Lasso& lasso) {
  if (lasso.prefix.empty() || lasso.cycle.empty()) return "a part is empty";
  if (!is_run(system, lasso)) return "it is no run";
  if (!is_fair(lasso)) return "it is not fair";
  if (!holds(pool, id, word_of(system, lasso))) return "it does not satisfy";
  return nullptr;
}

}  // namespace

TEST_CASE("the search finds a run that satisfies a formula iff there is one") {
  std::mt19937 random(3);
  int found = 0;
  for (int round = 0; round < 4000; ++round) {
    const Justice justice = justice_of_round(round);
    const ToySystem system = random_system(random, kAtoms, justice);
    FormulaPool pool;
    const int size = 1 + static_cast<int>(random() % 8);
    const FormulaId id = random_formula(pool, random, size, kAtoms);
    const auto automaton = translate(pool, id);
    REQUIRE(automaton);
    const Product product(system, *automaton, justice);
    const RunSearch search = find_accepting_cycle(product, Limits{});
    const bool expected = some_run_satisfies(system, pool, id);
    const std::string text = shown(pool, id);
    CAPTURE(round);
    CAPTURE(text);
    REQUIRE((search.outcome == SearchOutcome::Found) == expected);
    REQUIRE(search.lasso.has_value() == expected);
    if (!expected) continue;
    ++found;
    REQUIRE(flaw(system, pool, id, *search.lasso) == nullptr);
  }
  CHECK_COVERED(found > 500);
  CHECK(found < 3500);
}

TEST_CASE("a response in time is missed iff a naive search misses it") {
  std::mt19937 random(4);
  int outcomes[3] = {0, 0, 0};  // none, finite, infinite
  for (int round = 0; round < 20000; ++round) {
    const ToySystem system = random_system(random, 2, justice_of_round(round));
    TimedPattern response;
    response.from = static_cast<int>(random() % 3);
    response.to = response.from + static_cast<int>(random() % 4);
    const PatternRun search = find_violation(system, response, Limits{});
    const LateResponse expected = late_response(system, response);
    CAPTURE(round);
    REQUIRE((search.outcome == SearchOutcome::Found) == expected.exists);
    REQUIRE(search.lasso.has_value() == expected.exists);
    if (!expected.exists) {
      ++outcomes[0];
      REQUIRE(search.triggers == expected.triggers);
      REQUIRE(search.longest_answer == expected.longest_answer);
      continue;
    }
    REQUIRE(is_run(system, *search.lasso));
    REQUIRE(
        misses_response(system, response, *search.lasso, search.trigger_index));
    if (expected.fewest_steps) {
      ++outcomes[1];
      REQUIRE(search.lasso->cycle.empty());
      REQUIRE(search.lasso->prefix.size() == *expected.fewest_steps + 1);
    } else {
      ++outcomes[2];
      REQUIRE(is_fair(*search.lasso));
    }
  }
  for (const int count : outcomes) CHECK_COVERED(count > 100);
}

}  // namespace btcheck::reference::search_cross_check_test
