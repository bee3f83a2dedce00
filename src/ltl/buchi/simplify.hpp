// SPDX-License-Identifier: MIT
//
// Smaller Büchi automata for the same words.
#pragma once

#include <cstdint>

#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// In which sets to put the transitions between components. The words are the
// same either way; which is better for merging differs.
enum class PassingMarks : std::uint8_t { None, All };

// Keeps only reachable states from which a word can be accepted, acceptance
// marks only where they matter, and as few acceptance sets as the components
// need.
void clean_up(BuchiAutomaton& automaton,
              PassingMarks passing = PassingMarks::None);

// Merges states with equal transitions, up to merging.
void merge_bisimilar(BuchiAutomaton& automaton);

// Merges states that simulate each other, forwards and then backwards, and
// drops transitions that others make superfluous. Does nothing to automata
// with more than a few thousand transitions.
void merge_similar(BuchiAutomaton& automaton);

// Takes from each transition the labels under which another one of the same
// state does as well, so that fewer are enabled at a time. Same bound.
void separate_labels(BuchiAutomaton& automaton);

// All of these, until nothing changes.
void reduce(BuchiAutomaton& automaton);

}  // namespace btcheck
