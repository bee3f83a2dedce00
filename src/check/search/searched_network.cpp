// SPDX-License-Identifier: MIT
//
// A formula with the next-step operator, or about single steps, notices every
// step: then only dead values are forgotten. The same where it says something
// of dead states beside other things: which step of several is the last one
// would then make a difference. And beside components, in which time that
// passes may be all that happens, no state is known to be dead.
#include "check/search/searched_network.hpp"

#include <algorithm>
#include <utility>

namespace btcheck {

// The nodes whose variables are seen stand as they are.
struct SearchedNetwork::Parts {
  Parts(const Network& network, const Observed& observed, ComponentStore& known)
      : components(network, seen_in(network, observed), {}, &known),
        composition(components, standing(network, observed), false) {}

  static std::vector<bool> seen_in(const Network& network,
                                   const Observed& observed) {
    std::vector<bool> seen;
    for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
      seen.push_back(observed.sees(VariableId{v}));
    }
    return seen;
  }
  static std::vector<bool> standing(const Network& network,
                                    const Observed& observed) {
    std::vector<bool> stands(network.automata.size(), false);
    for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
      const auto owner = network.variables[v].owner;
      if (!owner || !observed.sees(VariableId{v})) continue;
      const Automaton& automaton = network.automaton(*owner);
      if (automaton.kind == AutomatonKind::StateVariable) continue;
      stands[index(network.node_automaton[index(automaton.node)])] = true;
    }
    return stands;
  }

  ComponentTable components;
  Composition composition;
};

SearchedNetwork::~SearchedNetwork() = default;

SearchedNetwork::SearchedNetwork(const CompiledNetwork& system)
    : original_(system), reduced_(system) {}

SearchedNetwork::SearchedNetwork(const CompiledNetwork& system,
                                 const Observed& observed, Reduction reduction,
                                 ComponentStore* known)
    : original_(system), reduced_(system) {
  const Network* network = &system.network();
  const bool sees_silence =
      observed.sees_steps() || observed.sees_dead_states();
  if (known != nullptr && reduction == Reduction::Full && !sees_silence) {
    auto parts = std::make_unique<const Parts>(*network, observed, *known);
    if (parts->composition.left_out() > 0) {
      own_parts_ = std::move(parts);
      parts_ = &own_parts_->composition;
      network = &parts_->network();
    }
  }
  if (reduction == Reduction::None) return;
  const Observed wide = observed.widened(*network);
  reduce(*network, wide, wide, reduction);
}

SearchedNetwork::SearchedNetwork(const CompiledNetwork& system,
                                 const Observed& seen, const Observed& kept,
                                 Reduction reduction)
    : original_(system), reduced_(system) {
  if (reduction == Reduction::None) return;
  reduce(system.network(), seen, kept, reduction);
}

SearchedNetwork::SearchedNetwork(const CompiledNetwork& system,
                                 const Composition& parts, const Observed& seen,
                                 const Observed& kept)
    : original_(system), parts_(&parts) {
  reduce(parts.network(), seen, kept, Reduction::Full);
}

void SearchedNetwork::reduce(const Network& network, const Observed& seen,
                             const Observed& kept, Reduction reduction) {
  live_ = forget_dead_values(network, kept);
  compiled_.emplace(live_->network);
  reduced_ = ReducedNetwork(*compiled_);
  if (reduction != Reduction::Full) return;
  ample_.emplace(live_->network, seen);
  reduced_ = ReducedNetwork(*compiled_, *ample_);
}

std::optional<Run> SearchedNetwork::replayed(const Lasso& found,
                                             std::string& error) const {
  return replay(replayer(), in_single_steps(*reduced_, found), error);
}

Replayer SearchedNetwork::replayer() const {
  if (!live_) return Replayer(original_);
  return {original_.network(), *compiled_, live_->forgotten, parts_};
}

Observed observed_alone(const Network& network,
                        std::span<const StatePredicate> predicates) {
  Observed observed(network);
  for (const StatePredicate& predicate : predicates) {
    const auto conjuncts = predicate.expression.conjuncts();
    const bool is_of_dead_states =
        predicate.when_dead &&
        std::ranges::find(conjuncts, Expression::constant(0)) !=
            conjuncts.end();
    if (is_of_dead_states) {
      observed.add(*predicate.when_dead);
      observed.add_dead_states();
    } else {
      observed.add(predicate);
    }
  }
  return observed;
}

Observed observed_by(const Network& network,
                     std::span<const StatePredicate> predicates) {
  Observed observed(network);
  for (const StatePredicate& predicate : predicates) observed.add(predicate);
  return observed;
}

Observed observed_by(const Network& network, const BoundFormula& formula,
                     const std::vector<FairnessPair>& conditions) {
  Observed observed = observed_by(network, predicates_of(conditions));
  observed.add(formula.propositions);
  for (const FormulaId id : formula.pool.nodes(formula.formula)) {
    if (formula.pool[id].kind == FormulaKind::Next) observed.add_steps();
  }
  return observed;
}

}  // namespace btcheck
