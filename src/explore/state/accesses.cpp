// SPDX-License-Identifier: MIT
//
// One pass over all edges. Automata are gone through in order, so one that is
// in a list already is the last of it.
#include "explore/state/accesses.hpp"

#include <algorithm>

namespace btcheck {

Accesses::Accesses(const Network& network)
    : readers(network.variables.size()), writers(network.variables.size()) {
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    const auto add = [a](std::vector<AutomatonId>& list) {
      if (list.empty() || list.back() != AutomatonId{a}) {
        list.push_back(AutomatonId{a});
      }
    };
    const auto reads = [&](VariableId read) { add(readers[index(read)]); };
    const auto writes = [&](VariableId written) {
      add(writers[index(written)]);
    };
    for (const Edge& edge : automaton.edges) {
      if (automaton.gate) reads(*automaton.gate);
      for_each_access(automaton, edge, reads, writes);
    }
  }
}

bool Accesses::are_only_by(std::span<const AutomatonId> automata,
                           VariableId variable) const {
  const auto are_among = [&](const std::vector<AutomatonId>& users) {
    return std::all_of(users.begin(), users.end(), [&](AutomatonId user) {
      return std::find(automata.begin(), automata.end(), user) !=
             automata.end();
    });
  };
  return are_among(readers[index(variable)]) &&
         are_among(writers[index(variable)]);
}

}  // namespace btcheck
