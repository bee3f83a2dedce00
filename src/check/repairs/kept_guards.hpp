// SPDX-License-Identifier: MIT
//
// What a tree was careful of before a repair, it has to be careful of after.
#pragma once

#include <string_view>
#include <vector>

#include "model/edits/edited_files.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// False where the edits take a guard away:
//
// - a leaf that may be asked between two ticks of a running one is asked no
//   more meanwhile, and the finding is not about that it is asked;
// - the tree can succeed although a condition always says what has ruled that
//   out so far, and the finding, at the nodes `about`, does not speak of it.
//
// It is asked of what the node types do, not of what nodes are called. False as
// well for trees of more than 1,000 leaves, of which nobody wants to wait for
// the answer.
bool keeps_guards(const BehaviorTree& before, const BehaviorTree& after,
                  const EditedFiles& edits, std::string_view code,
                  const std::vector<NodeId>& about);

}  // namespace btcheck
