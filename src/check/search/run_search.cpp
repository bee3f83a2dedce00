// SPDX-License-Identifier: MIT
//
// The negation of a formula becomes a Büchi automaton, and a fair run of its
// product with the network is a counterexample (Vardi and Wolper 1986). A
// real-time pattern has its observer, which under assumptions is one more
// factor of such a product: the automaton then asks that an answer is due for
// ever, which a violated pattern is as well.
#include <utility>

#include "check/search/searches.hpp"
#include "ltl/buchi/translate.hpp"
#include "ltl/product/accepting_cycle.hpp"
#include "ltl/product/bad_prefix.hpp"
#include "ltl/product/near_lasso.hpp"
#include "ltl/product/product.hpp"
#include "ltl/product/strong_fairness.hpp"

namespace btcheck {
namespace {

Justice justice_of(const ReducedNetwork& system) {
  return system.network().has_free_moves() ? Justice::SomeStepsAreNot
                                           : Justice::EveryStepIsProgress;
}

const RunSearch kTooLarge{
    SearchOutcome::GaveUp, StopReason::FormulaTooLarge, {}, {}};

// The conditions on a product's states, whose first words are the network's.
StrongFairness fairness_of(const ReducedNetwork& system,
                           const std::vector<FairnessPair>& conditions) {
  const auto mark =
      [system, labels = LabelledNetwork(system, predicates_of(conditions)),
       size = conditions.size()](StateView state,
                                 boost::dynamic_bitset<>& requested,
                                 boost::dynamic_bitset<>& granted) {
        const StateView own = state.first(system.word_count());
        const bool is_dead = !system.network().enabled(own).any;
        for (std::size_t i = 0; i < size; ++i) {
          requested[i] = labels.holds(2 * i, own, is_dead);
          granted[i] = labels.holds(2 * i + 1, own, is_dead);
        }
      };
  return {conditions.size(), mark};
}

// What is broken at one moment is shown up to that moment. The automaton is in
// `universal` one step after it has read what broke it; only events of steps
// need that step as well.
template <FairSystem System>
void prefer_bad_prefix(const System& product, std::uint32_t universal,
                       bool has_step_propositions, const Limits& limits,
                       RunSearch& search) {
  auto prefix =
      find_bad_prefix(product, limits, universal, worth_of_shortening(search));
  if (!prefix || prefix->size() > length(*search.lasso) + 1) return;
  if (!has_step_propositions && prefix->size() > 1) prefix->pop_back();
  search.lasso = Lasso{std::move(*prefix), {}, {}};
  drop_last_word(*search.lasso);
}

// The product of the network and the automaton of the negation, searched.
template <class Search>
RunSearch against(const ReducedNetwork& system, const BoundFormula& formula,
                  Search&& search) {
  FormulaPool pool = formula.pool;
  const auto automaton =
      translate(pool, pool.unary(FormulaKind::Not, formula.formula));
  if (!automaton) return kTooLarge;
  const LabelledNetwork labelled(system, formula.propositions);
  const Product product(labelled, *automaton, justice_of(system));
  return search(product, labelled, *automaton);
}

}  // namespace

RunSearch find_run_against(const ReducedNetwork& system,
                           const BoundFormula& formula,
                           const std::vector<FairnessPair>& conditions,
                           const Limits& limits) {
  return against(
      system, formula,
      [&](const auto& product, const auto& labelled,
          const BuchiAutomaton& automaton) {
        RunSearch search =
            find_short_run(product, limits, fairness_of(system, conditions));
        const auto universal = universal_state(automaton);
        if (search.lasso && universal && conditions.empty()) {
          prefer_bad_prefix(product, *universal,
                            labelled.has_step_propositions(), limits, search);
        }
        return search;
      });
}

SearchOutcome exists_run_against(const ReducedNetwork& system,
                                 const BoundFormula& formula,
                                 const std::vector<FairnessPair>& conditions,
                                 const Limits& limits) {
  return against(system, formula,
                 [&](const auto& product, const auto&, const BuchiAutomaton&) {
                   return find_accepting_cycle(product, limits,
                                               fairness_of(system, conditions));
                 })
      .outcome;
}

PatternRun find_run_against(const ReducedNetwork& system,
                            const BoundPattern& pattern, const Limits& limits) {
  const LabelledNetwork labelled(system, pattern.predicates);
  return find_violation(labelled, pattern.pattern, limits);
}

RunSearch find_run_against(const ReducedNetwork& system,
                           const BoundProperty& assumed,
                           const std::vector<FairnessPair>& conditions,
                           const Limits& limits) {
  FormulaPool pool = assumed.formula.pool;
  const auto automaton = translate(pool, assumed.formula.formula);
  if (!automaton) return kTooLarge;
  // The pattern's propositions come behind those of the formula.
  std::vector<Proposition> propositions = assumed.formula.propositions;
  const std::size_t shift = propositions.size();
  for (const StatePredicate& predicate : assumed.timed.predicates) {
    propositions.push_back({predicate, PropositionKind::State, {}});
  }
  TimedPattern shifted = assumed.timed.pattern;
  for (PropositionSet* bit : {&shifted.trigger, &shifted.answer,
                              &shifted.opening, &shifted.closing}) {
    *bit <<= shift;
  }
  const LabelledNetwork labelled(system, propositions);
  const ObservedSystem observed(labelled, shifted,
                                static_cast<int>(assumed.due));
  const Product product(observed, *automaton, justice_of(system));
  RunSearch search =
      find_short_run(product, limits, fairness_of(system, conditions));
  if (search.lasso) drop_last_word(*search.lasso);
  return search;
}

}  // namespace btcheck
