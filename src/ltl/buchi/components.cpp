// SPDX-License-Identifier: MIT
#include "ltl/buchi/components.hpp"

#include <algorithm>
#include <span>

#include "explore/search/strong_components.hpp"

namespace btcheck {

Components::Components(const BuchiAutomaton& automaton) {
  ComponentSearch search(automaton.state_count(), [&](std::uint32_t state) {
    return std::span(automaton.transitions[state]);
  });
  search.search_from(automaton.initial,
                     [](const BuchiTransition& t) { return t.target; });
  component_ = search.take_components();
  for (std::uint32_t state = 0; state < component_.size(); ++state) {
    if (component_[state] == kUnreachable) continue;
    members_.resize(
        std::max<std::size_t>(members_.size(), component_[state] + 1));
    members_[component_[state]].push_back(state);
  }
  cyclic_.resize(members_.size());
  accepting_.resize(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    AcceptanceSet sets = 0;
    for (const std::uint32_t state : members_[i]) {
      for (const BuchiTransition& transition : automaton.transitions[state]) {
        if (!is_inside(state, transition)) continue;
        cyclic_[i] = true;
        sets |= transition.accepting;
      }
    }
    accepting_[i] = cyclic_[i] && sets == automaton.all_sets();
  }
}

}  // namespace btcheck
