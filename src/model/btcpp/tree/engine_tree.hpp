// SPDX-License-Identifier: MIT
//
// A tree in the XML of BehaviorTree.CPP as the tree that is lowered: every
// node with the meaning that its profile gives it.
#pragma once

#include "model/btcpp/expand/entries.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/tree/contracts.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

struct EngineOptions {
  Profile profile = Profile::Btcpp4;  // not Paper
  // How long one tick of the root takes. Durations are rounded up to whole
  // ticks.
  int tick_ms = 100;
  // Ticked again after it has ended, for ever.
  bool loops = false;
  // Ticked again at once when a node asks for it (Tree::tickOnce).
  bool wakes = false;
  btcpp::LeafContracts leaves = {};
  btcpp::ScriptDetail detail = {};
};

// Node k + 1 of the tree is instance k of the expansion; node 0 is the root
// that ticks. Codes BT1632 to BT1635, BT1638, BT1011, BT1020, BT1021.
Result<BehaviorTree> engine_tree(const BtcppExpansion& expansion,
                                 const EngineOptions& options);

}  // namespace btcheck
