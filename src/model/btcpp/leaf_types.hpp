// SPDX-License-Identifier: MIT
//
// What the leaves can do that BehaviorTree.CPP and Nav2 bring along.
#pragma once

#include "model/btcpp/document.hpp"
#include "model/profile.hpp"
#include "model/tree.hpp"

namespace btcheck::btcpp {

// A leaf of no known type is an action that may run, and whose result stands
// until it is reset; a condition answers anew on every tick.
LeafContract leaf_contract(Profile profile, const BtcppNode& leaf);

}  // namespace btcheck::btcpp
