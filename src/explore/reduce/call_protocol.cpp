// SPDX-License-Identifier: MIT
#include "explore/reduce/call_protocol.hpp"

#include <algorithm>
#include <cstddef>
#include <map>

#include "explore/state/accesses.hpp"
#include "text/budget.hpp"

namespace btcheck {

bool ends_turn(const Automaton& automaton, const Edge& edge) {
  return automaton.gate && index(edge.target) == 0;
}

CallProtocol::CallProtocol(const Network& network)
    : gated_(network.variables.size()),
      parents_(network.automata.size()),
      children_(network.automata.size()),
      waits_(network.automata.size()) {
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const auto& gate = network.automata[a].gate;
    if (gate) gated_[index(*gate)] = AutomatonId{a};
  }
  for (std::uint32_t a = 0; a < network.automata.size() && holds_; ++a) {
    ask_budget();
    const Automaton& writer = network.automata[a];
    // By location: its edges, and how many of them demand that a gate be 0.
    std::vector<std::size_t> leaving(writer.locations.size());
    std::vector<std::map<VariableId, std::size_t>> zeros(leaving.size());
    for (const Edge& edge : writer.edges) {
      ++leaving[index(edge.source)];
      for (const auto& [variable, value] : demanded_values(edge.guard)) {
        if (value == 0 && gated_[index(variable)]) {
          ++zeros[index(edge.source)][variable];
        }
      }
    }
    for (const Edge& edge : writer.edges) {
      for (const Assignment& update : edge.updates) {
        const auto& whose = gated_[index(update.variable)];
        if (!whose) continue;
        const std::size_t target = index(edge.target);
        const auto zero = zeros[target].find(update.variable);
        const std::size_t waiting =
            zero == zeros[target].end() ? 0 : zero->second;
        holds_ = holds_ && accept(writer, AutomatonId{a}, edge, update, *whose,
                                  waiting == leaving[target]);
      }
    }
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const auto& parent = parents_[a];
    if (parent) children_[index(*parent)].push_back(AutomatonId{a});
  }
}

bool CallProtocol::accept(const Automaton& writer, AutomatonId self,
                          const Edge& edge, const Assignment& update,
                          AutomatonId gated, bool waits) {
  if (self == gated) {  // gives control back; any other calls
    return constant_value(update) == 0 && ends_turn(writer, edge);
  }
  auto& parent = parents_[index(gated)];
  if (parent && *parent != self) return false;
  parent = self;
  auto& places = waits_[index(gated)];
  if (std::ranges::find(places, edge.target) == places.end()) {
    places.push_back(edge.target);
  }
  return waits;
}

}  // namespace btcheck
