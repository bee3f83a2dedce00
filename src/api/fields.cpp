// SPDX-License-Identifier: MIT
#include "api/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "text/numbers.hpp"

namespace btcheck::v1 {
namespace {

// What does not fit changes nothing.
bool set_flag(const std::string& value, bool& to) {
  if (value != "true" && value != "false") return false;
  to = value == "true";
  return true;
}

template <class Number>
bool set_number(const std::string& value, Number& to) {
  const auto number = as_number<Number>(value);
  if (number) to = *number;
  return number.has_value();
}

bool set_seconds(const std::string& value, double& to) {
  double seconds = 0;
  // Neither negative nor NaN.
  if (!set_number(value, seconds) || !(seconds >= 0)) return false;
  to = seconds;
  return true;
}

bool set_seed(const std::string& value, std::optional<std::uint64_t>& to) {
  const auto number = as_number<std::uint64_t>(value);
  if (number) to = number;
  return number.has_value();
}

template <class Number>
bool set_from(const std::string& value, Number least, Number& to) {
  Number number = 0;
  if (!set_number(value, number) || number < least) return false;
  to = number;
  return true;
}

bool add(const std::string& value, std::vector<std::string>& to) {
  to.push_back(value);
  return true;
}

bool take(const std::string& value, std::string& to) {
  to = value;
  return true;
}

using Setter = bool (*)(Fields& to, const std::string& value);
struct SetterRow {
  std::string_view name;
  Setter set;
  bool is_list = false;
};

constexpr SetterRow kSetters[] = {
    {"tree",
     [](auto& to, auto& value) { return take(value, to.request.tree); }},
    {"profile",
     [](auto& to, auto& value) { return take(value, to.request.profile); }},
    {"main_tree",
     [](auto& to, auto& value) { return take(value, to.request.main_tree); }},
    {"ticks",
     [](auto& to, auto& value) { return take(value, to.request.ticks); }},
    {"settings",
     [](auto& to, auto& value) { return take(value, to.settings); }},
    {"tick_milliseconds",
     [](auto& to, auto& value) {
       return set_from(value, 0, to.request.tick_milliseconds);
     }},
    {"loops",
     [](auto& to, auto& value) { return set_flag(value, to.request.loops); }},
    {"wake_ups",
     [](auto& to, auto& value) {
       return set_flag(value, to.request.wake_ups);
     }},
    {"tries_repairs",
     [](auto& to, auto& value) {
       return set_flag(value, to.request.tries_repairs);
     }},
    {"one_program",
     [](auto& to, auto& value) {
       return set_flag(value, to.request.is_one_program);
     }},
    {"directory",
     [](auto& to, auto& value) { return take(value, to.request.directory); }},
    {"threads",
     [](auto& to, auto& value) {
       return set_from(value, 1U, to.request.threads);
     }},
    {"seconds",
     [](auto& to, auto& value) {
       return set_seconds(value, to.request.seconds);
     }},
    {"states",
     [](auto& to, auto& value) {
       return set_number(value, to.request.states);
     }},
    {"bytes",
     [](auto& to, auto& value) { return set_number(value, to.request.bytes); }},
    {"seed",
     [](auto& to, auto& value) { return set_seed(value, to.plan.seed); }},
    {"script",
     [](auto& to, auto& value) { return take(value, to.plan.script); }},
    {"run_ticks",
     [](auto& to, auto& value) { return set_from(value, 1, to.plan.ticks); }},
    {"rules",
     [](auto& to, auto& value) { return add(value, to.request.rules); }, true},
    {"typed_rules",
     [](auto& to, auto& value) { return add(value, to.request.typed_rules); },
     true},
    {"leaves",
     [](auto& to, auto& value) { return add(value, to.request.leaves); }, true},
    {"models",
     [](auto& to, auto& value) { return add(value, to.request.models); },
     true}};

const SetterRow* row_named(std::string_view name) {
  const auto* row = std::ranges::find(kSetters, name, &SetterRow::name);
  return row == std::end(kSetters) ? nullptr : row;
}

}  // namespace

void set_field(std::string_view name, const std::string& value, Fields& to) {
  const SetterRow* row = row_named(name);
  if (row == nullptr) {
    throw std::invalid_argument(fmt::format("there is no `{}` to set", name));
  }
  if (!row->set(to, value)) {
    constexpr std::size_t kShown = 200;
    throw std::invalid_argument(
        fmt::format("`{}` does not fit `{}`", value.substr(0, kShown), name));
  }
}

bool is_list_field(std::string_view name) {
  const SetterRow* row = row_named(name);
  return row != nullptr && row->is_list;
}

std::vector<std::string> field_names() {
  std::vector<std::string> names;
  for (const SetterRow& row : kSetters) names.emplace_back(row.name);
  return names;
}

}  // namespace btcheck::v1
