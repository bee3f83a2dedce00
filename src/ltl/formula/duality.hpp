// SPDX-License-Identifier: MIT
//
// The operator that says the same of negated operands, negated.
#pragma once

#include "ltl/formula/formula.hpp"

namespace btcheck {

// not (a U b) = (not a) R (not b), and so on; operators without a dual of their
// own are returned as they are. The dual of W is U on other operands.
constexpr FormulaKind dual(FormulaKind kind) {
  switch (kind) {
    case FormulaKind::And:
      return FormulaKind::Or;
    case FormulaKind::Or:
      return FormulaKind::And;
    case FormulaKind::Eventually:
      return FormulaKind::Always;
    case FormulaKind::Always:
      return FormulaKind::Eventually;
    case FormulaKind::Until:
      return FormulaKind::Release;
    case FormulaKind::Release:
      return FormulaKind::Until;
    default:
      return kind;
  }
}

}  // namespace btcheck
