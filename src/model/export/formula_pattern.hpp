// SPDX-License-Identifier: MIT
//
// Formulas in which p0, p1, … stand for propositions.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace btcheck {

// The formula with each p0, p1, … replaced by what `text` makes of its number.
// Only a whole word counts: `xp0` stays.
std::string with_propositions(
    std::string_view formula,
    const std::function<std::string(std::size_t)>& text);

}  // namespace btcheck
