// SPDX-License-Identifier: MIT
//
// A strongly fair run settles each condition in one of two ways: it is granted
// for ever, or at last requested no more. All choices are tried: what is
// requested no more takes states out, what is granted is an acceptance set,
// and the fixpoint of fair_graph.hpp says where runs remain. Nothing is
// refined, and no order of states or conditions plays a part.
#include "reference/strong_fairness.hpp"

#include <algorithm>

#include "reference/fair_graph.hpp"

namespace btcheck::reference {

namespace {

bool has(PropositionSet label, std::uint32_t proposition) {
  return (label >> proposition & 1) != 0;
}

// States that can be reached, by Floyd's way of asking again until no more.
std::vector<bool> reachable_states(const ToySystem& system) {
  std::vector<bool> reached(system.size());
  for (const std::uint32_t state : system.initial()) reached[state] = true;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t state = 0; state < system.size(); ++state) {
      if (!reached[state]) continue;
      for (const ToySystem::ToyStep& step : system.steps(state)) {
        changed = changed || !reached[step.target];
        reached[step.target] = true;
      }
    }
  }
  return reached;
}

// The runs in which just the conditions of `avoided`, a bit each, are
// requested no more.
FairGraph runs_of_choice(const ToySystem& system,
                         const std::vector<Condition>& conditions,
                         std::size_t avoided) {
  FairGraph graph;
  graph.steps.resize(system.size());
  graph.all_sets = (AcceptanceSet{2} << conditions.size()) - 1;
  const auto sets_of = [&](PropositionSet label) {
    AcceptanceSet sets = 0;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const bool is_avoided = (avoided >> i & 1) != 0;
      if (is_avoided || has(label, conditions[i].granted)) {
        sets |= AcceptanceSet{2} << i;
      }
    }
    return sets;
  };
  const auto is_out = [&](PropositionSet label) {
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const bool is_avoided = (avoided >> i & 1) != 0;
      if (is_avoided && has(label, conditions[i].requested)) return true;
    }
    return false;
  };
  for (std::size_t state = 0; state < system.size(); ++state) {
    if (is_out(system.label_of(state))) continue;
    const AcceptanceSet sets = sets_of(system.label_of(state));
    for (const ToySystem::ToyStep& step : system.steps(state)) {
      graph.steps[state].push_back(
          {step.target, sets | (step.step.progress ? 1u : 0u)});
    }
  }
  return graph;
}

}  // namespace

void ToyFairness::mark(StateView state, boost::dynamic_bitset<>& requested,
                       boost::dynamic_bitset<>& granted) const {
  ++asked_;
  const PropositionSet label = system_.label(state);
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    requested[i] = has(label, conditions_[i].requested);
    granted[i] = has(label, conditions_[i].granted);
  }
}

bool is_strongly_fair(const LassoWord& word,
                      const std::vector<Condition>& conditions) {
  PropositionSet seen = 0;
  for (const PropositionSet label : word.cycle) seen |= label;
  return std::all_of(
      conditions.begin(), conditions.end(), [&](const Condition& condition) {
        return !has(seen, condition.requested) || has(seen, condition.granted);
      });
}

FormulaId under_conditions(FormulaPool& pool,
                           const std::vector<Condition>& conditions,
                           FormulaId formula) {
  const auto for_ever = [&](std::uint32_t proposition) {
    return pool.unary(FormulaKind::Always, pool.unary(FormulaKind::Eventually,
                                                      pool.atom(proposition)));
  };
  FormulaId all = pool.constant(true);
  for (const Condition& condition : conditions) {
    all = pool.binary(
        FormulaKind::And, all,
        pool.binary(FormulaKind::Implies, for_ever(condition.requested),
                    for_ever(condition.granted)));
  }
  return pool.binary(FormulaKind::Implies, all, formula);
}

bool has_strongly_fair_run(const ToySystem& system,
                           const std::vector<Condition>& conditions) {
  const std::vector<bool> reachable = reachable_states(system);
  for (std::size_t avoided = 0; avoided < std::size_t{1} << conditions.size();
       ++avoided) {
    const std::vector<bool> fair =
        states_with_fair_run(runs_of_choice(system, conditions, avoided));
    for (std::size_t state = 0; state < system.size(); ++state) {
      if (reachable[state] && fair[state]) return true;
    }
  }
  return false;
}

}  // namespace btcheck::reference
