// SPDX-License-Identifier: MIT
//
// Automata of formulas: small ones known by heart, and the bounds.
#include "ltl/buchi/translate.hpp"

#include <doctest/doctest.h>

#include "ltl/formula_text.hpp"

namespace btcheck::translate_test {

namespace {

BuchiAutomaton automaton_of(std::string_view text) {
  FormulaPool pool;
  auto automaton = translate(pool, parse(pool, text));
  REQUIRE(automaton);
  return *automaton;
}

}  // namespace

TEST_CASE("false has the empty automaton") {
  CHECK(automaton_of("false").is_empty());
  CHECK(automaton_of("[]a && <>!a").is_empty());
}

TEST_CASE("true has one state that reads every label") {
  const BuchiAutomaton automaton = automaton_of("a || !a");
  REQUIRE(automaton.state_count() == 1);
  CHECK(automaton.transitions[0] == std::vector<BuchiTransition>{{0, 0, 0, 0}});
  CHECK(automaton.acceptance_sets == 0);
}

TEST_CASE("always a is one state that reads a") {
  const BuchiAutomaton automaton = automaton_of("[]a");
  REQUIRE(automaton.state_count() == 1);
  CHECK(automaton.transitions[0] == std::vector<BuchiTransition>{{1, 0, 0, 0}});
  CHECK(automaton.acceptance_sets == 0);
}

TEST_CASE("each fairness condition is an acceptance set of one state") {
  const BuchiAutomaton automaton = automaton_of("[]<>a && []<>b");
  CHECK(automaton.state_count() == 1);
  CHECK(automaton.acceptance_sets == 2);
}

TEST_CASE("atoms are mapped to propositions") {
  FormulaPool pool;
  const std::vector<int> proposition_of = {5, 63};
  const auto automaton =
      translate(pool, parse(pool, "[](a && !b)"), proposition_of);
  REQUIRE(automaton);
  REQUIRE(automaton->state_count() == 1);
  CHECK(automaton->transitions[0] ==
        std::vector<BuchiTransition>{{1u << 5, PropositionSet{1} << 63, 0, 0}});
}

TEST_CASE("a chain of then has a state for each step") {
  // <> (a0 && <> (a1 && <> (a2 && ...))): once factorially many transitions.
  constexpr std::uint32_t kSteps = 30;
  FormulaPool pool;
  FormulaId chain = pool.atom(kSteps - 1);
  for (std::uint32_t i = kSteps - 1; i-- > 0;) {
    chain = pool.binary(FormulaKind::And, pool.atom(i),
                        pool.unary(FormulaKind::Eventually, chain));
  }
  chain = pool.unary(FormulaKind::Eventually, chain);
  for (const FormulaId id : {chain, pool.unary(FormulaKind::Not, chain)}) {
    const auto automaton = translate(pool, id);
    REQUIRE(automaton);
    CHECK(automaton->state_count() <= kSteps + 1);
  }
}

TEST_CASE("a formula with an automaton too large is given up") {
  FormulaPool pool;
  FormulaId id = pool.constant(true);
  for (std::uint32_t i = 0; i < 30; ++i) {
    const FormulaId answered =
        pool.binary(FormulaKind::Implies, pool.atom(2 * i),
                    pool.unary(FormulaKind::Eventually, pool.atom(2 * i + 1)));
    id = pool.binary(FormulaKind::And, id,
                     pool.unary(FormulaKind::Always, answered));
  }
  CHECK_FALSE(translate(pool, id));
}

TEST_CASE("a limit on states is kept") {
  FormulaPool pool;
  const FormulaId id = parse(pool, "<>a && <>b && <>c && <>d && <>e");
  CHECK_FALSE(translate(pool, id, TranslationLimits{.max_states = 10}));
  CHECK(translate(pool, id, TranslationLimits{.max_states = 40}));
}

TEST_CASE("a long chain of next is translated") {
  FormulaPool pool;
  FormulaId id = pool.atom(0);
  for (int i = 0; i < 300; ++i) id = pool.unary(FormulaKind::Next, id);
  const auto automaton = translate(pool, id);
  REQUIRE(automaton);
  CHECK(automaton->state_count() == 302);
}

}  // namespace btcheck::translate_test
