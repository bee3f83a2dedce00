// SPDX-License-Identifier: MIT
//
// Runs of a network that counts rounds, and what they show of the networks that
// count further.
#pragma once

#include <optional>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The run shows something of the rule, which does not look at the counter (a
// round_counter of explore/reduce/counters.hpp): it breaks it, or is what is
// possible. The least greatest value of the counter from which on every network
// has a run that shows it: either this one, or one that goes through some of
// its rounds more often. Nothing where the run does not tell.
std::optional<int> least_last_value(const Network& network, VariableId counter,
                                    const Run& run, const BoundProperty& rule);

}  // namespace btcheck
