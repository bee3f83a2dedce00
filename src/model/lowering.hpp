// SPDX-License-Identifier: MIT
//
// A tree becomes automata in parallel over shared variables (paper, section
// 3.1).
#pragma once

#include "model/automata/network.hpp"
#include "model/automata/regions.hpp"

namespace btcheck {

// Lowers a tree to its network as the paper does (sections 3 and 4 of
// docs/semantics.md; paper, section 3), or as the engine of its profile runs
// it (docs/btcpp.md). A SetSV has an edge for each value that it may give.
Network lower(const BehaviorTree& tree, TickSemantics ticks,
              const SampledValues& samples = {});

}  // namespace btcheck
