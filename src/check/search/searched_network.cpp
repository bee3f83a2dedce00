// SPDX-License-Identifier: MIT
//
// A formula with the next-step operator, or about single steps, notices every
// step: then only dead values are forgotten. The same where it says something
// of dead states beside other things: which step of several is the last one
// would then make a difference.
#include "check/search/searched_network.hpp"

#include <algorithm>

namespace btcheck {

SearchedNetwork::SearchedNetwork(const CompiledNetwork& system)
    : original_(system), reduced_(system) {}

SearchedNetwork::SearchedNetwork(const CompiledNetwork& system,
                                 const Observed& observed, Reduction reduction)
    : SearchedNetwork(system, observed, observed, reduction) {}

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
