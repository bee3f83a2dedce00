// SPDX-License-Identifier: MIT
//
// The states and steps of a network, enumerated without any cleverness.
//
// Written from the comments of model/automata/network.hpp and sections 1 and 2
// of docs/semantics.md: a state is a list of integers, the visited set a map,
// and every edge of every automaton is tried in every state. Nothing is packed,
// compiled or left out. Where `none` takes time away, a run that has come to
// its end still goes on for ever: it repeats its last state as soon as only
// free variables can move.
#include "reference/naive_network.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace btcheck::reference {
namespace {

std::int64_t combined(Operation operation, std::int64_t a, std::int64_t b) {
  switch (operation) {
    case Operation::Add:
      return a + b;
    case Operation::Subtract:
      return a - b;
    case Operation::Multiply:
      return a * b;
    case Operation::Divide:
      return b == 0 ? 0 : a / b;
    case Operation::Modulo:
      return b == 0 ? 0 : a % b;
    case Operation::Equal:
      return a == b;
    case Operation::NotEqual:
      return a != b;
    case Operation::Less:
      return a < b;
    case Operation::LessEqual:
      return a <= b;
    case Operation::Greater:
      return a > b;
    case Operation::GreaterEqual:
      return a >= b;
    case Operation::And:
      return a != 0 && b != 0;
    case Operation::Or:
      return a != 0 || b != 0;
    default:
      throw std::logic_error("not an operation of two operands");
  }
}

bool is_true(const Expression& condition, const NaiveState& state) {
  return naive_value(condition, state) != 0;
}

}  // namespace

std::int64_t naive_value(const Expression& expression,
                         const NaiveState& state) {
  if (expression.is_true()) return 1;
  std::vector<std::int64_t> stack;
  const auto pop = [&stack] {
    const std::int64_t top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const Term& term : expression.terms()) {
    if (term.operation == Operation::Constant) {
      stack.push_back(term.operand);
    } else if (term.operation == Operation::Variable) {
      stack.push_back(state.values.at(static_cast<std::size_t>(term.operand)));
    } else if (term.operation == Operation::Negate) {
      stack.push_back(-pop());
    } else if (term.operation == Operation::Not) {
      stack.push_back(pop() == 0);
    } else {
      const std::int64_t right = pop();
      const std::int64_t left = pop();
      stack.push_back(combined(term.operation, left, right));
    }
  }
  assert(stack.size() == 1);
  return stack.back();
}

NaiveState NaiveNetwork::initial() const {
  NaiveState state;
  for (const Variable& variable : network_.variables) {
    state.values.push_back(variable.initial);
  }
  state.clocks.assign(network_.automata.size(), 0);
  return state;
}

bool NaiveNetwork::is_faulty(const NaiveState& state) const {
  return network_.fault && state.value(*network_.fault) != 0;
}

std::size_t NaiveNetwork::location(const Automaton& automaton,
                                   const NaiveState& state) const {
  return static_cast<std::size_t>(state.value(automaton.location) -
                                  network_.variable(automaton.location).min);
}

bool NaiveNetwork::may_fire(const NaiveState& state, const Automaton& automaton,
                            const Edge& edge) const {
  if (is_faulty(state)) return false;
  if (location(automaton, state) != index(edge.source)) return false;
  const auto number = &automaton - network_.automata.data();
  const int clock = state.clocks[static_cast<std::size_t>(number)];
  if (clock < edge.when.lower || clock > edge.when.upper) return false;
  return is_true(edge.guard, state);
}

bool NaiveNetwork::is_at_deadline(const NaiveState& state,
                                  const Automaton& automaton,
                                  const Edge& edge) const {
  const auto number = &automaton - network_.automata.data();
  return may_fire(state, automaton, edge) &&
         state.clocks[static_cast<std::size_t>(number)] == edge.when.upper;
}

