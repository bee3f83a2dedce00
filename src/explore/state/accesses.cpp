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

// What a conjunct comes to; nothing where it hangs on more than the variable.
std::optional<std::int64_t> value_of(std::span<const Term> terms,
                                     VariableId variable, int value) {
  const auto is_known = [&](const Term& term) {
    const bool is_it = static_cast<std::uint32_t>(term.operand) ==
                       static_cast<std::uint32_t>(variable);
    return term.operation == Operation::Variable
               ? is_it
               : term.operation != Operation::Status;
  };
  if (!std::ranges::all_of(terms, is_known)) return std::nullopt;
  std::vector<std::int64_t> stack;
  for (const Term& term : terms) {
    if (term.operation == Operation::Constant) {
      stack.push_back(term.operand);
    } else if (term.operation == Operation::Variable) {
      stack.push_back(value);
    } else {
      const std::int64_t right = stack.back();
      stack.pop_back();
      std::int64_t left = 0;
      if (arity(term.operation) == 2) {
        left = stack.back();
        stack.pop_back();
      }
      stack.push_back(apply(term.operation, left, right));
    }
  }
  return stack.back();
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
  bool is_refused = false;
  for_each_conjunct(guard, [&](std::span<const Term> terms) {
    is_refused = is_refused || value_of(terms, variable, value) == 0;
  });
  return is_refused;
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
  const VariableId location = network.automaton(automaton).location;
  return std::ranges::all_of(writers[index(location)], [&](AutomatonId writer) {
    return writer == automaton;
  });
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
