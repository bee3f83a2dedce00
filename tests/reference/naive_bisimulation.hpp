// SPDX-License-Identifier: MIT
//
// Which states nobody can tell apart, found without cleverness: by signatures,
// and from the definition alone. And random graphs to ask it of.
#pragma once

#include <cstdint>
#include <random>

#include "explore/minimise/partition.hpp"

namespace btcheck::reference {

// Blocks are split by what can be done from a state, silent steps within its
// block first, until nothing is split any more (Blom and Orzan 2003).
Partition signature_partition(const LabelledGraph& graph,
                              Equivalence equivalence);

// Whether the blocks of a partition, as a relation, satisfy the definition of a
// strong bisimulation, or of a branching one that preserves divergence (van
// Glabbeek, Luttik and Trčka 2009): every step is answered after silent steps,
// and a state that can go on silently for ever among states related to it is
// related to such states only.
bool is_bisimulation(const LabelledGraph& graph, const Partition& partition,
                     Equivalence equivalence);

// The bisimulation that contains all others, found by looking at every
// partition: for graphs of at most seven states, which have 877. Throws
// runtime_error when no single one contains all others, which cannot be.
Partition greatest_bisimulation(const LabelledGraph& graph,
                                Equivalence equivalence);

// With and without cycles, near and far targets, parts that nothing leads to;
// 1 to `most` states, 1 to 4 labels, and up to 90 of 100 steps silent.
LabelledGraph random_graph(std::mt19937& random, std::uint32_t most);

}  // namespace btcheck::reference
