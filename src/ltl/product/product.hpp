// SPDX-License-Identifier: MIT
//
// A transition system running in step with a Büchi automaton.
//
// The synchronous product of the automata-theoretic approach (Vardi and
// Wolper 1986), on transitions: from (s, q) the pair moves to (s', q') when
// the system steps from s to s' and the automaton has a transition from q to
// q' that reads the label of s. The product has one word more than the
// system, the state of the automaton, and is searched like a system, except
// that each step also tells the acceptance sets it belongs to. Where the
// system has steps without progress, one more set holds the steps that make
// progress: fairness then is acceptance, and no search needs to know of it.
// Propositions of steps, where a system has them, are read with the state that
// the step leaves.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "explore/state/transition_system.hpp"
#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// Whether a system has steps with progress == false.
enum class Justice : std::uint8_t { EveryStepIsProgress, SomeStepsAreNot };

// Some systems have propositions of steps as well: state/event logic.
template <class System>
concept MayHaveStepPropositions = requires(const System& system,
                                           StateView state, Step step) {
  system.has_step_propositions();
  system.step_label(state, state, step);
};

template <TransitionSystem System>
class Product {
 public:
  // Both must outlive the product.
  Product(const System& system, const BuchiAutomaton& automaton,
          Justice justice)
      : system_(system),
        automaton_(automaton),
        progress_(justice == Justice::SomeStepsAreNot
                      ? AcceptanceSet{1} << automaton.acceptance_sets
                      : 0) {
    assert(automaton.acceptance_sets < 64);
  }

  std::size_t word_count() const { return system_.word_count() + 1; }
  AcceptanceSet all_sets() const { return automaton_.all_sets() | progress_; }
  PropositionSet label(StateView state) const {
    return system_.label(system_part(state));
  }

  // Calls found(StateView) for each initial state.
  template <class Found>
  void initial_states(Found&& found) const {
    if (automaton_.is_empty()) return;
    system_.initial_states([&](StateView state) {
      Buffer pair(state.begin(), state.end());
      pair.push_back(automaton_.initial);
      found(view_of(pair));
    });
  }

  // Calls stepped(StateView target, Step, AcceptanceSet) for each step.
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    const StateView present = system_part(state);
    const PropositionSet label = system_.label(present);
    boost::container::small_vector<const BuchiTransition*, 16> enabled;
    for (const BuchiTransition& transition :
         automaton_.transitions[state.back()]) {
      if (may_read(transition, label)) enabled.push_back(&transition);
    }
    if (enabled.empty()) return;
    Buffer pair(state.size());
    system_.successors(present, [&](StateView target, Step step) {
      const PropositionSet full = label | step_label(present, target, step);
      std::copy(target.begin(), target.end(), pair.begin());
      for (const BuchiTransition* transition : enabled) {
        if (!transition->reads(full)) continue;
        pair.back() = transition->target;
        stepped(view_of(pair), step,
                transition->accepting | (step.progress ? progress_ : 0));
      }
    });
  }

  // The state of the system within a state of the product.
  static StateView system_part(StateView state) {
    return state.first(state.size() - 1);
  }

 private:
  using Buffer = boost::container::small_vector<Word, 32>;

  // Reads the label of the state, whatever that of the step will be.
  bool may_read(const BuchiTransition& transition, PropositionSet label) const {
    if constexpr (MayHaveStepPropositions<System>) {
      if (system_.has_step_propositions()) return true;
    }
    return transition.reads(label);
  }

  PropositionSet step_label(StateView from, StateView to, Step step) const {
    if constexpr (MayHaveStepPropositions<System>) {
      if (system_.has_step_propositions()) {
        return system_.step_label(from, to, step);
      }
    }
    return 0;
  }

  const System& system_;
  const BuchiAutomaton& automaton_;
  AcceptanceSet progress_;  // the set of the steps that make progress, or 0
};

}  // namespace btcheck
