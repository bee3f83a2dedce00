// SPDX-License-Identifier: MIT
#include "model/btcpp/script_options.hpp"

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

void CollectedOutcomes::add(const ScriptOutcome& outcome,
                            const ScriptGuard& where) {
  for (const ScriptValue& each : outcome.values) {
    add_option(result.options, each, where);
  }
  if (!outcome.values.empty()) result.yields = either(result.yields, where);
  if (outcome.may_throw) throws = either(throws, where);
}

}  // namespace btcheck::btcpp
