// SPDX-License-Identifier: MIT
//
// What each node can answer at all, from its leaves upwards and without a
// search. Where that takes more than the answers of its children, everything is
// possible: what is ruled out is ruled out in every run. Example: in
// (Fallback (ForceSuccess a) b) the first child never fails, so the tick never
// gets to b, and the Fallback never fails.
#pragma once

#include <string>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck {

struct Answers {
  bool success = true;
  bool failure = true;
  bool runs = true;      // its status may be running, so it may be halted
  bool skipped = false;  // XML trees only
  // Its parent may tick it again after it has ended, without a reset.
  bool stays = false;
};

// By node.
std::vector<Answers> possible_answers(const BehaviorTree& tree);

struct NeverTicked {
  NodeId node{};
  std::string why;  // "`a` (line 3) never fails"
};
// The nodes that the tick never gets to, without those below or behind one.
std::vector<NeverTicked> never_ticked(const BehaviorTree& tree);

}  // namespace btcheck
