// SPDX-License-Identifier: MIT
//
// The automata of the formulas of the literature mean what the formulas mean.
//
// That they are small is worth nothing by itself. Words are drawn at random
// and each is given to the automaton of the formula, to that of its negation
// and to both with acceptance on states; the formula's definition says which
// must accept. Beside that, no word at all may be accepted by the automaton
// and by its opposite, which the product of the two shows.
#include "ltl/formula_list.hpp"

#include <doctest/doctest.h>

#include <random>
#include <string>

#include "ltl/buchi/translate.hpp"
#include "ltl/formula_text.hpp"
#include "reference/effort.hpp"
#include "reference/fair_graph.hpp"
#include "reference/ltl_on_lassos.hpp"
#include "reference/random_ltl.hpp"
#include "reference/state_based.hpp"

namespace btcheck::reference::formula_list_cross_check_test {
namespace {

constexpr int kLongest = 6;

// A label of which any atom is true with one of four probabilities, so that
// words with hardly any and with nearly all are drawn as well.
PropositionSet mixed(PropositionSet label, std::mt19937& random,
                     std::uint32_t atoms, unsigned mix) {
  const PropositionSet other = random() % (PropositionSet{1} << atoms);
  switch (mix % 4) {
    case 0:
      return label & other;
    case 1:
      return label | other;
    default:
      return label;
  }
}

LassoWord mixed_word(std::mt19937& random, std::uint32_t atoms) {
  LassoWord word = random_word(random, atoms, kLongest);
  const auto before = static_cast<unsigned>(random());
  const auto after = static_cast<unsigned>(random());
  for (PropositionSet& label : word.prefix) {
    label = mixed(label, random, atoms, before);
  }
  for (PropositionSet& label : word.cycle) {
    label = mixed(label, random, atoms, after);
  }
  return word;
}

bool is_state_based(const BuchiAutomaton& automaton) {
  for (const auto& transitions : automaton.transitions) {
    for (const BuchiTransition& t : transitions) {
      if (t.accepting != transitions.front().accepting) return false;
    }
  }
  return automaton.acceptance_sets <= 1;
}

bool some_word_is_in_both(const BuchiAutomaton& left,
                          const BuchiAutomaton& right) {
  if (left.is_empty() || right.is_empty()) return false;
  const std::size_t width = right.state_count();
  FairGraph graph;
  graph.steps.resize(left.state_count() * width);
  graph.all_sets = left.all_sets() | right.all_sets() << left.acceptance_sets;
  for (std::size_t pair = 0; pair < graph.steps.size(); ++pair) {
    for (const BuchiTransition& l : left.transitions[pair / width]) {
      for (const BuchiTransition& r : right.transitions[pair % width]) {
        if (((l.present | r.present) & (l.absent | r.absent)) != 0) continue;
        graph.steps[pair].push_back(
            {l.target * width + r.target,
             l.accepting | r.accepting << left.acceptance_sets});
      }
    }
  }
  return states_with_fair_run(graph)[left.initial * width + right.initial];
}

}  // namespace

TEST_CASE("automata of formulas from the literature accept their words") {
  std::mt19937 random(shifted_seed(20));
  const int count = by_effort(400, 4000);
  for (const ListedFormula& listed : kFormulas) {
    const std::string text = listed.text;
    CAPTURE(text);
    FormulaPool pool;
    const FormulaId id = parse(pool, text);
    const std::uint32_t atoms = pool.atoms(id).back() + 1;
    const auto automaton = translate(pool, id);
    const auto opposite = translate(pool, pool.unary(FormulaKind::Not, id));
    REQUIRE(automaton);
    REQUIRE(opposite);
    const BuchiAutomaton on_states = state_based(*automaton);
    const BuchiAutomaton opposite_on_states = state_based(*opposite);
    CHECK(is_state_based(on_states));
    CHECK(is_state_based(opposite_on_states));
    CHECK_FALSE(some_word_is_in_both(*automaton, *opposite));
    CHECK_FALSE(some_word_is_in_both(on_states, opposite_on_states));
    for (int i = 0; i < count; ++i) {
      const LassoWord word = mixed_word(random, atoms);
      const bool expected = holds(pool, id, word);
      REQUIRE(accepts(*automaton, word) == expected);
      REQUIRE(accepts(*opposite, word) != expected);
      REQUIRE(accepts(on_states, word) == expected);
      REQUIRE(accepts(opposite_on_states, word) != expected);
    }
  }
}

}  // namespace btcheck::reference::formula_list_cross_check_test
