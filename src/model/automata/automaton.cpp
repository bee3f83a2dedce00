// SPDX-License-Identifier: MIT
//
// Locations by name, and the expressions that most guards are made of.
#include "model/automata/automaton.hpp"

#include <algorithm>

namespace btcheck {

Expression read(VariableId variable) {
  return Expression::variable(static_cast<std::int32_t>(index(variable)));
}

Expression equals(VariableId variable, int value) {
  return Expression::binary(Operation::Equal, read(variable),
                            Expression::constant(value));
}

Expression equals(VariableId variable, NodeStatus status) {
  return equals(variable, static_cast<int>(status));
}

Expression differs(VariableId variable, int value) {
  return Expression::binary(Operation::NotEqual, read(variable),
                            Expression::constant(value));
}

bool is_answer(LocationRole role) {
  return is_end(role) || role == LocationRole::Running;
}

bool is_end(LocationRole role) {
  return role == LocationRole::Success || role == LocationRole::Failure ||
         role == LocationRole::Skipped;
}

namespace {

template <class Is>
std::optional<LocationId> first_location(const Automaton& automaton, Is&& is) {
  const auto& all = automaton.locations;
  const auto found = std::find_if(all.begin(), all.end(), is);
  if (found == all.end()) return std::nullopt;
  return LocationId{static_cast<std::uint32_t>(found - all.begin())};
}

}  // namespace

std::optional<LocationId> Automaton::find_location(
    std::string_view word) const {
  return first_location(
      *this, [&](const Location& each) { return each.name == word; });
}

std::optional<LocationId> Automaton::find_location(LocationRole role) const {
  return first_location(
      *this, [&](const Location& each) { return each.role == role; });
}

std::vector<std::string> Automaton::location_names() const {
  std::vector<std::string> names;
  for (const Location& each : locations) names.push_back(each.name);
  return names;
}

}  // namespace btcheck