NaiveState NaiveNetwork::after(const NaiveState& state,
                               const Automaton& automaton,
                               const Edge& edge) const {
  NaiveState next = state;
  for (const Assignment& update : edge.updates) {
    next.values[index(update.variable)] =
        static_cast<int>(naive_value(update.value, next));
  }
  next.values[index(automaton.location)] =
      static_cast<int>(index(edge.target)) +
      network_.variable(automaton.location).min;
  for (std::size_t a = 0; a < network_.automata.size(); ++a) {
    const VariableId there = network_.automata[a].location;
    if (&network_.automata[a] == &automaton ||
        next.value(there) != state.value(there)) {
      next.clocks[a] = 0;
    }
  }
  return next;
}

std::vector<std::uint32_t> NaiveNetwork::enabled(
    const NaiveState& state) const {
  std::vector<std::uint32_t> all;
  std::vector<std::uint32_t> due;
  for (const Automaton& automaton : network_.automata) {
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      const Edge& edge = automaton.edges[e];
      if (!may_fire(state, automaton, edge)) continue;
      all.push_back(automaton.first_edge + e);
      if (automaton.kind == AutomatonKind::Timer &&
          is_at_deadline(state, automaton, edge)) {
        due.push_back(all.back());
      }
    }
  }
  return due.empty() ? all : due;
}

bool NaiveNetwork::may_wait(const NaiveState& state) const {
  for (const Automaton& automaton : network_.automata) {
    for (const Edge& edge : automaton.edges) {
      if (!may_fire(state, automaton, edge)) continue;
      const bool is_free = automaton.kind == AutomatonKind::StateVariable;
      if (network_.ticks == TickSemantics::None
              ? !is_free
              : is_at_deadline(state, automaton, edge)) {
        return false;
      }
    }
  }
  return true;
}

// The greatest time that some edge from the location can tell from a longer
// one; 0 when no edge asks for the time.
int NaiveNetwork::greatest_bound(const Automaton& automaton,
                                 std::size_t at) const {
  int bound = 0;
  for (const Edge& edge : automaton.edges) {
    if (index(edge.source) != at) continue;
    bound = std::max(bound, edge.when.lower);
    if (edge.when.upper != kUnbounded) bound = std::max(bound, edge.when.upper);
  }
  return bound;
}

NaiveState NaiveNetwork::waited(const NaiveState& state) const {
  NaiveState next = state;
  if (is_faulty(state) || network_.ticks == TickSemantics::None) return next;
  for (std::size_t a = 0; a < network_.automata.size(); ++a) {
    const Automaton& automaton = network_.automata[a];
    const int bound = greatest_bound(automaton, location(automaton, state));
    next.clocks[a] = std::min(next.clocks[a] + 1, bound);
  }
  return next;
}

std::optional<NaiveSpace> naive_space(const Network& network,
                                      std::size_t most) {
  const NaiveNetwork naive(network);
  NaiveSpace space;
  std::map<NaiveState, std::size_t> numbers;
  const auto number_of = [&](NaiveState state) {
    const auto [place, is_new] = numbers.emplace(state, space.states.size());
    if (is_new) space.states.push_back(std::move(state));
    return place->second;
  };
  number_of(naive.initial());
  for (std::size_t i = 0; i < space.states.size(); ++i) {
    if (space.states.size() > most) return std::nullopt;
    const NaiveState state = space.states[i];
    std::vector<NaiveSpace::Step> steps;
    for (const std::uint32_t number : naive.enabled(state)) {
      const Automaton& owner = network.owner_of_edge(number);
      steps.push_back(
          {number_of(naive.after(state, owner, network.edge(number))), number,
           owner.kind != AutomatonKind::StateVariable});
    }
    space.transitions += steps.size();
    bool is_dead = steps.empty();
    if (naive.may_wait(state)) {
      steps.push_back({number_of(naive.waited(state)), std::nullopt, true});
      if (steps.back().target != i) {
        is_dead = false;
        ++space.transitions;
      }
    }
    space.dead.push_back(is_dead);
    space.steps.push_back(std::move(steps));
  }
  return space;
}

}  // namespace btcheck::reference
