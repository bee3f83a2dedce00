// SPDX-License-Identifier: MIT
#include "model/btcpp/entries/options.hpp"

#include <algorithm>
#include <vector>

namespace btcheck::btcpp {

void add_option(ScriptOptions& options, const ScriptValue& value,
                const ScriptGuard& where) {
  if (where.is_never()) return;
  ScriptGuard& guard = options[value];
  guard = either(guard, where);
}

ScriptOptions under(const ScriptGuard& where, const ScriptOptions& options) {
  ScriptOptions all;
  for (const auto& [value, guard] : options) {
    add_option(all, value, both(where, guard));
  }
  return all;
}

bool is_ambiguous(const ScriptOptions& options) {
  std::vector<ScriptGuard> guards;
  for (const auto& [value, where] : options) guards.push_back(where);
  return !ScriptGuard::are_apart(guards);
}

ScriptValue merged(const ScriptOptions& options) {
  std::vector<ScriptValue> values;
  for (const auto& [value, where] : options) {
    const bool is_outside = value.kind == ScriptKind::Unknown ||
                            (value.kind == ScriptKind::Any && !value.is_lost());
    if (!is_outside) values.push_back(value);
  }
  if (values.empty()) {
    return options.empty() ? ScriptValue::lost() : ScriptValue::any();
  }
  const auto all = [&](auto wanted) {
    return std::all_of(values.begin(), values.end(), wanted);
  };
  ScriptValue any = ScriptValue::lost();
  if (all([](const ScriptValue& value) { return value.is_number(); })) {
    const bool are_integers = all([](const ScriptValue& value) {
      return value.type == NumberType::Integer;
    });
    const bool are_doubles = all([](const ScriptValue& value) {
      return value.type == NumberType::Whole || value.type == NumberType::Real;
    });
    any = ScriptValue::any_number(are_integers  ? NumberType::Integer
                                  : are_doubles ? NumberType::Real
                                                : NumberType::Either);
  } else if (all([](const ScriptValue& value) { return value.is_text(); })) {
    any = ScriptValue::any_text();
  }
  const bool are_alike = all([&](const ScriptValue& value) {
    return value.noted == values.front().noted;
  });
  return any.as(are_alike ? values.front().noted : EntryType::Other);
}

void CollectedOutcomes::add(const ScriptOutcome& outcome,
                            const ScriptGuard& where) {
  for (const ScriptValue& each : outcome.values) {
    add_option(result.options, each, where);
  }
  if (!outcome.values.empty()) result.yields = either(result.yields, where);
  if (outcome.may_throw) throws = either(throws, where);
}

}  // namespace btcheck::btcpp
