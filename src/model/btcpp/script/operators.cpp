// SPDX-License-Identifier: MIT
//
// After include/behaviortree_cpp/scripting/operators.hpp, utils/safe_any.hpp,
// utils/convert_impl.hpp, blackboard.h and actions/set_blackboard_node.h of
// BehaviorTree.CPP 4.10. A number is an int64 or a double there: literals
// without a point are integers, all that operators compute is a double, and an
// entry keeps the type that it was made with. An integer other than 0 and 1 is
// no truth value, and a fraction cannot go into an entry of integers.
//
// A text that begins with an upper-case letter may be an enumerator that the
// program has registered. A zero of type double may be a negative one.
#include "model/btcpp/script/value.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "model/tree/releases.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

using enum ScriptKind;
using Operation = ScriptOperation;

ScriptOutcome throws() { return {{}, true}; }
// What comes of values of which some are open.
ScriptOutcome anything(const ScriptValue& one, const ScriptValue& other = {}) {
  if (one.is_enumerator() || other.is_enumerator()) {
    return {{ScriptValue::enumerator()}, true};
  }
  if (one.is_lost() || other.is_lost()) return {{ScriptValue::lost()}, true};
  const bool is_outside = one.is_outside() || other.is_outside();
  return {{is_outside ? ScriptValue::outside() : ScriptValue::any()}, true};
}
ScriptOutcome some_number() { return {{ScriptValue::any_number()}, true}; }
ScriptOutcome surely(ScriptValue value) { return {{std::move(value)}, false}; }
ScriptOutcome either_way(bool may_throw) {
  return {{ScriptValue::of(false), ScriptValue::of(true)}, may_throw};
}

NumberType as_double(const ScriptValue& value) {
  return value.is_whole() ? NumberType::Whole : NumberType::Real;
}

ScriptValue negated(const ScriptValue& of) {
  if (of.kind == Number) return ScriptValue::real(-of.exact_number());
  if (of.is_any_number()) return ScriptValue::any_number(as_double(of));
  return ScriptValue::range(of.kind == AtLeast ? AtMost : AtLeast, -of.number,
                            as_double(of));
}

// Of two numbers. A range is moved by small numbers only, so that integers of
// more than 53 bits, which throw when they are read, are never reached.
ScriptValue sum(const ScriptValue& left, const ScriptValue& right) {
  if (left.is_any_number() || right.is_any_number()) {
    return ScriptValue::any_number();
  }
  if (left.kind == Number && right.kind == Number) {
    return ScriptValue::real(left.exact_number() + right.exact_number());
  }
  const double bound = left.number + right.number;
  const bool is_left_range = left.kind != Number;
  if (is_left_range && right.kind != Number) return ScriptValue::any_number();
  constexpr double kSmall = 0x1p31;
  const double by = is_left_range ? right.number : left.number;
  if (!(std::abs(by) <= kSmall)) return ScriptValue::any_number();
  const bool is_whole = left.is_whole() && right.is_whole();
  return ScriptValue::range(is_left_range ? left.kind : right.kind, bound,
                            is_whole ? NumberType::Whole : NumberType::Real);
}

bool fits_int64(double number) { return number >= -0x1p63 && number < 0x1p63; }

ScriptOutcome bits(Operation operation, double left, double right) {
  if (!is_integer(left) || !is_integer(right) || !fits_int64(left) ||
      !fits_int64(right)) {
    return throws();
  }
  const auto one = static_cast<std::int64_t>(left);
  const auto other = static_cast<std::int64_t>(right);
  const std::int64_t result = operation == Operation::BitAnd  ? one & other
                              : operation == Operation::BitOr ? one | other
                                                              : one ^ other;
  return surely(ScriptValue::real(static_cast<double>(result)));
}

ScriptValue quotient(const ScriptValue& left, const ScriptValue& right) {
  // An integer has no -0: then the sign of the infinity is not known.
  const bool is_any_zero =
      right.is_minus_zero && right.type == NumberType::Either;
  if (is_any_zero && left.number != 0) return ScriptValue::any_number();
  return ScriptValue::real(left.exact_number() / right.exact_number());
}

