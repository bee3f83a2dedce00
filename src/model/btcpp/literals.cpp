// SPDX-License-Identifier: MIT
#include "model/btcpp/literals.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

namespace btcheck::btcpp {
namespace {

template <class Number>
std::optional<Number> number_at_beginning(std::string_view text) {
  Number value = 0;
  const auto end =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc()) return std::nullopt;
  return value;
}

template <class Number>
bool is_in_range(std::string_view text) {
  const auto value = parse_integer(text);
  return value && *value >= std::numeric_limits<Number>::lowest() &&
         *value <= std::numeric_limits<Number>::max();
}

bool is_status(std::string_view text) {
  constexpr std::array<std::string_view, 5> kStatuses = {
      "IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED"};
  return std::find(kStatuses.begin(), kStatuses.end(), text) != kStatuses.end();
}

}  // namespace

std::optional<bool> parse_bool(std::string_view text) {
  if (text == "1" || text == "true" || text == "TRUE" || text == "True") {
    return true;
  }
  if (text == "0" || text == "false" || text == "FALSE" || text == "False") {
    return false;
  }
  return std::nullopt;
}

std::optional<long long> parse_integer(std::string_view text) {
  return number_at_beginning<long long>(text);
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return value;
}

bool is_literal_of(PortType type, std::string_view text) {
  switch (type) {
    case PortType::Int:
      return is_in_range<int>(text);
    case PortType::Unsigned:
      return is_in_range<unsigned>(text);
    case PortType::Bool:
      return parse_bool(text).has_value();
    case PortType::Double:
      return number_at_beginning<double>(text).has_value();
    case PortType::Status:
      return is_status(text);
    case PortType::Any:
    case PortType::String:
    case PortType::Script:
      return true;
  }
  return true;
}

}  // namespace btcheck::btcpp
