// SPDX-License-Identifier: MIT
//
// Büchi automata with acceptance on states, to be set beside never claims.
#pragma once

#include <cstddef>

#include "ltl/buchi/buchi.hpp"

namespace btcheck::reference {

// An automaton of the same words with one acceptance set in which the
// transitions of each state are all or none: the state accepts or does not.
BuchiAutomaton state_based(const BuchiAutomaton& automaton);

// Pairs of states with a transition between them. A never claim has one line
// for each, whose guard is a disjunction where we have several transitions.
std::size_t connected_pairs(const BuchiAutomaton& automaton);

}  // namespace btcheck::reference