ScriptOutcome arithmetic(Operation operation, const ScriptValue& left,
                         const ScriptValue& right) {
  // What comes of NaN is NaN, but no integer.
  const bool is_nan = left.kind == NotANumber || right.kind == NotANumber;
  const bool are_known = left.kind == Number && right.kind == Number;
  switch (operation) {
    case Operation::Join:
      return throws();
    case Operation::BitAnd:
    case Operation::BitOr:
    case Operation::BitXor:
      if (is_nan) return throws();
      if (!are_known) return some_number();
      return bits(operation, left.number, right.number);
    default:
      break;
  }
  if (is_nan) {
    return surely(ScriptValue::real(std::numeric_limits<double>::quiet_NaN()));
  }
  if (operation == Operation::Add) return surely(sum(left, right));
  if (operation == Operation::Subtract) {
    return surely(sum(left, negated(right)));
  }
  if (!are_known) return surely(ScriptValue::any_number());
  if (operation == Operation::Multiply) {
    return surely(
        ScriptValue::real(left.exact_number() * right.exact_number()));
  }
  return surely(quotient(left, right));
}

ScriptOutcome logic(Operation operation, const ScriptValue& left,
                    const ScriptValue& right) {
  const ScriptTruth one = truth_of(left);
  const ScriptTruth other = truth_of(right);
  const bool is_and = operation == Operation::And;
  ScriptOutcome outcome;
  outcome.may_throw = one.may_throw || other.may_throw;
  for (const bool left_holds : {false, true}) {
    for (const bool right_holds : {false, true}) {
      if (!(left_holds ? one.may_hold : one.may_fail)) continue;
      if (!(right_holds ? other.may_hold : other.may_fail)) continue;
      outcome.values.push_back(ScriptValue::of(
          is_and ? left_holds && right_holds : left_holds || right_holds));
    }
  }
  return outcome;
}

// A text where a number is needed (StringToDouble).
ScriptOutcome number_beside(const ScriptValue& text) {
  if (text.kind != Text) return anything(text);
  if (text.text == "true") return surely(ScriptValue::of(true));
  if (text.text == "false") return surely(ScriptValue::of(false));
  if (const auto number = begun_number<double>(text.text)) {
    return surely(ScriptValue::real(*number));
  }
  if (!may_be_enumerator(text.text)) return throws();
  return {{ScriptValue::enumerator()}, true};
}

// The number of a declared enumerator that a text names (StringToDouble).
std::optional<ScriptValue> enumerator_in(const ScriptTree& script,
                                         const ScriptValue& text) {
  if (!script.enums || text.kind != Text) return std::nullopt;
  const auto found = script.enums->find(text.text);
  if (found == script.enums->end()) return std::nullopt;
  return ScriptValue::real(found->second);
}

template <class Value>
bool holds(ScriptComparison comparison, const Value& left, const Value& right,
           bool is_same) {
  switch (comparison) {
    case ScriptComparison::Equal:
      return is_same;
    case ScriptComparison::NotEqual:
      return !is_same;
    case ScriptComparison::Less:
      return !(left >= right);
    case ScriptComparison::LessEqual:
      return !(left > right);
    case ScriptComparison::Greater:
      return !(left <= right);
    case ScriptComparison::GreaterEqual:
      return !(left < right);
  }
  return false;
}

