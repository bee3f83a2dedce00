// SPDX-License-Identifier: MIT
//
// What a leaf of an XML tree may answer.
#pragma once

#include "model/btcpp/document.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// A leaf of a type that neither BehaviorTree.CPP nor Nav2 has is an action that
// may run, and whose result may stand until it is reset; a condition answers
// anew on every tick.
LeafContract leaf_contract(BtcppRelease release, const BtcppNode& leaf);

}  // namespace btcheck::btcpp
