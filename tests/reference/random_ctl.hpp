// SPDX-License-Identifier: MIT
//
// Random formulas of CTL.
#pragma once

#include <random>

#include "ltl/formula/formula.hpp"

namespace btcheck::reference {

// A formula of CTL with exactly `size` leaves and operators over atoms 0 to
// atoms - 1, any operator; a quantifier with what it stands before counts as
// one operator.
FormulaId random_ctl(FormulaPool& pool, std::mt19937& random, int size,
                     std::uint32_t atoms);

}  // namespace btcheck::reference
