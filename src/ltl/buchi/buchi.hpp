// SPDX-License-Identifier: MIT
//
// Transition-based generalised Büchi automata over sets of propositions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "explore/state/transition_system.hpp"

namespace btcheck {

// Bit i set: the transition is in the i-th acceptance set.
using AcceptanceSet = std::uint64_t;

// Enabled where all of `present` and none of `absent` are true.
struct BuchiTransition {
  PropositionSet present = 0;
  PropositionSet absent = 0;
  AcceptanceSet accepting = 0;
  std::uint32_t target = 0;

  bool reads(PropositionSet label) const {
    return (label & present) == present && (label & absent) == 0;
  }
  friend bool operator==(const BuchiTransition&,
                         const BuchiTransition&) = default;
  friend auto operator<=>(const BuchiTransition&,
                          const BuchiTransition&) = default;
};

// Accepts the infinite words over PropositionSet that have a run from the
// initial state passing through every acceptance set infinitely often. With no
// acceptance set every infinite run is accepting. A transition reads the label
// of the present state of the system. No initial state: the empty language.
struct BuchiAutomaton {
  std::vector<std::vector<BuchiTransition>> transitions;  // by state
  std::uint32_t initial = 0;
  int acceptance_sets = 0;

  std::size_t state_count() const { return transitions.size(); }
  bool is_empty() const { return transitions.empty(); }
  AcceptanceSet all_sets() const {
    return acceptance_sets == 64 ? ~AcceptanceSet{0}
                                 : (AcceptanceSet{1} << acceptance_sets) - 1;
  }
};

// Adds one more unless `implies(kept one, new one)`, and drops those kept that
// it implies: of equal ones the first stays.
template <class T, class Implies>
void keep_weakest(std::vector<T>& kept, T added, Implies implies) {
  const auto covers = [&](const T& other) { return implies(other, added); };
  if (std::any_of(kept.begin(), kept.end(), covers)) return;
  std::erase_if(kept, [&](const T& other) { return implies(added, other); });
  kept.push_back(std::move(added));
}

}  // namespace btcheck
