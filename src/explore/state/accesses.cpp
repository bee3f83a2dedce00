// SPDX-License-Identifier: MIT
//
// Guards are conjunctions, and most conjuncts compare a variable with a
// constant; that is all that is looked at.
#include "explore/state/accesses.hpp"

#include <algorithm>

#include "text/budget.hpp"

namespace btcheck {
namespace {

// Where the operand begins that ends there.
std::size_t start_of(std::span<const Term> terms, std::size_t last) {
  int owed = arity(terms[last].operation);
  while (owed > 0) owed += arity(terms[--last].operation) - 1;
  return last;
}

// Calls visit(operation, variable, value) for each conjunct `variable = value`
// or `variable != value`, from the last to the first. Behind an `and` stands
// nothing but conjuncts, so none is copied.
template <class Visit>
void for_each_demand(const Expression& guard, Visit visit) {
  const std::span<const Term> terms = guard.terms();
  for (std::size_t end = terms.size(); end > 0;) {
    const Term& term = terms[end - 1];
    if (term.operation == Operation::And) {
      --end;
      continue;
    }
    const std::size_t start = start_of(terms, end - 1);
    if (end - start == 3 && is_equality(term.operation) &&
        terms[start].operation == Operation::Variable &&
        terms[start + 1].operation == Operation::Constant) {
      visit(term.operation,
            VariableId{static_cast<std::uint32_t>(terms[start].operand)},
            int{terms[start + 1].operand});
    }
    end = start;
  }
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
  for_each_demand(guard, [&](Operation how, VariableId variable, int value) {
    if (how == Operation::Equal) all.emplace_back(variable, value);
  });
  std::ranges::reverse(all);
  std::ranges::stable_sort(all, {}, &std::pair<VariableId, int>::first);
  const auto is_same = [](const auto& one, const auto& other) {
    return one.first == other.first;
  };
  all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
  return all;
}

std::optional<int> demanded_value(const Expression& guard,
                                  VariableId variable) {
  std::optional<int> demanded;
  for_each_demand(guard, [&](Operation how, VariableId of, int value) {
    if (how == Operation::Equal && of == variable) demanded = value;
  });
  return demanded;
}

bool excludes(const Expression& guard, VariableId variable, int value) {
  bool is_refused = false;
  std::optional<int> demanded;
  for_each_demand(guard, [&](Operation how, VariableId of, int other) {
    if (of != variable) return;
    if (how == Operation::Equal) demanded = other;
    is_refused |= how == Operation::NotEqual && other == value;
  });
  return is_refused || (demanded && demanded != value);
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
