// SPDX-License-Identifier: MIT
//
// Whether two networks cannot be told apart from outside.
#pragma once

#include <set>

#include "model/automata/network.hpp"

namespace btcheck::mutation {

// True when the two, which have the same nodes and variables, have the same
// behaviour as far as it can be seen: divergence-sensitive branching
// bisimilarity of their unreduced state graphs, where a state shows which
// location of the frame each node is in, its rstatus and the values of the
// state variables, and a step shows whether time passes. Stutter-invariant
// properties over these, and bounds on time, are then true of both or of none.
// Groote, Vaandrager, "An efficient algorithm for branching bisimulation and
// stuttering equivalence", ICALP 1990; by signatures, as Blom and Orzan (2003).
// False as well when either has more than 200,000 states.
bool have_same_runs(const Network& one, const Network& other);

// The numbers of the edges that some run of the network takes.
std::set<std::uint32_t> edges_taken(const Network& network);

}  // namespace btcheck::mutation
