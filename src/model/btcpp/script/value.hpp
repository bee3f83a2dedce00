// SPDX-License-Identifier: MIT
//
// What is known of a value in a script, what the operators make of values, and
// what entries keep of them.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/script/script.hpp"

namespace btcheck::btcpp {

enum class ScriptKind : std::uint8_t {
  Unknown,  // of an entry that the tree has not written: whatever the program
            // has put there, or none
  Unset,    // no entry: reading it throws
  Empty,    // an entry that holds nothing: the same, but it can be assigned to
  Any,      // some value; it may come from outside
  AnyText,  // some text
  AtMost,   // some number up to this
  Number,   // this one
  AtLeast,  // some number from this on
  NotANumber,
  Text
};

// How the engine keeps a number: as an int64, as a double, or unknown which. Of
// a double whose value is unknown it may still be known that it is whole.
enum class NumberType : std::uint8_t { Integer, Whole, Real, Either };

// What the engine has noted of an entry's type (TypeInfo of 4.10): scripts make
// entries that are free, SetBlackboard and typed ports others.
enum class EntryType : std::uint8_t {
  Free,     // AnyTypeAllowed
  Generic,  // BT::Any: a SetBlackboard has written it
  Text,
  Integer,
  Real,
  Other  // of the program
};

struct ScriptValue {
  ScriptKind kind = ScriptKind::Unknown;
  double number = 0;
  std::string text;
  NumberType type = NumberType::Integer;  // of a Number never Whole
  EntryType noted = EntryType::Free;      // where an entry holds it
  // A Number that is the double -0: kept as 0, but 1 / -0 is minus infinity.
  bool is_minus_zero = false;

  static ScriptValue unset() { return {ScriptKind::Unset, 0, {}, {}, {}}; }
  static ScriptValue empty() { return {ScriptKind::Empty, 0, {}, {}, {}}; }
  static ScriptValue any() { return {ScriptKind::Any, 0, {}, {}, {}}; }
  // A value that the tree gives; it is not known which.
  static ScriptValue lost() {
    return {ScriptKind::Any, 0, {}, NumberType::Either, {}};
  }
  // A value that a leaf has written. Scripts are taken to throw because of it
  // only where they would whatever it is.
  static ScriptValue outside() {
    return {ScriptKind::Any, 0, {}, NumberType::Real, {}};
  }
  // The number of an enumerator that nobody has declared; as much is known of
  // what is computed with it.
  static ScriptValue enumerator() {
    return {ScriptKind::Any, 0, {}, NumberType::Whole, {}};
  }
  static ScriptValue any_text() { return {ScriptKind::AnyText, 0, {}, {}, {}}; }
  // A number known by one end.
  static ScriptValue range(ScriptKind kind, double number, NumberType type);
  // Some number, at least minus infinity.
  static ScriptValue any_number(NumberType type = NumberType::Real);
  // Any where it does not fit into 64 bits.
  static ScriptValue integer(double number);
  static ScriptValue real(double number);
  static ScriptValue of(bool truth) { return real(truth ? 1 : 0); }
  static ScriptValue of(double) = delete;  // an integer, or real?
  static ScriptValue of(int) = delete;
  // AnyText when it has more than 200 bytes.
  static ScriptValue of(std::string text);

  bool is_number() const {
    return kind >= ScriptKind::AtMost && kind <= ScriptKind::NotANumber;
  }
  bool is_text() const {
    return kind == ScriptKind::Text || kind == ScriptKind::AnyText;
  }
  bool is_any_number() const;
  // A Number with the sign of its zero.
  double exact_number() const { return is_minus_zero ? -0.0 : number; }
  // Some number of several.
  bool is_range() const { return is_number() && kind != ScriptKind::Number; }
  bool is_lost() const {
    return kind == ScriptKind::Any && type == NumberType::Either;
  }
  bool is_outside() const {
    return kind == ScriptKind::Any && type == NumberType::Real;
  }
  bool is_enumerator() const {
    return kind == ScriptKind::Any && type == NumberType::Whole;
  }
  // Nothing is known of it, not even a kind.
  bool is_of_any_kind() const {
    return kind == ScriptKind::Any || kind == ScriptKind::Unknown;
  }
  // An integer that no double holds for sure: it can be copied and printed, but
  // throws where it is needed as a number (convertNumber of 4.10).
  bool is_too_long() const;
  // The tree has given it for certain.
  bool is_something() const {
    return kind != ScriptKind::Unknown && !is_nothing();
  }
  bool is_nothing() const {
    return kind == ScriptKind::Unset || kind == ScriptKind::Empty;
  }
  bool is_whole() const;
  // The same in an entry of this type.
  ScriptValue as(EntryType entry) const;

