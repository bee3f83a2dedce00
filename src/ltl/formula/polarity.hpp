// SPDX-License-Identifier: MIT
//
// Whether a part of a formula helps it to be true, or to be false.
#pragma once

#include <cstdint>
#include <vector>

#include "ltl/formula/formula.hpp"

namespace btcheck {

enum class Polarity : std::uint8_t { None, Positive, Negative, Both };

// How each part stands in the whole, by id: under an even number of negations,
// an odd one, or both; None for what does not occur in it.
std::vector<Polarity> polarities(const FormulaPool& pool, FormulaId whole);

}  // namespace btcheck
