// SPDX-License-Identifier: MIT
//
// Which states of a graph nobody can tell apart.
#pragma once

#include <cstdint>
#include <vector>

#include "explore/minimise/labelled_graph.hpp"

namespace btcheck {

enum class Equivalence : std::uint8_t {
  // Whatever one can do the other can, step by step.
  Strong,
  // Silent steps that change nothing of what can be done are not seen, but
  // whether they can go on for ever is: branching bisimilarity that preserves
  // divergence (van Glabbeek, Luttik and Trčka 2009). Preserves CTL* without
  // next step, and so LTL and deadlocks.
  Branching
};

struct Partition {
  // By state; blocks are numbered as their first states are.
  std::vector<std::uint32_t> block;
  std::uint32_t blocks = 0;

  friend bool operator==(const Partition&, const Partition&) = default;
};

// The coarsest one: two states are in one block exactly if they are equivalent.
Partition coarsest_partition(const LabelledGraph& graph,
                             Equivalence equivalence);

// The graph with one state for each block; state 0 is that of state 0. Every
// step stands once. With Branching, a silent step within a block is left out,
// but for one that begins and ends in a block whose states can go on silently
// for ever.
LabelledGraph quotient(const LabelledGraph& graph, const Partition& partition,
                       Equivalence equivalence);

// Two graphs as one: the states of `second` behind those of `first`.
LabelledGraph beside(const LabelledGraph& first, const LabelledGraph& second);

}  // namespace btcheck