  auto operator<=>(const ScriptValue&) const = default;
};

// Whether a value counts as true: `truth_of` for conditions and logical
// operators, `choice_of` for what stands before a `?`.
struct ScriptTruth {
  bool may_hold = false;
  bool may_fail = false;
  bool may_throw = false;
};
ScriptTruth truth_of(const ScriptValue& value);
ScriptTruth choice_of(const ScriptValue& value);

// The same in a script, as the release has it that the script was read for.
ScriptTruth choice_in(const ScriptTree& script, const ScriptValue& value);
// What a literal or an entry is in a script of the release.
ScriptValue read_in(const ScriptTree& script, const ScriptValue& value);

// As operators and ports compare numbers, within the epsilon of a float.
bool is_same_number(double left, double right);
// A Text or a Number, as Any::cast<std::string> prints it.
std::string printed(const ScriptValue& value);

// The number, if the whole text is one: "-2.50".
std::optional<double> number_in(std::string_view text);

// Whether a text, or a name that nothing writes, may be an enumerator that the
// program has registered: it begins with a capital.
bool may_be_enumerator(std::string_view text);

bool is_integer(double number);

// What evaluating something may come to: one of the values, or an exception.
struct ScriptOutcome {
  std::vector<ScriptValue> values;
  bool may_throw = false;
};

// Of Negate, Complement and Not.
ScriptOutcome apply_prefix(ScriptOperation operation, const ScriptValue& of);
// In a script, as the release has it that the script was read for.
ScriptOutcome prefix_in(const ScriptTree& script, ScriptOperation operation,
                        const ScriptValue& of);

// Of the binary operations from Add to Or.
ScriptOutcome apply_binary(ScriptOperation operation, const ScriptValue& left,
                           const ScriptValue& right);

ScriptOutcome apply_comparison(ScriptComparison comparison,
                               const ScriptValue& left,
                               const ScriptValue& right);
// In a script, as the release has it that the script was read for.
ScriptOutcome compare_in(const ScriptTree& script, ScriptComparison comparison,
                         const ScriptValue& left, const ScriptValue& right);

// Whether what an entry of this value is given has to be of its type.
bool has_type(const ScriptValue& entry);

// What an entry of this value holds after `:=` and `=`: it keeps its type. In
// an entry that has not been written, `noted` is the type that its ports say.
ScriptOutcome apply_assignment(const ScriptValue& entry, const ScriptValue& by);
// The same in a script, as the release has it that the script was read for.
ScriptOutcome assign_in(const ScriptTree& script, const ScriptValue& entry,
                        const ScriptValue& by);
// After `+=`, `-=`, `*=` and `/=`.
ScriptOutcome apply_change(ScriptOperation operation, const ScriptValue& entry,
                           const ScriptValue& by);
// Where a leaf or a SetBlackboard of version 4 writes.
struct SettingPlace {
  bool exists = true;  // the entry, of which nothing else need be known
  // The key is no parent's, by remapping: Blackboard::set types an entry only
  // on the blackboard that holds it (BehaviorTree.CPP 4.10, blackboard.h).
  bool is_own = true;
};
// After a SetBlackboard.
ScriptOutcome apply_setting(const ScriptValue& entry, SettingPlace place,
                            const ScriptValue& by);
// The same in this release of the engine, of a value that is copied from
// another entry or written in the tree.
ScriptOutcome apply_setting_in(int release, bool copies,
                               const ScriptValue& entry, SettingPlace place,
                               const ScriptValue& by);
// After a leaf of the user's, as its contract says. The value has the type that
// it is written in: 2 is an int, 2.0 a double. An entry without a type takes it
// over, but a text makes a new entry that has none.
// Where ports have given it another type, the leaf throws.
ScriptOutcome written_by_leaf(const ScriptValue& entry, SettingPlace place,
                              const ScriptValue& by);

}  // namespace btcheck::btcpp
