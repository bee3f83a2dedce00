// SPDX-License-Identifier: MIT
//
// What can come of the ticks of a tree: all of it, by recursion over the tree.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck::reference {

// By node: its last answer in one tick, "none" if it was not asked.
using TickAnswers = std::vector<std::string_view>;

// The answers of every tick that some run has, each once. A tick that a fault
// ends is none. The tree must have one root and no variable that moves by
// itself, and what stands below a Parallel must not share variables. Nothing
// where more than `most` ticks would have to be looked at.
std::optional<std::vector<TickAnswers>> tick_outcomes(const BehaviorTree& tree,
                                                      std::size_t most);

}  // namespace btcheck::reference
