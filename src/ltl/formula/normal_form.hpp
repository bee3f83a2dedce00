// SPDX-License-Identifier: MIT
//
// Negation normal form, and the rewriting that makes formulas small.
#pragma once

#include "ltl/formula/formula.hpp"

namespace btcheck {

// An equivalent formula of True, False, literals, And, Or, Next, Until and
// Release alone; a negation stands in front of atoms only. Eventually is
// written `true U a` and Always `false R a`. Linear in the formula as a graph.
FormulaId negation_normal_form(FormulaPool& pool, FormulaId id);

// An equivalent formula in negation normal form, made small by rewriting.
FormulaId simplify(FormulaPool& pool, FormulaId id);

}  // namespace btcheck
