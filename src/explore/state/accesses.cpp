// SPDX-License-Identifier: MIT
//
// Guards are conjunctions, and most conjuncts compare a variable with a
// constant; that is all that is looked at.
#include "explore/state/accesses.hpp"

#include <algorithm>

#include "text/budget.hpp"

namespace btcheck {
namespace {

// Of a conjunct `variable = value`.
std::optional<std::pair<VariableId, int>> demand_of(
    const Expression& conjunct) {
  const auto terms = conjunct.terms();
  if (terms.size() != 3 || terms[0].operation != Operation::Variable ||
      terms[1].operation != Operation::Constant ||
      terms[2].operation != Operation::Equal) {
    return std::nullopt;
  }
  return std::pair{VariableId{static_cast<std::uint32_t>(terms[0].operand)},
                   int{terms[1].operand}};
}

}  // namespace

std::optional<int> constant_value(const Assignment& assignment) {
  const auto terms = assignment.value.terms();
  if (terms.size() != 1 || terms[0].operation != Operation::Constant) {
    return std::nullopt;
  }
  return terms[0].operand;
}

std::vector<std::pair<VariableId, int>> demanded_values(
    const Expression& guard) {
  std::vector<std::pair<VariableId, int>> all;
  for (const Expression& conjunct : guard.conjuncts()) {
    if (const auto demand = demand_of(conjunct)) all.push_back(*demand);
  }
  std::ranges::stable_sort(all, {}, &std::pair<VariableId, int>::first);
  const auto is_same = [](const auto& one, const auto& other) {
    return one.first == other.first;
  };
  all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
  return all;
}

std::optional<int> demanded_value(const Expression& guard,
                                  VariableId variable) {
  for (const Expression& conjunct : guard.conjuncts()) {
    const auto demand = demand_of(conjunct);
    if (demand && demand->first == variable) return demand->second;
  }
  return std::nullopt;
}

bool excludes(const Expression& guard, VariableId variable, int value) {
  const Expression refusal = differs(variable, value);
  const auto demanded = demanded_value(guard, variable);
  const auto conjuncts = guard.conjuncts();
  return (demanded && demanded != value) ||
         std::find(conjuncts.begin(), conjuncts.end(), refusal) !=
             conjuncts.end();
}

bool takes_time(const Network& network, const Edge& edge) {
  return network.ticks != TickSemantics::None && edge.when.lower > 0;
}

Accesses::Accesses(const Network& network)
    : readers(network.variables.size()), writers(network.variables.size()) {
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    ask_budget();
    const Automaton& automaton = network.automata[a];
    // Automata come in order: one that is in a list already is the last of it.
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
