// SPDX-License-Identifier: MIT
//
// From an expanded XML tree to the `BehaviorTree` that is lowered: each node
// gets the meaning that it has under a profile.
#pragma once

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

struct EngineOptions {
  Profile profile = Profile::Btcpp4;  // not Paper
  // How long one tick of the root takes. Durations are rounded up to whole
  // ticks.
  int tick_ms = 100;
  // The root is ticked again after it has ended, for ever.
  bool loops = false;
  // It is ticked again at once when a node asks for it (Tree::tickOnce).
  bool wakes = false;
  btcpp::LeafContracts leaves = {};
  btcpp::ScriptDetail detail = {};
};

// Node k + 1 of the tree is instance k of the expansion; node 0 is the root
// that ticks.
Result<BehaviorTree> engine_tree(const BtcppExpansion& expansion,
                                 const EngineOptions& options);

}  // namespace btcheck
