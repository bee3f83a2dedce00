// SPDX-License-Identifier: MIT
//
// Fair runs in a graph, by the fixpoint of Emerson and Lei (LICS 1986).
//
// The greatest set of states from each of which, for every acceptance set, a
// path within the set of states leads over a step of the acceptance set.
// Nothing here knows of components, depth-first search or the order of states.
#include "reference/fair_graph.hpp"

#include <algorithm>

namespace btcheck::reference {

namespace {

// States of `within` from which a path within it takes a step of `set`.
std::vector<bool> can_take(const FairGraph& graph,
                           const std::vector<bool>& within, AcceptanceSet set) {
  std::vector<bool> result(within.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t state = 0; state < within.size(); ++state) {
      if (result[state] || !within[state]) continue;
      const auto& steps = graph.steps[state];
      result[state] =
          std::any_of(steps.begin(), steps.end(), [&](FairGraph::Step step) {
            return within[step.target] &&
                   ((step.sets & set) == set || result[step.target]);
          });
      changed = changed || result[state];
    }
  }
  return result;
}

}  // namespace

std::vector<bool> states_with_fair_run(const FairGraph& graph) {
  std::vector<bool> states(graph.steps.size(), true);
  for (std::vector<bool> before; before != states;) {
    before = states;
    states = can_take(graph, states, 0);
    for (int i = 0; i < 64; ++i) {
      const AcceptanceSet set = AcceptanceSet{1} << i;
      if ((graph.all_sets & set) != 0) states = can_take(graph, states, set);
    }
  }
  return states;
}

}  // namespace btcheck::reference
