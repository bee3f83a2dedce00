// SPDX-License-Identifier: MIT
//
// Where an automaton may go round by itself.
#pragma once

#include <vector>

#include "explore/reduce/call_protocol.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// Locations such that an automaton that moves for ever within one turn, and no
// time passes, comes to one of them again and again. A turn ends when control
// is given back; the turn of a root never ends. The protocol must hold.
std::vector<LocationId> cycle_heads(const Network& network,
                                    const CallProtocol& protocol,
                                    AutomatonId automaton);

}  // namespace btcheck
