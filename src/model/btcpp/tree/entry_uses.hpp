// SPDX-License-Identifier: MIT
//
// Who reads and writes which blackboard entry, by ports and by scripts.
#pragma once

#include <map>

#include "model/btcpp/expand/expansion.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// Sets `entries`, `entry_homes` and `entry_uses`. A key that the blackboard
// holds is no use of the entry it names. `variables` are the entries that the
// variables of the tree are.
void note_entry_uses(const BtcppExpansion& expansion,
                     const std::map<EntryName, StateVariableId>& variables,
                     BehaviorTree& tree);

}  // namespace btcheck::btcpp
