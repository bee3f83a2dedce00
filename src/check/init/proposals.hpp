// SPDX-License-Identifier: MIT
//
// Rules that somebody who knows a tree would ask of it: the patterns of
// docs/properties.md, section 11, where the tree has what they speak of. They
// are proposals: whether they hold is for a check to say, and whether they
// should for whoever owns the tree.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck {

struct Proposal {
  std::string name;   // "drive_watched"
  std::string title;  // what it says: a sentence
  std::string body;   // "every tick: drive.answered running => ..."
};

// At most three of each pattern, in the order of the tree; no two of one name.
std::vector<Proposal> proposals_for(const BehaviorTree& tree);

}  // namespace btcheck
