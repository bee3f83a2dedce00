// SPDX-License-Identifier: MIT
#include "explore/reduce/call_protocol.hpp"

#include <algorithm>

#include "explore/state/accesses.hpp"

namespace btcheck {
namespace {

// No edge leaves the location while the variable is other than 0.
bool waits_for_zero(const Automaton& automaton, LocationId location,
                    VariableId variable) {
  return std::ranges::all_of(automaton.edges, [&](const Edge& edge) {
    return edge.source != location || demanded_value(edge.guard, variable) == 0;
  });
}

}  // namespace

bool ends_turn(const Automaton& automaton, const Edge& edge) {
  return automaton.gate && index(edge.target) == 0;
}

CallProtocol::CallProtocol(const Network& network)
    : gated_(network.variables.size()),
      parents_(network.automata.size()),
      waits_(network.automata.size()) {
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const auto& gate = network.automata[a].gate;
    if (gate) gated_[index(*gate)] = AutomatonId{a};
  }
  for (std::uint32_t a = 0; a < network.automata.size() && holds_; ++a) {
    const Automaton& writer = network.automata[a];
    for (const Edge& edge : writer.edges) {
      for (const Assignment& update : edge.updates) {
        const auto& whose = gated_[index(update.variable)];
        if (!whose) continue;
        holds_ = holds_ && accept(writer, AutomatonId{a}, edge, update, *whose);
      }
    }
  }
}

bool CallProtocol::accept(const Automaton& writer, AutomatonId self,
                          const Edge& edge, const Assignment& update,
                          AutomatonId gated) {
  if (self == gated) {  // gives control back; any other calls
    return constant_value(update) == 0 && ends_turn(writer, edge);
  }
  auto& parent = parents_[index(gated)];
  if (parent && *parent != self) return false;
  parent = self;
  auto& waits = waits_[index(gated)];
  if (std::ranges::find(waits, edge.target) == waits.end()) {
    waits.push_back(edge.target);
  }
  return waits_for_zero(writer, edge.target, update.variable);
}

}  // namespace btcheck
