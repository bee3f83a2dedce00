// SPDX-License-Identifier: MIT
//
// A clock for each automaton suffices: it starts when a location is entered,
// and counts only up to what the intervals of the edges from there tell apart
// (explore/state/state_layout.cpp packs the same bounds).
#include "model/export/clock_bound.hpp"

#include <algorithm>

namespace btcheck {

int clock_bound(const Automaton& automaton, LocationId location) {
  int bound = 0;
  for (const Edge& edge : automaton.edges) {
    if (edge.source != location) continue;
    bound = std::max(bound, edge.when.greatest_clock());
  }
  return bound;
}

int greatest_clock_bound(const Automaton& automaton) {
  int greatest = 0;
  for (const Edge& edge : automaton.edges) {
    greatest = std::max(greatest, clock_bound(automaton, edge.source));
  }
  return greatest;
}

bool can_be_late(const Automaton& automaton, const Edge& edge) {
  return edge.when.upper <= clock_bound(automaton, edge.source);
}

bool is_binding(TickSemantics ticks, const Automaton& automaton,
                const Edge& edge) {
  return ticks == TickSemantics::None ? !moves_freely(automaton)
                                      : can_be_late(automaton, edge);
}

bool moves_freely(const Automaton& automaton) {
  return automaton.kind == AutomatonKind::StateVariable;
}

bool has_free_moves(const Network& network) {
  return std::ranges::any_of(network.automata, [](const Automaton& automaton) {
    return moves_freely(automaton) && !automaton.edges.empty();
  });
}

}  // namespace btcheck
