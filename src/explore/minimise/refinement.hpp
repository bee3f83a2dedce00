// SPDX-License-Identifier: MIT
//
// The coarsest partition of the states of a graph that has no silent cycles.
#pragma once

#include <cstdint>
#include <vector>

#include "explore/minimise/arcs.hpp"

namespace btcheck {

// By state: its block, in no particular order. Two states are in one block
// exactly if they are branching bisimilar, where divergence is a label as any
// other. Time O(m log n) for m arcs and n states, m >= n. At its peak about 40
// bytes for an arc with those of `arcs`, 40 for a state, 28 for a block and 44
// for a slice (slices.hpp).
std::vector<std::uint32_t> refined(Arcs arcs);

}  // namespace btcheck
