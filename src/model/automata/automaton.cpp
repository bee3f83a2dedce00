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

std::optional<LocationId> Automaton::find_location(
    std::string_view word) const {
  auto found = std::find(locations.begin(), locations.end(), word);
  if (found == locations.end()) return std::nullopt;
  return LocationId{static_cast<std::uint32_t>(found - locations.begin())};
}

}  // namespace btcheck
