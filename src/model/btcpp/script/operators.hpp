// SPDX-License-Identifier: MIT
//
// What the operators of scripts make of values, and what entries keep of them.
#pragma once

#include <vector>

#include "model/btcpp/script/script.hpp"
#include "model/btcpp/script/value.hpp"

namespace btcheck::btcpp {

// What evaluating something may come to: one of the values, or an exception.
struct ScriptOutcome {
  std::vector<ScriptValue> values;
  bool may_throw = false;
};

// Of Negate, Complement and Not.
ScriptOutcome apply_prefix(ScriptOperation operation, const ScriptValue& of);

// Of the binary operations from Add to Or.
ScriptOutcome apply_binary(ScriptOperation operation, const ScriptValue& left,
                           const ScriptValue& right);

ScriptOutcome apply_comparison(ScriptComparison comparison,
                               const ScriptValue& left,
                               const ScriptValue& right);

// What an entry of this value holds after `:=` and `=`: it keeps its type. In
// an entry that has not been written, `noted` is the type that its ports say.
ScriptOutcome apply_assignment(const ScriptValue& entry, const ScriptValue& by);
// After `+=`, `-=`, `*=` and `/=`.
ScriptOutcome apply_change(ScriptOperation operation, const ScriptValue& entry,
                           const ScriptValue& by);
// After a SetBlackboard of version 4.
struct SettingPlace {
  bool exists = true;  // the entry, of which nothing else need be known
  // The key is no parent's, by remapping: Blackboard::set types an entry only
  // on the blackboard that holds it (BehaviorTree.CPP 4.10, blackboard.h).
  bool is_own = true;
};
ScriptOutcome apply_setting(const ScriptValue& entry, SettingPlace place,
                            const ScriptValue& by);

}  // namespace btcheck::btcpp
