// SPDX-License-Identifier: MIT
//
// A finite run that no continuation can mend.
//
// Many rules are broken at one moment, whatever happens then: `(not a) W b`
// at the first a. The automaton of such a rule's negation has a state that
// accepts everything (Kupferman and Vardi, "Model checking of safety
// properties", FMSD 2001: an informative bad prefix leads there), and the
// shortest way to it is the shortest counterexample there is. Breadth-first
// search finds it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "explore/search/stored_run.hpp"
#include "explore/state/limits.hpp"
#include "explore/store/state_store.hpp"
#include "ltl/buchi/buchi.hpp"
#include "ltl/product/fair_system.hpp"

namespace btcheck {

// A state from which every word is accepted by staying in it, if there is one:
// a loop there reads every label and is in every acceptance set.
inline std::optional<std::uint32_t> universal_state(
    const BuchiAutomaton& automaton) {
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

template <FairSystem Product>
class BadPrefixSearch {
 public:
  // Both must outlive it.
  BadPrefixSearch(const Product& product, const Limits& limits)
      : product_(product),
        limits_(limits),
        store_(product.word_count()),
        present_(product.word_count()) {}

  // A run with the fewest steps into a state of the product whose automaton is
  // in `universal`, that state included. Nothing when none of the first `most`
  // states has one, or a limit is reached before. To be called once.
  std::optional<std::vector<RunState>> find(std::uint32_t universal,
                                            std::size_t most) {
    std::optional<StateId> goal;
    product_.initial_states(
        [&](StateView state) { arrive(state, std::nullopt, universal, goal); });
    for (; next_ < std::min(most, store_.size()) && !goal; ++next_) {
      if (next_ % kPollInterval == 0 && is_at_limit()) return std::nullopt;
      const StateId from{static_cast<std::uint32_t>(next_)};
      store_.load(from, present_);
      product_.successors(present_, [&](StateView target, Step, AcceptanceSet) {
        arrive(target, from, universal, goal);
      });
    }
    if (!goal) return std::nullopt;
    return run_along(product_, store_, tree_.path_to(*goal));
  }

 private:
  void arrive(StateView state, std::optional<StateId> from,
              std::uint32_t universal, std::optional<StateId>& goal) {
    const auto [id, is_new] = store_.insert(state);
    if (!is_new) return;
    tree_.reach(id, from.value_or(id));
    if (!goal && state.back() == universal) goal = id;
  }

  bool is_at_limit() const {
    SearchProgress progress;
    progress.states = store_.size();
    progress.bytes = store_.bytes() + tree_.bytes();
    return limits_.reached(progress) != StopReason::None;
  }

  const Product& product_;
  const Limits& limits_;
  StateStore store_;
  StateVector present_;
  BreadthFirstTree tree_;
  std::size_t next_ = 0;  // the state to be expanded next
};

}  // namespace btcheck
