// SPDX-License-Identifier: MIT
//
// Where fair runs come to rest: built-in justice and strong fairness.
#pragma once

#include <span>
#include <vector>

#include "explore/search/stored_graph.hpp"

namespace btcheck {

// A strong fairness condition on one graph, as sets of its states: requested
// infinitely often, therefore granted infinitely often.
struct FairnessSets {
  StateSet requested;
  StateSet granted;
};

// A run is fair when it makes progress infinitely often (built-in justice: no
// condition where every step is progress) and keeps every strong condition.
//
// The states of `within` that lie in a strongly connected part of it which a
// fair run can go round in for ever, seeing every state of it. Different parts
// are different components of the states returned. After Lichtenstein and
// Pnueli (POPL 1985): each round takes time linear in the graph, and there are
// at most `conditions.size() + 1` rounds.
StateSet fair_components(const StoredGraph& graph, const StateSet& within,
                         std::span<const FairnessSets> conditions);

// A cycle through `state`, one of a set that fair_components has returned, by
// whose repetition a run is fair: `state` first, the last one leads back to
// it. Not the shortest, but each leg of it is.
std::vector<StateId> fair_cycle(const StoredGraph& graph,
                                const StateSet& fair_components, StateId state,
                                std::span<const FairnessSets> conditions);

}  // namespace btcheck
