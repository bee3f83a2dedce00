// SPDX-License-Identifier: MIT
//
// The values that a blackboard entry is declared to have: whole numbers of a
// range, or some texts or numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/btcpp/script/value.hpp"

namespace btcheck::btcpp {

struct DeclaredDomain {
  // Empty: the whole numbers from `min` to `max`.
  std::vector<ScriptValue> states;
  std::int64_t min = 0;
  std::int64_t max = 0;
  // What the engine has noted of the entry; all its values are kept so.
  EntryType type = EntryType::Free;

  bool is_range() const { return states.empty(); }
  bool are_numbers() const { return is_range() || states[0].is_number(); }
  // As the entry holds this one of its values.
  ScriptValue as_held(const ScriptValue& value) const;
  ScriptValue number(std::int64_t value) const;

  // A value that the entry is given, as it holds it; nothing where it is none
  // of the domain. What is not known exactly stays as it is.
  std::optional<ScriptValue> held(const ScriptValue& value) const;
  // Whether a value that is not known exactly may be none of the domain.
  static bool may_leave(const ScriptValue& value);
};

}  // namespace btcheck::btcpp
