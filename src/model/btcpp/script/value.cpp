// SPDX-License-Identifier: MIT
//
// As BehaviorTree.CPP 4.10 converts them (utils/safe_any.hpp,
// utils/convert_impl.hpp).
#include "model/btcpp/script/value.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

using enum ScriptKind;

// -0 is kept as 0.
double plain(double number) { return number == 0 ? 0 : number; }

}  // namespace

bool may_be_enumerator(std::string_view text) {
  const bool is_name = std::ranges::all_of(text, [](const char c) {
    return is_letter(c) || is_digit(c) || c == '_';
  });
  return is_name && !text.empty() && is_capital(text[0]);
}

bool is_integer(double number) {
  return std::isfinite(number) && number == std::nearbyint(number);
}

ScriptValue ScriptValue::range(ScriptKind kind, double number,
                               NumberType type) {
  return {kind, plain(number), {}, type, EntryType::Free};
}

ScriptValue ScriptValue::integer(double number) {
  if (!(std::abs(number) < 0x1p63)) return any();
  return {Number, plain(number), {}, NumberType::Integer, EntryType::Free};
}

ScriptValue ScriptValue::real(double number) {
  if (std::isnan(number)) {
    return {NotANumber, 0, {}, NumberType::Real, EntryType::Free};
  }
  return {
      Number,           plain(number),   {},
      NumberType::Real, EntryType::Free, number == 0 && std::signbit(number)};
}

ScriptValue ScriptValue::any_number(NumberType type) {
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  return {AtLeast, -kNoEnd, {}, type, EntryType::Free};
}

bool ScriptValue::is_any_number() const {
  return (kind == AtLeast || kind == AtMost) && std::isinf(number);
}

ScriptValue ScriptValue::of(std::string text) {
  constexpr std::size_t kMostBytes = 200;
  if (text.size() > kMostBytes) return any_text();
  return {Text, 0, std::move(text), {}, EntryType::Free};
}

bool ScriptValue::is_whole() const {
  if (kind == Number) return is_integer(number);
  return is_number() &&
         (type == NumberType::Integer || type == NumberType::Whole);
}

ScriptValue ScriptValue::as(EntryType entry) const {
  ScriptValue value = *this;
  value.noted = entry;
  return value;
}

bool ScriptValue::is_too_long() const {
  return kind == Number && type == NumberType::Integer &&
         !(std::abs(number) < 0x1p53);
}

ScriptTruth choice_of(const ScriptValue& value) {
  switch (value.kind) {
    case Unset:
    case Empty:
      return {false, false, true};
    case Number:
      if (value.is_too_long()) return {false, false, true};
      return {value.number != 0, value.number == 0, false};
    case NotANumber:
      return {true, false, false};
    case AtLeast:
      return {true, value.number <= 0, false};
    case AtMost:
      return {true, value.number >= 0, false};
    case Text:
      if (const auto number = begun_number<double>(value.text)) {
        return {*number != 0, *number == 0, false};
      }
      return {false, false, true};
    case AnyText:
    case Any:
    case Unknown:
      break;
  }
  return {true, true, true};
}

ScriptTruth choice_in(const ScriptTree& script, const ScriptValue& value) {
  if (!script.texts_are_true || !value.is_text()) return choice_of(value);
  const bool may_be_empty = value.kind == AnyText || value.text.empty();
  return {value.kind == AnyText || !value.text.empty(), false, may_be_empty};
}

ScriptValue read_in(const ScriptTree& script, const ScriptValue& value) {
  return script.converts_unchecked && value.is_too_long() ? ScriptValue::any()
                                                          : value;
}

// Cast to bool (convertNumber), of integers only 0 and 1 are truth values, and
// of doubles all but those below 0, which are refused as unsigned.
ScriptTruth truth_of(const ScriptValue& value) {
  if (value.is_text()) return {false, false, true};
  if (!value.is_number() || value.kind == NotANumber) return choice_of(value);
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  const double low = value.kind == AtMost ? -kNoEnd : value.number;
  const double high = value.kind == AtLeast ? kNoEnd : value.number;
  const auto contains = [&](double number) {
    return low <= number && number <= high;
  };
  const bool is_integer = value.type == NumberType::Integer;
  const bool is_double =
      value.type == NumberType::Whole || value.type == NumberType::Real;
  const bool is_plain = low == high && (contains(0) || contains(1));
  return {is_integer ? contains(1) : high > 0, contains(0),
          low < 0 || !(is_double || is_plain)};
}

bool is_same_number(double left, double right) {
  return std::abs(left - right) <=
         static_cast<double>(std::numeric_limits<float>::epsilon());
}

std::string printed(const ScriptValue& value) {
  if (value.kind == Text) return value.text;
  return value.type == NumberType::Integer
             ? std::to_string(static_cast<std::int64_t>(value.number))
             : std::to_string(value.exact_number());
}

std::optional<double> number_in(std::string_view text) {
  const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
  if (digits.empty() || digits.front() < '0' || digits.front() > '9') {
    return std::nullopt;
  }
  const auto value = as_number<double>(text);
  return value ? std::optional(plain(*value)) : std::nullopt;
}

}  // namespace btcheck::btcpp
