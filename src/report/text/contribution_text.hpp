// SPDX-License-Identifier: MIT
//
// What makes a state space large, and what can be done about it.
#pragma once

#include <span>
#include <string>

#include "check/questions/contribution.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// The parts with the largest factors, one a line, each with a way to make it
// smaller. Empty when no part matters much.
std::string contribution_text(const BehaviorTree& tree,
                              std::span<const Contribution> parts);

}  // namespace btcheck
