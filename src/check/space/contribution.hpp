// SPDX-License-Identifier: MIT
//
// Which parts of a tree make its state space large.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// All states, divided by those that still differ when everything that the part
// holds is not looked at. Of a node that is its status and place, its counters
// and its timer; of a state variable its value. Factors of parts that move
// together overlap: their product is more than the whole.
struct Contribution {
  std::optional<NodeId> node;
  std::optional<StateVariableId> variable;  // one of the two is there
  double factor = 1;                        // to about two percent
};

// One search of everything, with every part in the order of its factor, the
// largest first. Nothing when the limits end the search.
std::vector<Contribution> measure_contributions(const Network& network,
                                                const Limits& limits);

}  // namespace btcheck
