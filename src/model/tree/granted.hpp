// SPDX-License-Identifier: MIT
//
// What a tree of BehaviorTree.CPP needs of the program around it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck {

// Why an entry is left open: the tree reads it only,
inline constexpr std::string_view kNothingWrites =
    "nothing in the tree writes it";
// or changes it by `=` alone,
inline constexpr std::string_view kNothingCreates =
    "nothing in the tree creates it";
// or it may be no entry; also the end of a longer reason.
inline constexpr std::string_view kMayBeEnumerator =
    "perhaps an enumerator that your program registers";

// What the program is taken to do, since scripts throw otherwise and nothing in
// the tree does it: "the program sets `battery`". Of entries on which nothing
// in the tree depends, nothing.
std::vector<std::string> granted(const BehaviorTree& tree);

}  // namespace btcheck
