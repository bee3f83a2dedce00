// SPDX-License-Identifier: MIT
//
// Which formulas are CTL.
#pragma once

#include <optional>

#include "ltl/formula/formula.hpp"

namespace btcheck {

// The subformula that makes a formula something else than CTL, nothing if
// there is none: a temporal operator with no path quantifier directly above
// it, or a quantifier with no temporal operator directly below it. The first
// one as the formula is read.
std::optional<FormulaId> first_non_ctl(const FormulaPool& formulas,
                                       FormulaId formula);

}  // namespace btcheck