ScriptOutcome compare_numbers(ScriptComparison comparison,
                              const ScriptValue& left,
                              const ScriptValue& right) {
  const auto at_ends = [&](double one, double other) {
    return ScriptValue::of(
        holds(comparison, one, other, is_same_number(one, other)));
  };
  if (left.kind == Number && right.kind == Number) {
    return surely(at_ends(left.number, right.number));
  }
  if (left.kind == NotANumber || right.kind == NotANumber) {
    return surely(ScriptValue::of(comparison != ScriptComparison::Equal));
  }
  // If one is known to lie above the other, it makes no difference how far; if
  // it may also be equal, only the orders that allow equality are certain.
  const bool is_above = left.kind != AtMost && right.kind != AtLeast;
  const bool is_below = left.kind != AtLeast && right.kind != AtMost;
  const bool reaches = (is_above && left.number >= right.number) ||
                       (is_below && left.number <= right.number);
  const bool allows_equality =
      is_above ? comparison == ScriptComparison::GreaterEqual ||
                     comparison == ScriptComparison::Less
               : comparison == ScriptComparison::LessEqual ||
                     comparison == ScriptComparison::Greater;
  const bool is_apart =
      left.number != right.number && !is_same_number(left.number, right.number);
  if (!reaches || !(is_apart || allows_equality)) return either_way(false);
  return surely(at_ends(left.number, right.number));
}

// The text as it is printed. Any text for what may be an integer or a double,
// "0" or "0.000000".
ScriptValue text_of(const ScriptValue& value) {
  const bool is_sure =
      value.kind == Text ||
      (value.kind == Number && value.type != NumberType::Either &&
       value.type != NumberType::Whole);
  return is_sure ? ScriptValue::of(printed(value)) : ScriptValue::any_text();
}

// A number into an entry that keeps integers.
ScriptOutcome to_integer(const ScriptValue& value) {
  if (value.kind == NotANumber) return throws();
  if (value.kind != Number) {
    return {{ScriptValue::range(value.kind, value.number, NumberType::Integer)},
            !value.is_whole()};
  }
  if (!is_integer(value.number) || !fits_int64(value.number)) return throws();
  return surely(ScriptValue::integer(value.number));
}

ScriptValue to_real(const ScriptValue& value) {
  if (value.kind == NotANumber) return value;
  if (value.kind == Number) return ScriptValue::real(value.exact_number());
  return ScriptValue::range(value.kind, value.number, as_double(value));
}

// Into an entry that keeps integers or doubles, unknown which: fractions are
// doubles.
ScriptValue to_either(const ScriptValue& value) {
  if (value.kind == NotANumber) return value;
  ScriptValue either = value;
  const bool is_fraction = value.kind == Number && !value.is_whole();
  either.type = is_fraction ? NumberType::Real : NumberType::Either;
  return either;
}

// A text as the type of an entry has it read (TypeInfo::converter): the number
// that it begins with (convertFromString, src/basic_types.cpp).
ScriptOutcome converted(const ScriptValue& text, EntryType type) {
  if (type == EntryType::Text) return surely(text.as(EntryType::Free));
  if (type == EntryType::Generic) return throws();
  if (type == EntryType::Other || text.kind != Text) return anything(text);
  if (type == EntryType::Integer) {
    const auto whole = begun_number<std::int64_t>(text.text);
    if (!whole) return throws();
    return surely(ScriptValue::integer(static_cast<double>(*whole)));
  }
  const auto number = begun_number<double>(text.text);
  if (!number) return throws();
  return std::isfinite(*number) ? surely(ScriptValue::real(*number))
                                : anything(text);
}

// What a text becomes in an entry that holds none.
ScriptOutcome assigned_text(const ScriptValue& entry, const ScriptValue& text) {
  if (entry.noted != EntryType::Free) return converted(text, entry.noted);
  return entry.is_number() ? number_beside(text) : surely(text);
}

// Into an entry that a leaf has written, which has a value of the same kind.
ScriptOutcome assigned_outside(const ScriptValue& entry,
                               const ScriptValue& by) {
  if (by.is_of_any_kind()) return anything(entry, by);
  ScriptOutcome outcome;
  if (by.is_text()) {
    outcome = assigned_text(entry, by);
  } else if (entry.noted == EntryType::Integer) {
    outcome = to_integer(by);
  } else if (entry.noted == EntryType::Real) {
    outcome = surely(to_real(by));
  } else if (entry.noted != EntryType::Text) {
    outcome = surely(to_either(by));
  }
  for (ScriptValue& each : outcome.values) {
    if (each.is_of_any_kind()) each = ScriptValue::outside();
  }
  outcome.may_throw = true;
  return outcome;
}

