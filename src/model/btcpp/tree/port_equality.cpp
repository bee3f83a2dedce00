// SPDX-License-Identifier: MIT
//
// After src/controls/switch_node.cpp of 4.10, and of 3.8.8 the header files
// controls/switch_node.h and decorators/blackboard_precondition.h, which read
// a port as convertFromString does (src/basic_types.cpp).
#include "model/btcpp/tree/port_equality.hpp"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include "model/btcpp/attributes.hpp"

namespace btcheck::btcpp {
namespace {

constexpr Equality kEqual{true, false};
constexpr Equality kDifferent{false, true};
constexpr Equality kPerhaps{true, true};

Equality surely(bool is_equal) { return is_equal ? kEqual : kDifferent; }

bool is_same_case(const std::string& one, const std::string& other) {
  if (one == other) return true;
  const auto whole = whole_number<int>(one);
  if (whole && whole == whole_number<int>(other)) return true;
  const auto left = whole_number<double>(one);
  const auto right = whole_number<double>(other);
  return left && right && is_same_number(*left, *right);
}

// As std::stoi and std::stod do: blanks before it, anything behind it.
std::optional<int> begun_int(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const long number = std::strtol(text.c_str(), &end, 10);
  const bool fits = errno == 0 && number >= std::numeric_limits<int>::min() &&
                    number <= std::numeric_limits<int>::max();
  if (end == text.c_str() || !fits) return std::nullopt;
  return static_cast<int>(number);
}

std::optional<double> begun_double(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || errno == ERANGE) return std::nullopt;
  return number;
}

bool is_equal(PortComparison how, const std::string& one,
              const std::string& other) {
  const auto are = [](const auto& left, const auto& right) {
    return left && right && *left == *right;
  };
  switch (how) {
    case PortComparison::Switch:
      return is_same_case(one, other);
    case PortComparison::Text:
      return one == other;
    case PortComparison::Int:
      return are(begun_int(one), begun_int(other));
    case PortComparison::Bool:
      return are(parse_bool(one), parse_bool(other));
    case PortComparison::Double:
      break;
  }
  const auto left = begun_double(one);
  const auto right = begun_double(other);
  return left && right && is_same_number(*left, *right);
}

bool may_contain(const ScriptValue& range, const ScriptValue& value) {
  const auto number = value.kind == ScriptKind::Text
                          ? number_in(value.text)
                          : std::optional<double>(value.number);
  if (!number || value.is_range()) return number.has_value();
  constexpr double kNear = 1e-6;
  return range.kind == ScriptKind::AtLeast ? *number >= range.number - kNear
                                           : *number <= range.number + kNear;
}

bool is_exact(const ScriptValue& value) {
  return value.kind == ScriptKind::Text || value.kind == ScriptKind::Number;
}

}  // namespace

Equality compared(PortComparison how, const ScriptValue& one,
                  const ScriptValue& other) {
  if (one.is_nothing() || other.is_nothing()) return kDifferent;
  for (const ScriptValue* each : {&one, &other}) {
    if (each->kind == ScriptKind::NotANumber) return kPerhaps;  // "-nan", too
  }
  if (is_exact(one) && is_exact(other)) {
    return surely(is_equal(how, printed(one), printed(other)));
  }
  if (one.is_range() && (is_exact(other) || other.is_range())) {
    return may_contain(one, other) ? kPerhaps : kDifferent;
  }
  if (other.is_range() && is_exact(one)) {
    return may_contain(other, one) ? kPerhaps : kDifferent;
  }
  return kPerhaps;
}

}  // namespace btcheck::btcpp
