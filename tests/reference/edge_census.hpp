// SPDX-License-Identifier: MIT
//
// How often each edge of each automaton's table is taken, over many trees.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "reference/naive_network.hpp"

namespace btcheck::reference {

// By node type with its options and the edge with children's names left out:
// "Sequence: child_done -> failure, on failure".
using EdgeCensus = std::map<std::string, std::uint64_t>;

std::string edge_name(const BehaviorTree& tree, const Network& network,
                      const Automaton& automaton, const Edge& edge);

// Adds the steps of a space, and 0 for edges that are not taken in it.
void count_edges(const BehaviorTree& tree, const Network& network,
                 const NaiveSpace& space, EdgeCensus& census);

}  // namespace btcheck::reference
