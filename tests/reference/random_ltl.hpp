// SPDX-License-Identifier: MIT
//
// Random formulas and words, and how a failing formula is made smaller.
#pragma once

#include <functional>
#include <random>
#include <string>

#include "ltl/formula/formula.hpp"
#include "reference/ltl_on_lassos.hpp"

namespace btcheck::reference {

// A formula of exactly `size` nodes over atoms 0 to atoms - 1, any operator.
FormulaId random_formula(FormulaPool& pool, std::mt19937& random, int size,
                         std::uint32_t atoms);

// A word with at most `longest` positions before the cycle and in it.
LassoWord random_word(std::mt19937& random, std::uint32_t atoms, int longest);

// A formula that still fails and of which no part does when an operator is
// replaced by one of its operands, or an operand by a constant.
FormulaId shrunk(FormulaPool& pool, FormulaId id,
                 const std::function<bool(FormulaId)>& fails);

// The text of a formula with atoms a, b, c, …
std::string shown(const FormulaPool& pool, FormulaId id);

}  // namespace btcheck::reference
