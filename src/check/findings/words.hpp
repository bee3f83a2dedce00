// SPDX-License-Identifier: MIT
//
// Findings in the words of those who wrote the tree.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/findings/suspicion.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Of a tree of py_trees: its names for the node types of BehaviorTree.CPP.
std::string in_words_of(Profile profile, std::string_view text);

// All that they say; and no repair of a file that Python writes.
void put_into_words(const BehaviorTree& tree,
                    std::vector<TreeFinding>& findings);

}  // namespace btcheck
