// SPDX-License-Identifier: MIT
//
// Entries of the blackboard that the program around the tree decides: a test is
// that program. So they are declared with a few values each, on both sides of
// what scripts compare them with, and move from tick to tick.
#pragma once

#include <optional>
#include <string>

#include "check/check.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// The same tree, read with contracts that declare such entries.
struct DrivenTree {
  TreeInput input;
  LoweredInput lowered;
  std::string contracts;
};

// Nothing where there are none, or where the reader refuses them.
std::optional<DrivenTree> driven_tree(const TreeInput& input,
                                      const BehaviorTree& tree,
                                      TickSemantics ticks);

}  // namespace btcheck