ScriptOutcome assigned(const ScriptValue& entry, const ScriptValue& by) {
  if (by.is_nothing()) return throws();
  if (entry.is_outside()) return assigned_outside(entry, by);
  switch (entry.kind) {
    case Unset:
      return surely(by);
    case Text:
    case AnyText:
      if (by.is_text()) return surely(by);
      return by.is_of_any_kind()
                 ? ScriptOutcome{{ScriptValue::any_text()}, true}
                 : throws();
    case Any:  // what comes from outside is of the same kind
      if (entry.is_lost() && by.is_number()) return {{to_either(by)}, true};
      return by.is_number() ? ScriptOutcome{{by}, true} : anything(entry, by);
    case Unknown:  // what the program puts there is of the same kind
    case Empty:
      if (by.is_text()) return assigned_text(entry, by);
      return by.is_of_any_kind() ? anything(by) : surely(by);
    default:
      break;
  }
  if (by.is_of_any_kind()) return anything(by);
  if (by.is_text()) return assigned_text(entry, by);
  if (entry.type == NumberType::Integer) return to_integer(by);
  if (by.is_too_long() && entry.type != NumberType::Either) return throws();
  return entry.type == NumberType::Either
             ? ScriptOutcome{{to_either(by)}, !by.is_whole()}
             : surely(to_real(by));
}

ScriptOutcome in_entry(ScriptOutcome outcome, EntryType type) {
  for (ScriptValue& each : outcome.values) each = each.as(type);
  return outcome;
}

// Into an entry that ports have given a type (Blackboard::set<T> of 3.5 to
// 4.10): a text is read as the type has it, a number does not become a text. On
// a parent's blackboard a text replaces what is there.
ScriptOutcome written_typed(const ScriptValue& entry, SettingPlace place,
                            const ScriptValue& by) {
  const EntryType type = entry.noted;
  if (by.is_text()) {
    const bool is_read = place.is_own && type != EntryType::Other;
    return in_entry(is_read ? converted(by, type) : surely(by), type);
  }
  if (!by.is_number()) return surely(by.as(type));
  switch (type) {
    case EntryType::Text:
      return throws();
    case EntryType::Integer:
      return in_entry(to_integer(by), type);
    case EntryType::Real:
      return surely(to_real(by).as(type));
    default:
      return surely(by.as(type));
  }
}

}  // namespace

bool has_type(const ScriptValue& entry) {
  return entry.noted != EntryType::Free && entry.noted != EntryType::Generic;
}

ScriptOutcome apply_prefix(ScriptOperation operation, const ScriptValue& of) {
  if (of.is_nothing() || of.is_text() || of.is_too_long()) return throws();
  if (operation == Operation::Not) {
    const ScriptTruth truth = choice_of(of);
    ScriptOutcome outcome{{}, truth.may_throw};
    if (truth.may_hold) outcome.values.push_back(ScriptValue::of(false));
    if (truth.may_fail) outcome.values.push_back(ScriptValue::of(true));
    return outcome;
  }
  if (of.is_of_any_kind()) return anything(of);
  if (operation == Operation::Negate) {
    return of.kind == NotANumber ? surely(of) : surely(negated(of));
  }
  if (of.kind != Number) return some_number();
  if (!fits_int64(of.number)) return throws();
  const auto integer = static_cast<std::int64_t>(of.number);
  return surely(ScriptValue::real(static_cast<double>(~integer)));
}

ScriptOutcome prefix_in(const ScriptTree& script, ScriptOperation operation,
                        const ScriptValue& of) {
  const bool is_unchecked = script.converts_unchecked &&
                            operation == Operation::Complement &&
                            of.kind == Number && !fits_int64(of.number);
  return is_unchecked ? some_number() : apply_prefix(operation, of);
}

