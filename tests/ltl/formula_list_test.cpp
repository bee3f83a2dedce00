// SPDX-License-Identifier: MIT
//
// Automata of the formulas of the literature stay as small as they are.
#include "ltl/formula_list.hpp"

#include <doctest/doctest.h>

#include <string>

#include "ltl/buchi/translate.hpp"
#include "ltl/formula_text.hpp"

namespace btcheck::formula_list_test {

TEST_CASE("automata of formulas from the literature do not grow") {
  for (const ListedFormula& listed : kFormulas) {
    const std::string text = listed.text;
    CAPTURE(text);
    FormulaPool pool;
    const FormulaId id = parse(pool, text);
    const auto automaton = translate(pool, id);
    const auto opposite = translate(pool, pool.unary(FormulaKind::Not, id));
    REQUIRE(automaton);
    REQUIRE(opposite);
    CHECK(automaton->state_count() <= listed.states);
    CHECK(opposite->state_count() <= listed.states_of_negation);
  }
}

}  // namespace btcheck::formula_list_test
