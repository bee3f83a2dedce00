// SPDX-License-Identifier: MIT
//
// Minimal deterministic automata for obligation properties.
#pragma once

#include <optional>

#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// The smallest deterministic automaton that accepts the words of `automaton`,
// if there is a weak one, that is, if they are a Boolean combination of safety
// properties. `opposite` accepts the other words. Nothing as well when finding
// out would take long.
std::optional<BuchiAutomaton> minimal_weak(const BuchiAutomaton& automaton,
                                           const BuchiAutomaton& opposite);

}  // namespace btcheck
