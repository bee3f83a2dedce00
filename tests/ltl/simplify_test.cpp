// SPDX-License-Identifier: MIT
//
// Reductions of Büchi automata, on small ones written down.
#include "ltl/buchi/simplify.hpp"

#include <doctest/doctest.h>

#include "ltl/buchi/components.hpp"

namespace btcheck::simplify_test {

namespace {

constexpr PropositionSet kA = 1;
constexpr PropositionSet kB = 2;

// The automaton of <>[]a: waits in 0, guesses, stays in 1.
BuchiAutomaton eventually_always_a() {
  BuchiAutomaton automaton;
  automaton.acceptance_sets = 1;
  automaton.transitions = {{{0, 0, 0, 0}, {kA, 0, 0, 1}}, {{kA, 0, 1, 1}}};
  return automaton;
}

}  // namespace

TEST_CASE("a cube is covered by cubes that cover it together") {
  const Cube all{};
  const Cube a{kA, 0};
  const Cube not_a{0, kA};
  const Cube a_and_b{kA | kB, 0};
  const std::vector<Cube> halves = {a, not_a};
  const std::vector<Cube> parts = {a_and_b, not_a};
  CHECK(is_covered(all, halves));
  CHECK(is_covered(a_and_b, halves));
  CHECK_FALSE(is_covered(all, parts));
  CHECK(is_covered({kB, 0}, parts));
  CHECK_FALSE(is_covered(all, {}));
}

TEST_CASE("components come targets first and know what they accept") {
  const Components components(eventually_always_a());
  REQUIRE(components.count() == 2);
  CHECK(components.of(1) == 0);
  CHECK(components.is_accepting(0));
  CHECK(components.has_cycle(1));
  CHECK_FALSE(components.is_accepting(1));
}

TEST_CASE("a state that leads to no accepting component goes") {
  BuchiAutomaton automaton = eventually_always_a();
  automaton.transitions.push_back({{0, 0, 0, 2}});
  automaton.transitions[0].push_back({kB, 0, 0, 2});
  clean_up(automaton);
  CHECK(automaton.state_count() == 2);
  CHECK(automaton.transitions[0].size() == 2);
}

TEST_CASE("an automaton that accepts nothing becomes empty") {
  BuchiAutomaton automaton = eventually_always_a();
  automaton.transitions[1][0].accepting = 0;
  clean_up(automaton);
  CHECK(automaton.is_empty());
}

TEST_CASE("an acceptance set that contains another goes") {
  BuchiAutomaton automaton;
  automaton.acceptance_sets = 2;
  automaton.transitions = {{{kA, 0, 3, 0}, {0, kA, 2, 0}, {kB, 0, 0, 0}}};
  clean_up(automaton);
  CHECK(automaton.acceptance_sets == 1);
  CHECK(automaton.transitions[0] ==
        std::vector<BuchiTransition>{
            {0, kA, 0, 0}, {kA, 0, 1, 0}, {kB, 0, 0, 0}});
}

TEST_CASE("a set that every cycle meets goes") {
  BuchiAutomaton automaton;
  automaton.acceptance_sets = 1;
  automaton.transitions = {{{kA, 0, 1, 1}}, {{kB, 0, 0, 0}}};
  clean_up(automaton);
  CHECK(automaton.acceptance_sets == 0);
  CHECK(automaton.state_count() == 2);
}

TEST_CASE("marks between components go") {
  BuchiAutomaton automaton = eventually_always_a();
  automaton.transitions[0][1].accepting = 1;
  clean_up(automaton);
  CHECK(automaton.transitions == eventually_always_a().transitions);
}

TEST_CASE("states with equal transitions become one") {
  BuchiAutomaton automaton;
  automaton.transitions = {{{kA, 0, 0, 1}}, {{kA, 0, 0, 2}}, {{kA, 0, 0, 0}}};
  merge_bisimilar(automaton);
  CHECK(automaton.state_count() == 1);
}

TEST_CASE("a transition that others answer together goes") {
  // b, or a, or not a; all to the same state.
  BuchiAutomaton automaton;
  automaton.transitions = {{{kA, 0, 0, 0}, {0, kA, 0, 0}, {kB, 0, 0, 0}}};
  merge_similar(automaton);
  CHECK(automaton.transitions[0] == std::vector<BuchiTransition>{{0, 0, 0, 0}});
}

TEST_CASE("states with the same past become one") {
  // a, then b one way and not b the other, then a for ever.
  BuchiAutomaton automaton;
  automaton.transitions = {{{kA, 0, 0, 1}, {kA, 0, 0, 2}},
                           {{kB, 0, 0, 3}},
                           {{0, kB, 0, 3}},
                           {{kA, 0, 0, 3}}};
  reduce(automaton);
  CHECK(automaton.state_count() == 3);
}

TEST_CASE("an obligation gets its minimal deterministic automaton") {
  BuchiAutomaton eventually;  // <>a, with a needless guess
  eventually.acceptance_sets = 1;
  eventually.transitions = {{{0, 0, 0, 0}, {kA, 0, 0, 1}}, {{0, 0, 1, 1}}};
  BuchiAutomaton never;
  never.transitions = {{{0, kA, 0, 0}}};
  const auto weak = minimal_weak(eventually, never);
  REQUIRE(weak);
  CHECK(weak->state_count() == 2);
  CHECK(weak->transitions[0] ==
        std::vector<BuchiTransition>{{0, kA, 0, 0}, {kA, 0, 0, 1}});
}

TEST_CASE("what is no obligation gets none") {
  BuchiAutomaton infinitely_often_not_a;
  infinitely_often_not_a.acceptance_sets = 1;
  infinitely_often_not_a.transitions = {{{0, 0, 0, 0}, {0, kA, 1, 0}}};
  CHECK_FALSE(minimal_weak(eventually_always_a(), infinitely_often_not_a));
  CHECK_FALSE(minimal_weak(infinitely_often_not_a, eventually_always_a()));
}

}  // namespace btcheck::simplify_test
