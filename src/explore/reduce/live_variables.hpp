// SPDX-License-Identifier: MIT
//
// Forgetting values that nothing will read.
#pragma once

#include <vector>

#include "explore/reduce/observed.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

struct LiveNetwork {
  Network network;
  // By VariableId: whether some edge writes it that did not before. Its value
  // may then differ from that in the original network.
  std::vector<bool> forgotten;
};

// The same network, in which every edge also overwrites what it leaves behind
// that will be overwritten before it is read, or that no later test can tell
// from the variable's first value. What the questions see is left alone, and so
// are state variables; edges keep their numbers. The two are bisimilar, each
// step with the same edge and the same time; so everything is preserved that
// can be said of what is observed, CTL and next step included.
LiveNetwork forget_dead_values(const Network& network,
                               const Observed& observed);

}  // namespace btcheck
