// SPDX-License-Identifier: MIT
#include "model/btcpp/script/domain.hpp"

#include <algorithm>

namespace btcheck::btcpp {
namespace {

bool is_one_value(const ScriptValue& value) {
  return value.kind == ScriptKind::Number || value.kind == ScriptKind::Text ||
         value.kind == ScriptKind::NotANumber ||
         value.kind == ScriptKind::Empty;
}

}  // namespace

ScriptValue DeclaredDomain::as_held(const ScriptValue& value) const {
  if (value.kind != ScriptKind::Number) return value.as(type);
  const bool is_real = type == EntryType::Real || !value.is_whole();
  return (is_real ? ScriptValue::real(value.number)
                  : ScriptValue::integer(value.number))
      .as(type);
}

ScriptValue DeclaredDomain::number(std::int64_t value) const {
  return as_held(ScriptValue::integer(static_cast<double>(value)));
}

std::optional<ScriptValue> DeclaredDomain::held(
    const ScriptValue& value) const {
  if (!is_one_value(value)) return value;
  if (is_range()) {
    const bool is_inside = value.kind == ScriptKind::Number &&
                           value.is_whole() &&
                           value.number >= static_cast<double>(min) &&
                           value.number <= static_cast<double>(max);
    return is_inside ? std::optional(as_held(value)) : std::nullopt;
  }
  const auto found = std::ranges::find_if(states, [&](const auto& state) {
    return state.kind == value.kind && state.number == value.number &&
           state.text == value.text;
  });
  return found == states.end() ? std::nullopt : std::optional(as_held(*found));
}

bool DeclaredDomain::may_leave(const ScriptValue& value) {
  return value.is_lost() || value.is_range() ||
         value.kind == ScriptKind::AnyText;
}

}  // namespace btcheck::btcpp