ScriptOutcome apply_binary(ScriptOperation operation, const ScriptValue& left,
                           const ScriptValue& right) {
  if (left.is_nothing() || right.is_nothing()) return throws();
  const bool is_logic =
      operation == Operation::And || operation == Operation::Or;
  if (is_logic) return logic(operation, left, right);
  if (left.is_of_any_kind() || right.is_of_any_kind())
    return anything(left, right);
  if (left.is_number() && right.is_number()) {
    if (left.is_too_long() || right.is_too_long()) return throws();
    return arithmetic(operation, left, right);
  }
  const bool are_texts = left.is_text() && right.is_text();
  const bool is_joining = operation == Operation::Join ||
                          (operation == Operation::Add && are_texts);
  if (!is_joining) return throws();
  const ScriptValue one = text_of(left);
  const ScriptValue other = text_of(right);
  if (one.kind != Text || other.kind != Text) {
    return surely(ScriptValue::any_text());
  }
  return surely(ScriptValue::of(one.text + other.text));
}

ScriptOutcome apply_comparison(ScriptComparison comparison,
                               const ScriptValue& left,
                               const ScriptValue& right) {
  if (left.is_nothing() || right.is_nothing()) return throws();
  if (left.is_of_any_kind() || right.is_of_any_kind()) return either_way(true);
  if (left.kind == Text && right.kind == Text) {
    return surely(ScriptValue::of(
        holds(comparison, left.text, right.text, left.text == right.text)));
  }
  if (left.is_text() && right.is_text()) return either_way(false);
  if (left.is_too_long() || right.is_too_long()) return throws();
  ScriptValue one = left;
  ScriptValue other = right;
  for (ScriptValue* each : {&one, &other}) {
    if (!each->is_text()) continue;
    const ScriptOutcome number = number_beside(*each);
    if (number.values.empty()) return throws();
    if (!number.values[0].is_number()) return either_way(number.may_throw);
    *each = number.values[0];
  }
  return compare_numbers(comparison, one, other);
}

// Of a text and a number some releases look at the left one only, which has to
// be a number; older ones throw.
ScriptOutcome compare_in(const ScriptTree& script, ScriptComparison comparison,
                         const ScriptValue& left, const ScriptValue& right) {
  const bool is_mixed = (left.is_text() && right.is_number()) ||
                        (left.is_number() && right.is_text());
  if (is_mixed && script.compares_no_mixture) return throws();
  if (!script.compares_with_itself || !is_mixed) {
    const ScriptValue& text = left.is_text() ? left : right;
    const auto number = is_mixed ? enumerator_in(script, text) : std::nullopt;
    return apply_comparison(comparison,
                            number && left.is_text() ? *number : left,
                            number && right.is_text() ? *number : right);
  }
  const bool is_known = left.kind == Text;
  if (is_known && !begun_number<double>(left.text)) return throws();
  return {{ScriptValue::of(holds(comparison, 0, 0, true))},
          left.is_text() && !is_known};
}

// What some releases refuse: a text to a number of a script.
ScriptOutcome assign_in(const ScriptTree& script, const ScriptValue& entry,
                        const ScriptValue& by) {
  const bool is_read =
      by.is_text() && entry.is_number() && entry.noted == EntryType::Free;
  if (is_read && script.numbers_refuse_texts) return throws();
  if (const auto number = is_read ? enumerator_in(script, by) : std::nullopt) {
    return surely(*number);
  }
  return apply_assignment(entry, by);
}

ScriptOutcome apply_assignment(const ScriptValue& entry,
                               const ScriptValue& by) {
  const bool is_new = entry.kind == Unset;
  return in_entry(assigned(entry, by.as(EntryType::Free)),
                  is_new ? EntryType::Free : entry.noted);
}

