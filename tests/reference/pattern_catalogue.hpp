// SPDX-License-Identifier: MIT
//
// The catalogue of specification patterns, copied row by row.
#pragma once

#include "ltl/formula/formula.hpp"
#include "ltl/formula/pattern.hpp"

namespace btcheck::reference {

// The patterns' operands are p and q, as `P leadsto Q` and `P precedes Q` have
// them; the scope is opened by a and closed by r.
FormulaId catalogued(FormulaPool& pool, Pattern pattern, ScopeKind scope,
                     FormulaId p, FormulaId q, FormulaId a, FormulaId r);

}  // namespace btcheck::reference
