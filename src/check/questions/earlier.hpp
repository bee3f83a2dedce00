// SPDX-License-Identifier: MIT
//
// The default report in several attempts: what one has found that was given up
// stays found.
#pragma once

#include "check/questions/defaults.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Adds to a report that the limits have cut what an earlier one of the same
// tree and network has found: whatever has been shown stays shown.
void add_known(const BehaviorTree& tree, DefaultReport known,
               DefaultReport& report);

}  // namespace btcheck
