// SPDX-License-Identifier: MIT
//
// Atomic propositions of a network's states, compiled.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "explore/condition.hpp"
#include "explore/step.hpp"

namespace btcheck {

// A truth value of states, over the network's variables. In a dead state (no
// step but an idle one leads from it) `when_dead` counts, if it is there.
struct StatePredicate {
  Expression expression;
  std::optional<Expression> when_dead;
};

// A network with up to kMaxPropositions predicates: again a TransitionSystem,
// whose label has bit i set where predicate i is true. The network must
// outlive it.
class LabelledNetwork {
 public:
  LabelledNetwork(const CompiledNetwork& system,
                  const std::vector<StatePredicate>& predicates);

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
    const bool is_dead = depends_on_dead_ && !system_.enabled(state).any;
    PropositionSet set = 0;
    for (std::size_t i = 0; i < compiled_.size(); ++i) {
      if (holds(i, state, is_dead)) set |= PropositionSet{1} << i;
    }
    return set;
  }

  // One predicate alone, where it is known whether the state is dead; asked
  // this way there may be any number of predicates.
  bool holds(std::size_t predicate, StateView state, bool is_dead) const {
    const Compiled& compiled = compiled_[predicate];
    return conditions_.holds(is_dead ? compiled.when_dead : compiled.condition,
                             state.data());
  }

 private:
  struct Compiled {
    Condition condition;
    Condition when_dead;
  };

  const CompiledNetwork& system_;
  ConditionPool conditions_;
  std::vector<Compiled> compiled_;
  bool depends_on_dead_ = false;
};

}  // namespace btcheck