ScriptOutcome apply_change(ScriptOperation operation, const ScriptValue& entry,
                           const ScriptValue& by) {
  if (entry.is_nothing() || by.is_nothing()) return throws();
  const bool is_sum = operation == Operation::SetSum;
  if (entry.is_of_any_kind() || by.is_of_any_kind()) {
    return in_entry(anything(entry, by), entry.noted);
  }
  if (entry.is_text() && by.is_text() && is_sum) {
    const bool is_known = entry.kind == Text && by.kind == Text;
    return in_entry(surely(is_known ? ScriptValue::of(entry.text + by.text)
                                    : ScriptValue::any_text()),
                    entry.noted);
  }
  if (!entry.is_number() || !by.is_number()) return throws();
  if (entry.is_too_long() || by.is_too_long()) return throws();
  const ScriptOutcome results =
      arithmetic(is_sum                                  ? Operation::Add
                 : operation == Operation::SetDifference ? Operation::Subtract
                 : operation == Operation::SetProduct    ? Operation::Multiply
                                                         : Operation::Divide,
                 entry, by);
  return apply_assignment(entry, results.values[0]);
}

ScriptOutcome apply_setting(const ScriptValue& entry, SettingPlace place,
                            const ScriptValue& by) {
  // A new entry takes over the type of the one that is copied.
  const EntryType type = place.exists ? entry.noted : by.noted;
  const EntryType after =
      type == EntryType::Free && place.is_own ? EntryType::Generic : type;
  const ScriptValue value = by.as(EntryType::Free);
  if (value.is_of_any_kind()) {
    return in_entry(anything(value), after);
  }
  if (value.is_text() && type != EntryType::Text) {
    if (type != EntryType::Free) return in_entry(converted(value, type), after);
    return surely(ScriptValue::empty().as(after));
  }
  switch (type) {
    case EntryType::Free:
    case EntryType::Generic:
      return in_entry(surely(value), after);
    case EntryType::Text:
      return value.is_text() ? in_entry(surely(value), after) : throws();
    case EntryType::Integer:
      // An `int` is refused an `int64`.
      if (value.type == NumberType::Real || value.type == NumberType::Whole) {
        return throws();
      }
      return in_entry({{value}, by.noted != EntryType::Integer}, after);
    case EntryType::Real:
      if (value.type == NumberType::Integer) return throws();
      return in_entry({{value}, value.type == NumberType::Either}, after);
    case EntryType::Other:
      break;
  }
  return in_entry(anything(value), after);
}

// Release 3 replaces the value as a whole. Before 4.7 a copy keeps the type of
// the entry, or is a text; a text makes one of texts of an entry without a
// type.
ScriptOutcome apply_setting_in(int release, bool copies,
                               const ScriptValue& entry, SettingPlace place,
                               const ScriptValue& by) {
  if (release < releases::kFirst4) return surely(by);
  if (releases::kCopiesSomething.has(release)) {
    return apply_setting(entry, place, by);
  }
  if (copies && releases::copies_anything(release)) {
    return surely(place.exists ? by.as(entry.noted) : by);
  }
  const ScriptValue text = text_of(by);
  const bool is_typed =
      entry.noted != EntryType::Free && entry.noted != EntryType::Generic;
  if (place.exists && is_typed) return apply_setting(entry, place, text);
  const bool becomes_text =
      releases::kTextsStayTexts.has(release) || (place.exists && place.is_own);
  return surely(text.as(becomes_text ? EntryType::Text : EntryType::Free));
}

ScriptOutcome written_by_leaf(const ScriptValue& entry, SettingPlace place,
                              const ScriptValue& by) {
  if (place.exists && has_type(entry)) return written_typed(entry, place, by);
  if (place.exists && !place.is_own) return surely(by.as(entry.noted));
  if (by.is_text()) {
    return surely(by.as(place.exists ? EntryType::Text : EntryType::Free));
  }
  const bool is_integer = by.is_number() && by.type == NumberType::Integer;
  const bool is_real = by.is_number() && by.type == NumberType::Real;
  return surely(by.as(is_integer ? EntryType::Integer
                      : is_real  ? EntryType::Real
                                 : EntryType::Other));
}

}  // namespace btcheck::btcpp
