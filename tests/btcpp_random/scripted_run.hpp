// SPDX-License-Identifier: MIT
//
// A tree and a script, run as `btcheck simulate --script --loop` runs them.
#pragma once

#include <string>

#include "model/tree/tree.hpp"
#include "model/tree_file.hpp"

namespace btcheck::reference {

// How such a tree is read, with its contracts.
TreeReading scripted_reading(Profile profile, const std::string& leaves);

struct ScriptedRun {
  std::string lines;  // docs/simulate.md
  // A line for each of them: the first letter of the status of each node below
  // the root, in pre-order. Of py_trees, where `?` is the condition of a guard:
  // that is no node there.
  std::string statuses;
  // Nothing but the script decided: neither an unknown entry nor a clock.
  bool is_determined = false;
};

// At most so many ticks. A script that does not fit the tree gives no lines.
ScriptedRun scripted_run(const BehaviorTree& tree, const std::string& script,
                         int ticks);

}  // namespace btcheck::reference
