// SPDX-License-Identifier: MIT
//
// Model checking of toy systems by tableau.
#pragma once

#include "ltl/formula.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference {

// Whether some fair run of the system satisfies the formula.
bool some_run_satisfies(const ToySystem& system, const FormulaPool& pool,
                        FormulaId id);

}  // namespace btcheck::reference
