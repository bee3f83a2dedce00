// SPDX-License-Identifier: MIT
//
// After include/behaviortree_cpp/scripting/operators.hpp and
// utils/convert_impl.hpp of BehaviorTree.CPP 4.10. There a number is an int64,
// an uint64 or a double, which shows in few places only: an integer other than
// 0 and 1 is no truth value, a fraction no operand of bits and no value of an
// integer entry, and `..` prints the types differently. Here the type is not
// kept, and each of these places may throw, or has an unknown result.
//
// Texts that are no plain numbers may still be read as some: of registered
// enumerations, and by std::from_chars up to the first other character.
#include "model/btcpp/script_value.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace btcheck::btcpp {
namespace {

using enum ScriptKind;
using Operation = ScriptOperation;

ScriptOutcome throws() { return {{}, true}; }
ScriptOutcome anything() { return {{ScriptValue{}}, true}; }
ScriptOutcome surely(ScriptValue value) { return {{std::move(value)}, false}; }
ScriptOutcome either_way(bool may_throw) {
  return {{ScriptValue::of(false), ScriptValue::of(true)}, may_throw};
}

// -0 is kept as 0: an integer entry loses the sign.
double plain(double number) { return number == 0 ? 0 : number; }

bool is_integer(double number) { return number == std::nearbyint(number); }

ScriptValue at_least(double number) { return {AtLeast, plain(number), {}}; }
ScriptValue at_most(double number) { return {AtMost, plain(number), {}}; }

ScriptValue negated(const ScriptValue& of) {
  if (of.kind == Number) return ScriptValue::of(-of.number);
  return of.kind == AtLeast ? at_most(-of.number) : at_least(-of.number);
}

// Of two numbers. A range is moved by small numbers only, so that integers of
// more than 53 bits, which throw when they are read, are never reached.
ScriptValue sum(const ScriptValue& left, const ScriptValue& right) {
  const double bound = left.number + right.number;
  if (left.kind == Number && right.kind == Number) {
    return ScriptValue::of(bound);
  }
  const bool is_left_range = left.kind != Number;
  if (is_left_range && right.kind != Number) return {};
  constexpr double kSmall = 0x1p31;
  if (std::abs(is_left_range ? right.number : left.number) > kSmall) return {};
  const ScriptKind kind = is_left_range ? left.kind : right.kind;
  return kind == AtLeast ? at_least(bound) : at_most(bound);
}

ScriptOutcome bits(Operation operation, double left, double right) {
  if (!is_integer(left) || !is_integer(right)) return throws();
  const auto one = static_cast<std::int64_t>(left);
  const auto other = static_cast<std::int64_t>(right);
  const std::int64_t result = operation == Operation::BitAnd  ? one & other
                              : operation == Operation::BitOr ? one | other
                                                              : one ^ other;
  return surely(ScriptValue::of(static_cast<double>(result)));
}

ScriptOutcome arithmetic(Operation operation, const ScriptValue& left,
                         const ScriptValue& right) {
  switch (operation) {
    case Operation::Add:
      return surely(sum(left, right));
    case Operation::Subtract:
      return surely(sum(left, negated(right)));
    case Operation::Join:
      return throws();
    case Operation::BitAnd:
    case Operation::BitOr:
    case Operation::BitXor:
      if (left.kind != Number || right.kind != Number) return anything();
      return bits(operation, left.number, right.number);
    default:
      break;
  }
  if (left.kind != Number || right.kind != Number) return surely({});
  if (operation == Operation::Multiply) {
    return surely(ScriptValue::of(left.number * right.number));
  }
  if (right.number == 0) return surely({});  // infinite, by a zero of any sign
  return surely(ScriptValue::of(left.number / right.number));
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

// What a text is beside a number, when that can be told.
std::optional<double> number_beside(const ScriptValue& text) {
  if (text.text == "true") return 1;
  if (text.text == "false") return 0;
  return number_in(text.text);
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
      return left < right;
    case ScriptComparison::LessEqual:
      return left <= right;
    case ScriptComparison::Greater:
      return left > right;
    case ScriptComparison::GreaterEqual:
      return left >= right;
  }
  return false;
}

bool is_same(double left, double right) {
  return std::abs(left - right) <=
         static_cast<double>(std::numeric_limits<float>::epsilon());
}

ScriptOutcome compare_numbers(ScriptComparison comparison,
                              const ScriptValue& left,
                              const ScriptValue& right) {
  const auto at_ends = [&](double one, double other) {
    return ScriptValue::of(holds(comparison, one, other, is_same(one, other)));
  };
  if (left.kind == Number && right.kind == Number) {
    return surely(at_ends(left.number, right.number));
  }
  // One is known to lie above the other; how far makes no difference.
  const bool is_above = left.kind != AtMost && right.kind != AtLeast;
  const bool is_below = left.kind != AtLeast && right.kind != AtMost;
  const bool is_apart = !is_same(left.number, right.number);
  if ((is_above && left.number > right.number && is_apart) ||
      (is_below && left.number < right.number && is_apart)) {
    return surely(at_ends(left.number, right.number));
  }
  const bool is_touching = (is_above && left.number >= right.number) ||
                           (is_below && left.number <= right.number);
  // At the common end itself only the orders that allow it are certain.
  if (is_touching && (comparison == ScriptComparison::GreaterEqual ||
                      comparison == ScriptComparison::Less)) {
    if (is_above) return surely(at_ends(left.number, right.number));
  }
  if (is_touching && (comparison == ScriptComparison::LessEqual ||
                      comparison == ScriptComparison::Greater)) {
    if (is_below) return surely(at_ends(left.number, right.number));
  }
  return either_way(false);
}

}  // namespace

