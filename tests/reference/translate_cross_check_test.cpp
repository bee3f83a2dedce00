// SPDX-License-Identifier: MIT
//
// The translation of formulas against their definition, on random words.
#include <doctest/doctest.h>

#include <random>

#include "ltl/buchi/translate.hpp"
#include "ltl/formula/lasso_evaluation.hpp"
#include "ltl/formula/normal_form.hpp"
#include "reference/ltl_on_lassos.hpp"
#include "reference/random_ltl.hpp"

namespace btcheck::reference::translate_cross_check_test {

namespace {

constexpr std::uint32_t kAtoms = 3;
constexpr int kLargest = 12;

std::vector<LassoWord> random_words(std::mt19937& random, int count) {
  std::vector<LassoWord> words;
  for (int i = 0; i < count; ++i) {
    words.push_back(random_word(random, kAtoms, 4));
  }
  return words;
}

bool translates_wrongly(FormulaPool& pool, FormulaId id,
                        const std::vector<LassoWord>& words) {
  const auto automaton = translate(pool, id);
  const auto opposite = translate(pool, pool.unary(FormulaKind::Not, id));
  REQUIRE(automaton);
  REQUIRE(opposite);
  for (const LassoWord& word : words) {
    const bool expected = holds(pool, id, word);
    if (accepts(*automaton, word) != expected) return true;
    if (accepts(*opposite, word) == expected) return true;
  }
  return false;
}

bool simplifies_wrongly(FormulaPool& pool, FormulaId id,
                        const std::vector<LassoWord>& words) {
  const FormulaId normal = negation_normal_form(pool, id);
  const FormulaId small = simplify(pool, id);
  for (const LassoWord& word : words) {
    const bool expected = holds(pool, id, word);
    if (holds(pool, normal, word) != expected) return true;
    if (holds(pool, small, word) != expected) return true;
  }
  return false;
}

bool is_evaluated_wrongly(FormulaPool& pool, FormulaId id,
                          const std::vector<LassoWord>& words) {
  for (const LassoWord& word : words) {
    std::vector<PropositionSet> labels = word.prefix;
    labels.insert(labels.end(), word.cycle.begin(), word.cycle.end());
    if (holds_on_lasso(pool, id, labels, word.prefix.size()) !=
        holds(pool, id, word)) {
      return true;
    }
  }
  return false;
}

// Runs a check on random formulas and shows the smallest that fails it.
template <class Check>
void check_random_formulas(unsigned seed, int count, int words, Check&& check) {
  std::mt19937 random(seed);
  for (int i = 0; i < count; ++i) {
    FormulaPool pool;
    const int size = 1 + static_cast<int>(random() % kLargest);
    const FormulaId id = random_formula(pool, random, size, kAtoms);
    const std::vector<LassoWord> some = random_words(random, words);
    const auto fails = [&](FormulaId f) { return check(pool, f, some); };
    if (!fails(id)) continue;
    const FormulaId small = shrunk(pool, id, fails);
    FAIL_CHECK(shown(pool, small), " fails; it is what remains of ",
               shown(pool, id));
    return;
  }
}

}  // namespace

TEST_CASE("formulas are evaluated on runs as they are defined") {
  check_random_formulas(5, 5000, 40, is_evaluated_wrongly);
}

TEST_CASE("simplified formulas mean the same on random words") {
  check_random_formulas(1, 10000, 40, simplifies_wrongly);
}

TEST_CASE("automata accept the words that satisfy the formula") {
  check_random_formulas(2, 2500, 50, translates_wrongly);
}

}  // namespace btcheck::reference::translate_cross_check_test
