// SPDX-License-Identifier: MIT
//
// Patterns that stand for several names.
#pragma once

#include <string_view>

namespace btcheck::btcpp {

// Whether the whole text is what the pattern says: `*` is any text, "" and `/`
// included, `?` any one byte, all else itself. As in the filters of
// BehaviorTree.CPP's substitution rules (utils/wildcards.hpp of 4.10).
bool matches_wildcard(std::string_view pattern, std::string_view text);

}  // namespace btcheck::btcpp
