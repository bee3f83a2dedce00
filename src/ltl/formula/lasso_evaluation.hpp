// SPDX-License-Identifier: MIT
//
// The truth of a formula on one infinite run, from the definition of LTL.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "ltl/formula/formula.hpp"

namespace btcheck {

// The truth of the formula at the first position of the word
// labels[0] … labels[loop - 1] (labels[loop] … labels.back())^ω, where atom i
// is bit i. Needs loop < labels.size().
bool holds_on_lasso(const FormulaPool& formulas, FormulaId formula,
                    std::span<const PropositionSet> labels, std::size_t loop);

// The same of every formula of the pool up to this one, by FormulaId, at each
// position of labels.
std::vector<std::vector<bool>> truths_on_lasso(
    const FormulaPool& formulas, FormulaId formula,
    std::span<const PropositionSet> labels, std::size_t loop);

}  // namespace btcheck
