// SPDX-License-Identifier: MIT
//
// Who reads and writes which blackboard entry, by ports and by scripts.
#pragma once

#include "model/btcpp/expand/expansion.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// Sets `entries` and `entry_uses`. A key that the blackboard holds is no use of
// the entry it names.
void note_entry_uses(const BtcppExpansion& expansion, BehaviorTree& tree);

}  // namespace btcheck::btcpp
