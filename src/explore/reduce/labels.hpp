// SPDX-License-Identifier: MIT
//
// Atomic propositions of a network's states, compiled.
#pragma once

#include <cstdint>
#include <vector>

#include "explore/reduce/reduced_network.hpp"
#include "explore/state/condition.hpp"
#include "explore/state/proposition.hpp"

namespace btcheck {

// A network with up to kMaxPropositions propositions: again a
// TransitionSystem. Bit i of the label is set where proposition i is true of
// the state; those of steps have their bits in step_label. With ample sets it
// is a network reduced, and what is read must be observed. The network must
// outlive it.
class LabelledNetwork {
 public:
  LabelledNetwork(const ReducedNetwork& system,
                  const std::vector<StatePredicate>& predicates);
  LabelledNetwork(const ReducedNetwork& system,
                  const std::vector<Proposition>& propositions);

  std::size_t word_count() const { return system_.word_count(); }

  template <class Found>
  void initial_states(Found&& found) const {
    system_.initial_states(found);
  }
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    system_.successors(state, stepped);
  }

  PropositionSet label(StateView state) const {
    const bool is_dead =
        depends_on_dead_ && !system_.network().enabled(state).any;
    PropositionSet set = 0;
    for (std::size_t i = 0; i < compiled_.size(); ++i) {
      if (compiled_[i].kind == PropositionKind::State &&
          holds(i, state, is_dead)) {
        set |= PropositionSet{1} << i;
      }
    }
    return set;
  }

  // Whether some proposition is about steps, and those true of one.
  bool has_step_propositions() const { return has_step_propositions_; }
  PropositionSet step_label(StateView from, StateView to, Step step) const;

  // One predicate alone, where it is known whether the state is dead; asked
  // this way there may be any number of predicates.
  bool holds(std::size_t predicate, StateView state, bool is_dead) const {
    const Compiled& compiled = compiled_[predicate];
    return conditions_.holds(is_dead ? compiled.when_dead : compiled.condition,
                             state.data());
  }

 private:
  struct Compiled {
    PropositionKind kind = PropositionKind::State;
    Condition condition;
    Condition when_dead;
    std::vector<bool> edges;  // Moves: by number, whether it is a mover's
  };

  bool holds_in(std::size_t predicate, StateView state) const {
    return holds(predicate, state,
                 depends_on_dead_ && !system_.network().enabled(state).any);
  }

  ReducedNetwork system_;
  ConditionPool conditions_;
  std::vector<Compiled> compiled_;
  bool depends_on_dead_ = false;
  bool has_step_propositions_ = false;
};

}  // namespace btcheck
