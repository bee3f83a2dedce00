// SPDX-License-Identifier: MIT
#include "model/btcpp/attributes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "model/tree/releases.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 32 || c == 127;
}

bool is_forbidden(char c) {
  constexpr std::string_view kForbidden = " <>&\"'/\\:*?|.";
  return is_control(c) || kForbidden.find(c) != kForbidden.npos;
}

std::string spelled(char c) {
  if (c == ' ') return "a blank";
  if (is_control(c)) return "a control character";
  return fmt::format("`{}`", c);
}

std::optional<std::string> forbidden_in(std::string_view name) {
  const auto found = std::ranges::find_if(name, is_forbidden);
  if (found == name.end()) return std::nullopt;
  return spelled(*found) + " cannot stand in it";
}

bool is_status(std::string_view text) {
  constexpr std::array<std::string_view, 5> kStatuses = {
      "IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED"};
  return std::ranges::find(kStatuses, text) != kStatuses.end();
}

}  // namespace

bool is_condition_name(std::string_view name) {
  return std::ranges::find(kBtcppConditionNames, name) !=
         kBtcppConditionNames.end();
}

bool is_reserved_attribute(std::string_view name) {
  return name == "ID" || name == "name" || name == "_autoremap" ||
         is_condition_name(name);
}

bool is_port_name(std::string_view name) {
  return !name.empty() && is_letter(name.front()) &&
         std::ranges::none_of(name, is_forbidden) &&
         !is_reserved_attribute(name);
}

std::string meant_condition(BtcppRelease release, std::string_view name) {
  if (release == BtcppRelease::V3 || is_reserved_attribute(name)) return {};
  std::vector<std::string> names(kBtcppConditionNames.begin(),
                                 kBtcppConditionNames.end());
  names.emplace_back("_autoremap");
  return did_you_mean(name, names);
}

std::optional<std::string> flaw_of_type_name(std::string_view name) {
  if (name.empty()) return "it is empty";
  if (name == "Root" || name == "root") return "this name is reserved";
  return forbidden_in(name);
}

std::optional<std::string> flaw_of_port_name(std::string_view name) {
  if (name.empty()) return "it is empty";
  if (is_digit(name.front())) {
    return "a digit cannot stand at its beginning";
  }
  if (is_reserved_attribute(name)) return "this name is reserved";
  return forbidden_in(name);
}

std::optional<std::string> flaw_of_instance_name(std::string_view name) {
  constexpr std::string_view kBlanks = "\t\n\r";
  const bool has_control = std::ranges::any_of(name, [&](char c) {
    return is_control(c) && kBlanks.find(c) == kBlanks.npos;
  });
  if (!has_control) return std::nullopt;
  return "a control character cannot stand in it";
}

std::optional<std::string_view> blackboard_key(int engine,
                                               std::string_view value) {
  const std::size_t begin = value.find_first_not_of(' ');
  if (begin == value.npos) return std::nullopt;
  value = value.substr(begin, value.find_last_not_of(' ') - begin + 1);
  if (releases::kHasDollarKeys.has(engine) && value.starts_with("${")) {
    value.remove_prefix(1);
  }
  if (value.size() < 3 || value.front() != '{' || value.back() != '}') {
    return std::nullopt;
  }
  return value.substr(1, value.size() - 2);
}

std::optional<std::string_view> remapped_key(int engine, std::string_view port,
                                             std::string_view value) {
  if (value == "=") return port;
  if (value == "{=}" && !releases::kEqualSignIsKey.has(engine)) return port;
  return blackboard_key(engine, value);
}

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
  return begun_number<long long>(text);
}

std::string_view text_after_number(std::string_view text, PortType type) {
  const auto behind = [&](auto number) {
    return std::from_chars(text.data(), text.data() + text.size(), number).ptr;
  };
  const char* end = type == PortType::Double ? behind(0.0) : behind(0LL);
  std::string_view rest =
      text.substr(static_cast<std::size_t>(end - text.data()));
  while (rest.ends_with(' ')) rest.remove_suffix(1);
  return rest;
}

bool is_literal_of(PortType type, std::string_view text) {
  switch (type) {
    case PortType::Int:
      return begun_number<int>(text).has_value();
    case PortType::Unsigned: {
      const auto value = parse_integer(text);  // "-0" is one
      return value && *value >= 0 &&
             *value <= std::numeric_limits<unsigned>::max();
    }
    case PortType::Bool:
      return parse_bool(text).has_value();
    case PortType::Double:
      return begun_number<double>(text).has_value();
    case PortType::Status:
      return is_status(text);
    default:
      return true;
  }
}

}  // namespace btcheck::btcpp
