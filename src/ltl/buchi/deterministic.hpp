// SPDX-License-Identifier: MIT
//
// Deterministic automata that read letters, by the powerset construction: what
// minimal weak automata and monitors are made of.
#pragma once

#include <cstdint>
#include <vector>

#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// Letters are the labels over the propositions in use, counted through: bit i
// of a letter is the i-th of them. State 0 is the initial one.
struct Deterministic {
  std::vector<std::vector<std::uint32_t>> targets;  // by state, letter
  std::vector<std::uint32_t> colours;               // by state
};

// The propositions that some transition asks for, ascending, one bit each.
std::vector<PropositionSet> used_propositions(const BuchiAutomaton& automaton);

// The label that each letter over the propositions stands for.
std::vector<PropositionSet> labels_over(
    const std::vector<PropositionSet>& propositions);

// States of an automaton, ascending.
using Subset = std::vector<std::uint32_t>;

// Where the automaton may be after a label.
Subset after(const BuchiAutomaton& automaton, const Subset& subset,
             PropositionSet label);

// The smallest automaton with the same colours after the same letters; all
// states are reachable.
Deterministic minimised(const Deterministic& automaton);

}  // namespace btcheck
