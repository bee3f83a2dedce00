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

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "explore/search/reachability.hpp"
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

// Stops at the first state whose automaton is in `universal`.
class BadPrefixVisitor : public ReachabilityVisitor {
 public:
  // At most so many states are expanded.
  BadPrefixVisitor(const StateStore& store, std::uint32_t universal,
                   std::size_t most)
      : store_(store),
        universal_(universal),
        most_(most),
        words_(store.word_count()) {}

  void stepped(StateId, Step, StateId to) {
    if (goal_ || index(to) < met_) return;
    met_ = index(to) + 1;
    store_.load(to, words_);
    if (words_.back() == universal_) goal_ = to;
  }
  GoOn expanded(StateId state, StateView words, bool) {
    if (words.back() == universal_) goal_ = state;  // an initial one
    return goal_ || index(state) + 1 >= most_ ? GoOn::No : GoOn::Yes;
  }
  const std::optional<StateId>& goal() const { return goal_; }

 private:
  const StateStore& store_;
  std::uint32_t universal_;
  std::size_t most_;
  StateVector words_;
  std::uint32_t met_ = 0;  // states with lower numbers were looked at
  std::optional<StateId> goal_;
};

// A run with the fewest steps into a state of the product whose automaton is
// in `universal`, that state included. Nothing when none of the first `most`
// states leads to one, or a limit is reached before.
template <FairSystem Product>
std::optional<std::vector<RunState>> find_bad_prefix(const Product& product,
                                                     const Limits& limits,
                                                     std::uint32_t universal,
                                                     std::size_t most) {
  BreadthFirst search(product, limits);
  BadPrefixVisitor visitor(search.store(), universal, most);
  search.run(visitor);
  if (!visitor.goal()) return std::nullopt;
  return search.path_to(*visitor.goal());
}

}  // namespace btcheck
