// SPDX-License-Identifier: MIT
//
// What is known of a value in a script, and what operators make of it.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/script_tree.hpp"

namespace btcheck::btcpp {

enum class ScriptKind : unsigned char {
  Unknown,  // anything, also no value at all
  Unset,    // no entry: whoever reads it throws
  AnyText,  // some text
  AtMost,   // some number up to this
  Number,   // this one, whatever type the engine keeps it in; never NaN
  AtLeast,  // some number from this on
  Text
};

struct ScriptValue {
  ScriptKind kind = ScriptKind::Unknown;
  double number = 0;
  std::string text;

  static ScriptValue unset() { return {ScriptKind::Unset, 0, {}}; }
  static ScriptValue any_text() { return {ScriptKind::AnyText, 0, {}}; }
  // Unknown when it has 2^53 or more: as an integer it cannot be read.
  static ScriptValue of(double number);
  static ScriptValue of(bool truth) { return of(truth ? 1.0 : 0.0); }
  // AnyText when it has more than 200 bytes.
  static ScriptValue of(std::string text);

  bool is_number() const {
    return kind == ScriptKind::Number || kind == ScriptKind::AtLeast ||
           kind == ScriptKind::AtMost;
  }
  bool is_text() const {
    return kind == ScriptKind::Text || kind == ScriptKind::AnyText;
  }
  auto operator<=>(const ScriptValue&) const = default;
};

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

// What an entry of this value holds after SetSum to SetQuotient.
ScriptOutcome apply_change(ScriptOperation operation, const ScriptValue& entry,
                           const ScriptValue& by);

// Whether a value counts as true: of conditions and logical operators, and of
// what stands before a `?`.
struct ScriptTruth {
  bool may_hold = false;
  bool may_fail = false;
  bool may_throw = false;
};
ScriptTruth truth_of(const ScriptValue& value);
ScriptTruth choice_of(const ScriptValue& value);

// The number that a text as a whole is, "-2.50".
std::optional<double> number_in(std::string_view text);

}  // namespace btcheck::btcpp
