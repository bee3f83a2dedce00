// SPDX-License-Identifier: MIT
//
// Guards are conjunctions, and most conjuncts ask of one variable; that is all
// that is looked at.
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

// Calls visit(terms) for each conjunct, from the last to the first. Behind an
// `and` stands nothing but conjuncts, so none is copied.
template <class Visit>
void for_each_conjunct(const Expression& guard, Visit visit) {
  const std::span<const Term> terms = guard.terms();
  for (std::size_t end = terms.size(); end > 0;) {
    if (terms[end - 1].operation == Operation::And) {
      --end;
      continue;
    }
    const std::size_t start = start_of(terms, end - 1);
    visit(terms.subspan(start, end - start));
    end = start;
  }
}

// Calls visit(variable, value) for each conjunct `variable = value`.
template <class Visit>
void for_each_demand(const Expression& guard, Visit visit) {
  for_each_conjunct(guard, [&](std::span<const Term> terms) {
    if (terms.size() == 3 && terms[2].operation == Operation::Equal &&
        terms[0].operation == Operation::Variable &&
        terms[1].operation == Operation::Constant) {
      visit(VariableId{static_cast<std::uint32_t>(terms[0].operand)},
            int{terms[1].operand});
    }
  });
}

// Whether a conjunct reads the variable alone, and is false with this value.
bool is_refused(std::span<const Term> conjunct, VariableId variable,
                int value) {
  const auto is_known = [&](const Term& term) {
    const VariableId read{static_cast<std::uint32_t>(term.operand)};
    return term.operation == Operation::Variable
               ? read == variable
               : term.operation != Operation::Status;
  };
  return std::ranges::all_of(conjunct, is_known) &&
         value_of(conjunct, [&](const Term&) { return std::int64_t{value}; }) ==
             0;
}

bool are_among(std::span<const AutomatonId> automata,
               const std::vector<AutomatonId>& users) {
  return std::ranges::all_of(users, [&](AutomatonId user) {
    return std::ranges::find(automata, user) != automata.end();
  });
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
  for_each_demand(guard, [&](VariableId variable, int value) {
    all.emplace_back(variable, value);
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
  for_each_demand(guard, [&](VariableId of, int value) {
    if (of == variable) demanded = value;
  });
  return demanded;
}

bool excludes(const Expression& guard, VariableId variable, int value) {
  bool is_out = false;
  for_each_conjunct(guard, [&](std::span<const Term> conjunct) {
    is_out = is_out || is_refused(conjunct, variable, value);
  });
  return is_out;
}

std::uint64_t excluded_values(const Network& network, const Expression& guard,
                              VariableId variable) {
  const Variable& of = network.variable(variable);
  std::uint64_t excluded = 0;
  for (int value = of.min; value <= of.max; ++value) {
    if (!excludes(guard, variable, value)) continue;
    excluded |= std::uint64_t{1} << (value - of.min);
  }
  return excluded;
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

bool Accesses::moves_alone(const Network& network,
                           AutomatonId automaton) const {
  const AutomatonId writer[] = {automaton};
  return are_written_only_by(writer, network.automaton(automaton).location);
}

bool Accesses::are_only_by(std::span<const AutomatonId> automata,
                           VariableId variable) const {
  return are_among(automata, readers[index(variable)]) &&
         are_written_only_by(automata, variable);
}

bool Accesses::are_written_only_by(std::span<const AutomatonId> automata,
                                   VariableId variable) const {
  return are_among(automata, writers[index(variable)]);
}

}  // namespace btcheck
