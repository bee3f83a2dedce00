// SPDX-License-Identifier: MIT
//
// Subsets are sorted vectors, minimisation is partition refinement.
#include "ltl/buchi/deterministic.hpp"

#include <algorithm>

#include "ltl/buchi/simplify.hpp"

namespace btcheck {

std::vector<PropositionSet> used_propositions(const BuchiAutomaton& automaton) {
  PropositionSet used = 0;
  for (const auto& transitions : automaton.transitions) {
    for (const BuchiTransition& t : transitions) used |= t.present | t.absent;
  }
  std::vector<PropositionSet> bits;
  for (; used != 0; used &= used - 1) bits.push_back(used & (~used + 1));
  return bits;
}

std::vector<PropositionSet> labels_over(
    const std::vector<PropositionSet>& propositions) {
  std::vector<PropositionSet> labels(std::size_t{1} << propositions.size(), 0);
  for (std::size_t letter = 0; letter < labels.size(); ++letter) {
    for (std::size_t i = 0; i < propositions.size(); ++i) {
      if ((letter >> i & 1) != 0) labels[letter] |= propositions[i];
    }
  }
  return labels;
}

Subset after(const BuchiAutomaton& automaton, const Subset& subset,
             PropositionSet label) {
  Subset result;
  for (const std::uint32_t state : subset) {
    for (const BuchiTransition& t : automaton.transitions[state]) {
      if (t.reads(label)) result.push_back(t.target);
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Deterministic minimised(const Deterministic& automaton) {
  const auto row_of = [&](std::size_t state, const auto& classes) {
    std::vector<std::uint32_t> row = automaton.targets[state];
    for (std::uint32_t& target : row) target = classes[target];
    return row;
  };
  // State 0 comes first, so its class is 0.
  const std::vector<std::uint32_t> classes = refined(automaton.colours, row_of);
  Deterministic result;
  result.targets.resize(*std::ranges::max_element(classes) + 1);
  result.colours.resize(result.targets.size());
  for (std::size_t state = 0; state < classes.size(); ++state) {
    result.targets[classes[state]] = row_of(state, classes);
    result.colours[classes[state]] = automaton.colours[state];
  }
  return result;
}

}  // namespace btcheck
