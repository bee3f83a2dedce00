// SPDX-License-Identifier: MIT
#include "model/automata/past_memory.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "model/tree/reads.hpp"

namespace btcheck {
namespace {

bool reads_any(const Expression& expression) {
  return std::ranges::any_of(expression.terms(), [](const Term& term) {
    return term.operation == Operation::Variable;
  });
}

// Without variables a constant.
Expression folded(Expression expression) {
  if (reads_any(expression)) return expression;
  const bool holds =
      expression.evaluate([](const Term&) { return std::int64_t{0}; }) != 0;
  return Expression::constant(holds ? 1 : 0);
}

bool changes(const Automaton& automaton, const Edge& edge,
             const Expression& condition) {
  if (edge.source != edge.target && reads(condition, automaton.location)) {
    return true;
  }
  return std::ranges::any_of(edge.updates, [&](const Assignment& update) {
    return reads(condition, update.variable);
  });
}

// The condition once the edge has been taken, said behind its assignments: only
// the location is still the old one.
Expression behind(const Network& network, const Automaton& automaton,
                  const Edge& edge, const Expression& condition) {
  const Variable& location = network.variable(automaton.location);
  return folded(condition.replaced([&](const Term& term) {
    const VariableId variable{static_cast<std::uint32_t>(term.operand)};
    return variable == automaton.location
               ? Expression::constant(location.min +
                                      static_cast<int>(index(edge.target)))
               : read(variable);
  }));
}

// What the bit becomes; nothing where it stays as it is.
std::optional<Expression> next_value(const PastCondition& condition,
                                     VariableId bit, Expression held,
                                     Expression began) {
  if (condition.kind == PastOperator::Once) {
    // `once P` is `true since P`.
    began = std::exchange(held, Expression::constant(1));
  }
  if (is_always(began)) return began;
  if (is_never(began) && is_always(held)) return std::nullopt;
  if (is_never(held)) return began;
  Expression kept =
      is_always(held)
          ? read(bit)
          : Expression::binary(Operation::And, std::move(held), read(bit));
  if (is_never(began)) return kept;
  return Expression::binary(Operation::Or, std::move(began), std::move(kept));
}

void keep_up(const PastCondition& condition, VariableId bit, Network& network) {
  for (Automaton& automaton : network.automata) {
    for (Edge& edge : automaton.edges) {
      const bool is_step = changes(automaton, edge, condition.held) ||
                           changes(automaton, edge, condition.began);
      if (!is_step) continue;
      auto next = next_value(condition, bit,
                             behind(network, automaton, edge, condition.held),
                             behind(network, automaton, edge, condition.began));
      if (next) edge.updates.push_back({bit, std::move(*next)});
    }
  }
}

// With the step that begins what comes after a tick, before all else that it
// does.
void take_over(const BehaviorTree& tree, const PastCondition& condition,
               VariableId bit, Network& network) {
  Automaton& root =
      network.automata[index(network.node_automaton[index(tree.roots[0])])];
  for (Edge& edge : root.edges) {
    if (!is_answer(root.source(edge).role)) continue;
    edge.updates.insert(edge.updates.begin(), {bit, condition.held});
  }
}

bool holds_initially(const Network& network, const Expression& condition) {
  return condition.evaluate([&](const Term& term) {
    return std::int64_t{network.variables[term.operand].initial};
  }) != 0;
}

}  // namespace

void remember_past(const BehaviorTree& tree, const PastCondition& condition,
                   std::string key, Network& network) {
  constexpr std::array kNames = {"once", "since", "previously"};
  const VariableId bit{static_cast<std::uint32_t>(network.variables.size())};
  const AutomatonId owner = network.node_automaton[index(tree.roots[0])];
  const bool is_initial =
      condition.kind != PastOperator::Previously &&
      holds_initially(network, condition.kind == PastOperator::Once
                                   ? condition.held
                                   : condition.began);
  const std::string name = kNames[static_cast<std::size_t>(condition.kind)] +
                           std::to_string(network.past.size() + 1);
  network.variables.push_back(
      {VariableRole::Local, name, 0, 1, is_initial ? 1 : 0, {}, owner});
  network.automata[index(owner)].locals.push_back(bit);
  network.past.push_back({std::move(key), bit});
  if (condition.kind == PastOperator::Previously) {
    take_over(tree, condition, bit, network);
  } else {
    keep_up(condition, bit, network);
  }
}

std::optional<VariableId> past_memory(const Network& network,
                                      std::string_view key) {
  const auto found = std::ranges::find(network.past, key, &PastMemory::key);
  if (found == network.past.end()) return std::nullopt;
  return found->variable;
}

}  // namespace btcheck
