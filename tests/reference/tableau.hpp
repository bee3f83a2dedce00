// SPDX-License-Identifier: MIT
//
// Model checking of toy systems by tableau.
#pragma once

#include <vector>

#include "ltl/formula/formula.hpp"
#include "reference/strong_fairness.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference {

// Whether some fair run of the system satisfies the formula.
bool some_run_satisfies(const ToySystem& system, const FormulaPool& pool,
                        FormulaId id);

// By state, whether a fair run from it satisfies the formula and every
// condition. Exponential in the number of conditions.
std::vector<bool> states_satisfying(const ToySystem& system,
                                    const FormulaPool& pool, FormulaId id,
                                    const std::vector<Condition>& conditions);

}  // namespace btcheck::reference
