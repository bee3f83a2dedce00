// SPDX-License-Identifier: MIT
#include "model/export/steps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/export/layout.hpp"

namespace btcheck {
namespace {

// By location: the greatest time at which some edge from there still behaves
// otherwise than later on; 0: no clock runs there.
std::vector<int> clock_bounds(const Automaton& automaton) {
  std::vector<int> bounds(automaton.locations.size(), 0);
  for (const Edge& edge : automaton.edges) {
    int& bound = bounds[index(edge.source)];
    bound = std::max(bound, edge.when.greatest_clock());
  }
  return bounds;
}

// Whether the clock can reach the edge's upper bound.
bool can_be_late(const Edge& edge) { return edge.when.upper != kUnbounded; }

}  // namespace

int StepConditions::clock_bound_at(AutomatonId id, LocationId location) const {
  const auto [bounds, is_new] = bounds_.try_emplace(id);
  if (is_new) bounds->second = clock_bounds(network_.automaton(id));
  return bounds->second[index(location)];
}

int clock_bound(const Automaton& automaton) {
  const std::vector<int> bounds = clock_bounds(automaton);
  return bounds.empty() ? 0 : *std::ranges::max_element(bounds);
}

bool is_due_first(const Automaton& automaton, const Edge& edge) {
  return automaton.kind == AutomatonKind::Timer && can_be_late(edge);
}

bool is_binding(TickSemantics ticks, const Automaton& automaton,
                const Edge& edge) {
  return ticks == TickSemantics::None ? !moves_freely(automaton)
                                      : can_be_late(edge);
}

bool moves_freely(const Automaton& automaton) {
  return automaton.kind == AutomatonKind::StateVariable;
}

bool has_free_moves(const Network& network) {
  return std::ranges::any_of(network.automata, [](const Automaton& automaton) {
    return moves_freely(automaton) && !automaton.edges.empty();
  });
}

std::vector<VariableId> declared_variables(const Network& network,
                                           const Automaton& automaton) {
  std::vector<VariableId> own;
  if (network.variable(automaton.location).role != VariableRole::State) {
    own.push_back(automaton.location);
  }
  if (automaton.gate) own.push_back(*automaton.gate);
  if (automaton.kind == AutomatonKind::Node) {
    own.push_back(network.node_status[index(automaton.node)]);
  }
  own.insert(own.end(), automaton.locals.begin(), automaton.locals.end());
  return own;
}

int location_value(const Network& network, const Automaton& automaton,
                   LocationId location) {
  return network.variable(automaton.location).min +
         static_cast<int>(index(location));
}

void StepConditions::add_and(std::string& text, std::string_view more) const {
  append(text, language_.signs().conjunction, more);
}

std::string StepConditions::is_at(const Automaton& automaton,
                                  LocationId location) const {
  const int value = location_value(network_, automaton, location);
  return fmt::format("{}{}{}", language_.names().variable(automaton.location),
                     language_.signs().equals,
                     language_.names().value(automaton.location, value));
}

std::string StepConditions::guard(const Edge& edge) const {
  std::string guard;
  for (const Expression& conjunct : edge.guard.conjuncts()) {
    const bool is_loose = conjunct.terms().back().operation == Operation::Or;
    const std::string part = language_.condition(conjunct);
    add_and(guard, is_loose ? "(" + part + ")" : part);
  }
  return guard;
}

std::string StepConditions::is_ready(AutomatonId id, const Edge& edge) const {
  std::string ready = is_at(network_.automaton(id), edge.source);
  add_and(ready, guard(edge));
  if (edge.when.lower > 0) {
    add_and(ready, fmt::format("{} >= {}", language_.names().clock(id),
                               edge.when.lower));
  }
  return ready;
}

std::string StepConditions::is_last_moment(AutomatonId id,
                                           const Edge& edge) const {
  if (clock_bound_at(id, edge.source) == 0) return {};
  return fmt::format("{}{}{}", language_.names().clock(id),
                     language_.signs().equals, edge.when.upper);
}

std::string StepConditions::timer_is_due() const {
  std::string due;
  for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
    const Automaton& automaton = network_.automata[a];
    for (const Edge& edge : automaton.edges) {
      if (!is_due_first(automaton, edge)) continue;
      std::string one = is_at(automaton, edge.source);
      add_and(one, is_last_moment(AutomatonId{a}, edge));
      append(due, language_.signs().disjunction, "(" + one + ")");
    }
  }
  return due;
}

std::string StepConditions::turn(AutomatonId id, const Edge& edge) const {
  const std::string none_due =
      std::string(language_.signs().negation) + "timer_is_due";
  if (!is_due_first(network_.automaton(id), edge)) return none_due;
  const std::string now = is_last_moment(id, edge);
  if (now.empty()) return {};
  return fmt::format("({}{}{})", now, language_.signs().disjunction, none_due);
}

std::string StepConditions::clock_runs(AutomatonId id) const {
  const Automaton& automaton = network_.automaton(id);
  std::string where;
  for (std::uint32_t i = 0; i < automaton.locations.size(); ++i) {
    const int bound = clock_bound_at(id, LocationId{i});
    if (bound == 0) continue;
    std::string here = is_at(automaton, LocationId{i});
    add_and(here, fmt::format("{} < {}", language_.names().clock(id), bound));
    append(where, language_.signs().disjunction, "(" + here + ")");
  }
  return where;
}

}  // namespace btcheck
