// SPDX-License-Identifier: MIT
//
// What a value may be, and in which states.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>

#include "model/btcpp/entries/guard.hpp"
#include "model/btcpp/script/value.hpp"

namespace btcheck::btcpp {

// The values that something may come to, and where: several guards may be true
// at once. Where none is, it throws.
using ScriptOptions = std::map<ScriptValue, ScriptGuard>;

void add_option(ScriptOptions& options, const ScriptValue& value,
                const ScriptGuard& where);

// The options in states where the guard is true, too.
ScriptOptions under(const ScriptGuard& where, const ScriptOptions& options);

// Where one of the values is possible that are asked for.
template <class Wanted>
ScriptGuard anywhere(const ScriptOptions& options, Wanted wanted) {
  ScriptGuard all;
  for (const auto& [value, guard] : options) {
    if (wanted(value)) all = either(all, guard);
  }
  return all;
}

// Whether several of the values may be possible in one state.
bool is_ambiguous(const ScriptOptions& options);
// What is known of all of them; what comes from outside is of the same kind.
ScriptValue merged(const ScriptOptions& options);

struct ScriptResult {
  ScriptOptions options;
  ScriptGuard yields;  // where there is an option
};

// The outcomes of an operator for all combinations of its operands.
struct CollectedOutcomes {
  static constexpr std::size_t kMostPairs = 2048;
  static constexpr std::size_t kFew = 8;

  ScriptResult result;
  ScriptGuard throws;
  bool is_rough = false;  // there were too many combinations

  void add(const ScriptOutcome& outcome, const ScriptGuard& where);

  // Of very many combinations, nothing is known.
  template <class Apply>
  void add_pairs(const ScriptOptions& left, const ScriptOptions& right,
                 Apply apply) {
    if (left.size() * right.size() > kMostPairs &&
        std::min(left.size(), right.size()) > kFew) {
      is_rough = true;
      return add({{ScriptValue::lost()}, true}, ScriptGuard::always());
    }
    for (const auto& [one, where] : left) {
      for (const auto& [other, elsewhere] : right) {
        const ScriptGuard guard = both(where, elsewhere);
        if (!guard.is_never()) add(apply(one, other), guard);
      }
    }
  }
};

}  // namespace btcheck::btcpp
