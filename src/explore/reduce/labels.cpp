// SPDX-License-Identifier: MIT
//
// Each predicate becomes word tests and, where it must, a small program.
#include "explore/reduce/labels.hpp"

namespace btcheck {

LabelledNetwork::LabelledNetwork(const ReducedNetwork& system,
                                 const std::vector<StatePredicate>& predicates)
    : system_(system),
      conditions_(system.network().network(), system.network().layout()) {
  for (const StatePredicate& predicate : predicates) add(predicate);
}

LabelledNetwork::LabelledNetwork(const ReducedNetwork& system,
                                 const std::vector<Proposition>& propositions)
    : system_(system),
      conditions_(system.network().network(), system.network().layout()) {
  const Network& network = system.network().network();
  for (const Proposition& proposition : propositions) {
    add(proposition.of);
    Compiled& compiled = compiled_.back();
    compiled.kind = proposition.kind;
    has_step_propositions_ |= compiled.kind != PropositionKind::State;
    compiled.edges.resize(network.edge_count(), false);
    for (const AutomatonId mover : proposition.movers) {
      const Automaton& automaton = network.automaton(mover);
      for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
        compiled.edges[automaton.first_edge + e] = true;
      }
    }
  }
}

void LabelledNetwork::add(const StatePredicate& predicate) {
  Compiled compiled;
  compiled.condition = conditions_.compile(predicate.expression);
  compiled.when_dead = predicate.when_dead
                           ? conditions_.compile(*predicate.when_dead)
                           : compiled.condition;
  depends_on_dead_ |= predicate.when_dead.has_value();
  compiled_.push_back(std::move(compiled));
}

PropositionSet LabelledNetwork::step_label(StateView from, StateView to,
                                           Step step) const {
  PropositionSet set = 0;
  for (std::size_t i = 0; i < compiled_.size(); ++i) {
    bool is_so = false;
    switch (compiled_[i].kind) {
      case PropositionKind::State:
        break;
      case PropositionKind::Enter:
        is_so = !holds_in(i, from) && holds_in(i, to);
        break;
      case PropositionKind::Leave:
        is_so = holds_in(i, from) && !holds_in(i, to);
        break;
      case PropositionKind::Moves:
        is_so = step.edge != kTimeStep && compiled_[i].edges[step.edge];
        break;
      case PropositionKind::Passes:
        is_so = step.edge == kTimeStep;
        break;
    }
    if (is_so) set |= PropositionSet{1} << i;
  }
  return set;
}

}  // namespace btcheck
