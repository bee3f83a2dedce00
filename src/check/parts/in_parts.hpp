// SPDX-License-Identifier: MIT
//
// The default report of a tree that is too large to be searched as a whole.
#pragma once

#include <cstddef>

#include "check/parts/earlier_runs.hpp"
#include "check/questions/defaults.hpp"
#include "explore/components/component_store.hpp"

namespace btcheck {

// Asks each question of the network in which all that it does not look at
// stands as components (explore/components), the tree's with its roots, each
// node's and each sighting's with these nodes. The answers are those of
// check_defaults; what could not be had so is Undecided, and the report says by
// which limit it was stopped. The network has to be at its start. Up to
// `together` nodes that stand together are asked for in one search. `known`:
// what is known of parts, of this tree and others; may be null. What runs of
// `earlier` show here is not searched for.
inline constexpr std::size_t kNodesTogether = 8;
DefaultReport check_defaults_in_parts(const BehaviorTree& tree,
                                      const CompiledNetwork& system,
                                      const Limits& limits,
                                      ComponentStore* known,
                                      std::size_t together = kNodesTogether,
                                      const EarlierReport* earlier = nullptr);

}  // namespace btcheck
