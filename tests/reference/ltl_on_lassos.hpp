// SPDX-License-Identifier: MIT
//
// Linear temporal logic on ultimately periodic words, from its definition.
#pragma once

#include <vector>

#include "ltl/buchi/buchi.hpp"
#include "ltl/formula/formula.hpp"

namespace btcheck::reference {

// The word prefix · cycle · cycle · …; the cycle is not empty.
struct LassoWord {
  std::vector<PropositionSet> prefix;
  std::vector<PropositionSet> cycle;

  std::size_t size() const { return prefix.size() + cycle.size(); }
  PropositionSet at(std::size_t position) const;
  std::size_t after(std::size_t position) const;
};

// Whether the formula is true of the word; atom i is proposition i.
bool holds(const FormulaPool& pool, FormulaId id, const LassoWord& word);

// Whether the automaton accepts the word, by the fixpoint of fair_graph.hpp.
bool accepts(const BuchiAutomaton& automaton, const LassoWord& word);

}  // namespace btcheck::reference
