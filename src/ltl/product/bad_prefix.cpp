// SPDX-License-Identifier: MIT
//
// A state accepts everything by itself when it has a loop that reads every
// label and is in every acceptance set.
#include "ltl/product/bad_prefix.hpp"

namespace btcheck {

std::optional<std::uint32_t> universal_state(const BuchiAutomaton& automaton) {
  for (std::uint32_t state = 0; state < automaton.state_count(); ++state) {
    for (const BuchiTransition& transition : automaton.transitions[state]) {
      if (transition.target == state && transition.present == 0 &&
          transition.absent == 0 &&
          transition.accepting == automaton.all_sets()) {
        return state;
      }
    }
  }
  return std::nullopt;
}

}  // namespace btcheck
