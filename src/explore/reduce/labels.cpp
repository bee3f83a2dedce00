// SPDX-License-Identifier: MIT
#include "explore/reduce/labels.hpp"

namespace btcheck {
namespace {

std::vector<Proposition> propositions_of(
    const std::vector<StatePredicate>& predicates) {
  std::vector<Proposition> propositions(predicates.size());
  for (std::size_t i = 0; i < predicates.size(); ++i) {
    propositions[i].of = predicates[i];
  }
  return propositions;
}

}  // namespace

LabelledNetwork::LabelledNetwork(const ReducedNetwork& system,
                                 const std::vector<StatePredicate>& predicates)
    : LabelledNetwork(system, propositions_of(predicates)) {}

LabelledNetwork::LabelledNetwork(const ReducedNetwork& system,
                                 const std::vector<Proposition>& propositions)
    : system_(system),
      conditions_(system.network().network(), system.network().layout()) {
  const Network& network = system.network().network();
  for (const Proposition& proposition : propositions) {
    const auto& [expression, when_dead] = proposition.of;
    Compiled& compiled = compiled_.emplace_back();
    compiled.kind = proposition.kind;
    compiled.condition = conditions_.compile(expression);
    compiled.when_dead =
        when_dead ? conditions_.compile(*when_dead) : compiled.condition;
    depends_on_dead_ |= when_dead.has_value();
    if (compiled.kind == PropositionKind::State) continue;
    has_step_propositions_ = true;
    compiled.edges.resize(network.edge_count(), false);
    for (const AutomatonId mover : proposition.movers) {
      const Automaton& automaton = network.automaton(mover);
      for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
        compiled.edges[automaton.first_edge + e] = true;
      }
    }
  }
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
