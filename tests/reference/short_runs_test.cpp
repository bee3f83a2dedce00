// SPDX-License-Identifier: MIT
//
// Runs told to people are short: near lassos, and prefixes that are bad enough.
#include <doctest/doctest.h>

#include <random>

#include "ltl/buchi/translate.hpp"
#include "ltl/formula_text.hpp"
#include "ltl/product/bad_prefix.hpp"
#include "ltl/product/near_lasso.hpp"
#include "ltl/product/product.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::short_runs_test {

namespace {

using reference::ToySystem;

constexpr Step kMove{.edge = 0, .elapsed = 0, .progress = true};

BuchiAutomaton automaton_of(std::string_view formula) {
  FormulaPool pool;
  const auto automaton = translate(pool, parse(pool, formula));
  REQUIRE(automaton);
  return *automaton;
}

// A way of `length` states to a state with `a` and a step to itself.
std::uint32_t add_way(ToySystem& system, std::uint32_t length) {
  std::uint32_t next = system.add(1);
  system.add_step(next, next, kMove);
  for (std::uint32_t i = 0; i < length; ++i) {
    next = system.add(0, {{next, kMove}});
  }
  return next;
}

}  // namespace

TEST_CASE("of two fair runs the one near the start is told") {
  // Depth-first search takes the long way first, whichever it is.
  for (const bool is_long_first : {true, false}) {
    ToySystem system;
    const std::uint32_t far = add_way(system, 200);
    const std::uint32_t near = add_way(system, 2);
    const std::uint32_t start = system.add(0);
    system.add_step(start, is_long_first ? far : near, kMove);
    system.add_step(start, is_long_first ? near : far, kMove);
    system.add_initial(start);
    const BuchiAutomaton automaton = automaton_of("[]<>a");
    const Product product(system, automaton, Justice::EveryStepIsProgress);
    const RunSearch search = find_short_run(product, Limits{});
    REQUIRE(search.lasso);
    CHECK(length(*search.lasso) <= 6);
    CHECK(reference::is_run(system, *search.lasso));
  }
}

TEST_CASE("a short run is no longer than what depth-first search finds") {
  std::mt19937 random(11);
  for (int round = 0; round < 500; ++round) {
    CAPTURE(round);
    const ToySystem system =
        reference::random_system(random, 2, Justice::EveryStepIsProgress);
    for (const std::string_view formula :
         {"[]<>a", "<>[]b", "[]<>a && []<>!b", "a U b"}) {
      const BuchiAutomaton automaton = automaton_of(formula);
      const Product product(system, automaton, Justice::EveryStepIsProgress);
      const RunSearch deep = find_accepting_cycle(product, Limits{});
      const RunSearch near = find_short_run(product, Limits{});
      REQUIRE(deep.outcome == near.outcome);
      if (!deep.lasso) continue;
      CHECK(reference::is_run(system, *near.lasso));
      CHECK(length(*near.lasso) <= length(*deep.lasso));
    }
  }
}

TEST_CASE("the automaton of what is broken at one moment ends in a state") {
  CHECK(universal_state(automaton_of("<>a")));
  CHECK(universal_state(automaton_of("!((!a) W b)")));
  CHECK(!universal_state(automaton_of("[]<>a")));
  CHECK(!universal_state(automaton_of("[]a")));
}

TEST_CASE("a bad prefix ends one step behind what breaks the rule") {
  ToySystem system;
  const std::uint32_t start = add_way(system, 5);
  system.add_initial(start);
  const BuchiAutomaton automaton = automaton_of("<>a");
  const Product product(system, automaton, Justice::EveryStepIsProgress);
  const Limits limits;
  const auto prefix =
      find_bad_prefix(product, limits, *universal_state(automaton), 1000);
  REQUIRE(prefix);
  CHECK(prefix->size() == 7);  // five states, the one with a, and one more
  CHECK(!find_bad_prefix(product, limits, *universal_state(automaton), 3));
}

TEST_CASE("limits end the search for a shorter run, not the verdict") {
  ToySystem system;
  const std::uint32_t start = add_way(system, 50);
  system.add_initial(start);
  const BuchiAutomaton automaton = automaton_of("[]<>a");
  const Product product(system, automaton, Justice::EveryStepIsProgress);
  Limits few;
  few.max_states = 60;
  const RunSearch search = find_short_run(product, few);
  CHECK(search.outcome == SearchOutcome::Found);
  CHECK(search.lasso.has_value());
}

}  // namespace btcheck::short_runs_test