ScriptValue ScriptValue::of(double number) {
  if (!(std::abs(number) < 0x1p53)) return {};
  return {Number, plain(number), {}};
}

ScriptValue ScriptValue::of(std::string text) {
  constexpr std::size_t kMostBytes = 200;
  if (text.size() > kMostBytes) return any_text();
  return {Text, 0, std::move(text)};
}

ScriptOutcome apply_prefix(ScriptOperation operation, const ScriptValue& of) {
  if (of.kind == Unset || of.is_text()) return throws();
  if (operation == Operation::Not) {
    const ScriptTruth truth = choice_of(of);
    ScriptOutcome outcome{{}, truth.may_throw};
    if (truth.may_hold) outcome.values.push_back(ScriptValue::of(false));
    if (truth.may_fail) outcome.values.push_back(ScriptValue::of(true));
    return outcome;
  }
  if (of.kind == Unknown) return anything();
  if (operation == Operation::Negate) return surely(negated(of));
  if (of.kind != Number) return anything();
  const auto integer = static_cast<std::int64_t>(of.number);
  return surely(ScriptValue::of(static_cast<double>(~integer)));
}

ScriptOutcome apply_binary(ScriptOperation operation, const ScriptValue& left,
                           const ScriptValue& right) {
  if (left.kind == Unset || right.kind == Unset) return throws();
  const bool is_logic =
      operation == Operation::And || operation == Operation::Or;
  if (is_logic) return logic(operation, left, right);
  if (left.kind == Unknown || right.kind == Unknown) return anything();
  if (left.is_number() && right.is_number()) {
    return arithmetic(operation, left, right);
  }
  const bool are_texts = left.is_text() && right.is_text();
  const bool is_joining = operation == Operation::Join ||
                          (operation == Operation::Add && are_texts);
  if (!is_joining) return throws();
  if (left.kind != Text || right.kind != Text) {
    return surely(ScriptValue::any_text());
  }
  return surely(ScriptValue::of(left.text + right.text));
}

ScriptOutcome apply_comparison(ScriptComparison comparison,
                               const ScriptValue& left,
                               const ScriptValue& right) {
  if (left.kind == Unset || right.kind == Unset) return throws();
  if (left.kind == Unknown || right.kind == Unknown) return either_way(true);
  if (left.kind == Text && right.kind == Text) {
    return surely(ScriptValue::of(
        holds(comparison, left.text, right.text, left.text == right.text)));
  }
  if (left.is_text() && right.is_text()) return either_way(false);
  if (left.kind == AnyText || right.kind == AnyText) return either_way(true);
  ScriptValue one = left;
  ScriptValue other = right;
  for (ScriptValue* each : {&one, &other}) {
    if (each->kind != Text) continue;
    const auto number = number_beside(*each);
    if (!number) return either_way(true);
    *each = ScriptValue::of(*number);
  }
  return compare_numbers(comparison, one, other);
}

ScriptOutcome apply_change(ScriptOperation operation, const ScriptValue& entry,
                           const ScriptValue& by) {
  if (entry.kind == Unset || by.kind == Unset) return throws();
  const bool is_sum = operation == Operation::SetSum;
  if (entry.kind == Unknown || by.kind == Unknown) return anything();
  if (entry.is_text() && by.is_text() && is_sum) {
    const bool is_known = entry.kind == Text && by.kind == Text;
    return surely(is_known ? ScriptValue::of(entry.text + by.text)
                           : ScriptValue::any_text());
  }
  if (!entry.is_number() || !by.is_number()) return throws();
  ScriptOutcome outcome =
      arithmetic(is_sum                                  ? Operation::Add
                 : operation == Operation::SetDifference ? Operation::Subtract
                 : operation == Operation::SetProduct    ? Operation::Multiply
                                                         : Operation::Divide,
                 entry, by);
  // A fraction is no value of an integer entry.
  const bool is_by_whole = by.kind == Number && is_integer(by.number);
  const bool is_fraction = entry.kind == Number && !is_integer(entry.number);
  for (const ScriptValue& each : outcome.values) {
    const bool is_whole = each.kind == Number ? is_integer(each.number)
                                              : each.is_number() && is_by_whole;
    if (!is_whole && !is_fraction) outcome.may_throw = true;
  }
  return outcome;
}

ScriptTruth choice_of(const ScriptValue& value) {
  switch (value.kind) {
    case Unset:
      return {false, false, true};
    case Number:
      return {value.number != 0, value.number == 0, false};
    case AtLeast:
      return {true, value.number <= 0, false};
    case AtMost:
      return {true, value.number >= 0, false};
    case Text:
      if (const auto number = number_in(value.text)) {
        return {*number != 0, *number == 0, false};
      }
      return {true, true, true};
    case AnyText:
    case Unknown:
      break;
  }
  return {true, true, true};
}

ScriptTruth truth_of(const ScriptValue& value) {
  if (value.is_text()) return {false, false, true};
  ScriptTruth truth = choice_of(value);
  const bool is_truth =
      value.kind == Number && (value.number == 0 || value.number == 1);
  if (!is_truth) truth.may_throw = true;
  return truth;
}

std::optional<double> number_in(std::string_view text) {
  const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
  if (digits.empty() || digits.front() < '0' || digits.front() > '9') {
    return std::nullopt;
  }
  double value = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return plain(value);
}

}  // namespace btcheck::btcpp
