// SPDX-License-Identifier: MIT
#include "model/btcpp/node_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "model/btcpp/entries.hpp"
#include "model/btcpp/script.hpp"
#include "model/btcpp/script_value.hpp"

namespace btcheck::btcpp {
namespace {

Script of(std::string text, ScriptMeaning meaning) {
  return {std::move(text), std::move(meaning.assignments),
          std::move(meaning.may_hold), std::move(meaning.may_fail)};
}

// With one blank for every gap.
std::string in_one_line(std::string_view code) {
  std::string line;
  for (const char c : code) {
    const bool is_gap = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!is_gap) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  if (line.ends_with(' ')) line.pop_back();
  return line;
}

// The name in `{name}`; nothing for a literal.
std::optional<std::string> pointed_at(std::string_view port) {
  if (!port.starts_with('{') || !port.ends_with('}')) return std::nullopt;
  port = port.substr(1, port.size() - 2);
  const std::size_t begin = port.find_first_not_of(' ');
  if (begin == port.npos) return std::string();
  return std::string(
      port.substr(begin, port.find_last_not_of(' ') - begin + 1));
}

// Whether two values are, or may be, equal and different.
struct Equality {
  bool may_hold = false;
  bool may_fail = false;
};
constexpr Equality kEqual{true, false};
constexpr Equality kDifferent{false, true};
constexpr Equality kPerhaps{true, true};

// Numbers become texts of six decimals on the way.
Equality compared(double one, double other) {
  if (one == other) return kEqual;
  const double near = 1e-5 * std::max(1.0, std::abs(one));
  return std::abs(one - other) < near ? kPerhaps : kDifferent;
}

Equality compared(const std::string& one, const std::string& other) {
  if (one == other) return kEqual;
  const auto left = number_in(one);
  const auto right = number_in(other);
  return left && right ? compared(*left, *right) : kDifferent;
}

// As SwitchNode of 4.10 compares (details::CheckStringEquality): the same
// texts, or the same numbers; `true` is none. Enumerations that the program
// registers are not known.
Equality compared(const ScriptValue& value, const std::string& literal) {
  const auto number = number_in(literal);
  switch (value.kind) {
    case ScriptKind::Unknown:
    case ScriptKind::AnyText:
      return kPerhaps;
    case ScriptKind::Unset:
      return kDifferent;
    case ScriptKind::Text:
      return compared(value.text, literal);
    case ScriptKind::Number:
      return number ? compared(value.number, *number) : kDifferent;
    case ScriptKind::AtLeast:
      return number && *number >= value.number ? kPerhaps : kDifferent;
    case ScriptKind::AtMost:
      return number && *number <= value.number ? kPerhaps : kDifferent;
  }
  return kPerhaps;
}

// An entry and itself.
Equality compared_with_itself(const ScriptValue& value) {
  if (value.kind == ScriptKind::Unset) return kDifferent;
  return value.kind == ScriptKind::Unknown ? kPerhaps : kEqual;
}

}  // namespace

NodeScripts::NodeScripts(const BtcppExpansion& expansion,
                         const ContractScripts& contracts)
    : expansion_(expansion), world_(script_world(expansion, contracts)) {}

std::vector<StateVariable> NodeScripts::variables() const {
  std::vector<StateVariable> variables = world_.variables;
  for (StateVariable& variable : variables) variable.moves = Moves::Sampled;
  return variables;
}

Script NodeScripts::condition(std::uint32_t subtree,
                              std::string_view code) const {
  if (!parse_script(code).flaw.empty()) return {};
  return of(in_one_line(code),
            compile_script(expansion_, world_, subtree, code));
}

Script NodeScripts::action(std::uint32_t subtree, std::string_view code) const {
  const Expression never = Expression::constant(0);
  if (!parse_script(code).flaw.empty()) return {{}, {}, {}, never};
  ScriptMeaning meaning = compile_script(expansion_, world_, subtree, code);
  return {in_one_line(code), std::move(meaning.assignments),
          std::move(meaning.may_end), never};
}

Script NodeScripts::equality(std::uint32_t subtree, std::string_view one,
                             std::string_view other) const {
  auto name = pointed_at(one);
  std::string literal(other);
  if (!name) {
    name = pointed_at(other);
    literal = one;
  }
  Script script;
  script.text = fmt::format("{} == {}", one, other);
  if (!name) {
    const Equality whole = compared(std::string(one), std::string(other));
    script.may_hold = Expression::constant(whole.may_hold);
    script.may_fail = Expression::constant(whole.may_fail);
    return script;
  }
  const auto entry = world_.of.find(entry_of(expansion_, subtree, *name));
  if (entry == world_.of.end()) return script;
  const auto second = pointed_at(literal);
  const bool is_itself =
      second && entry_of(expansion_, subtree, *second) == entry->first;
  if (second && !is_itself) return script;
  const auto& values = world_.domains[index(entry->second)].values;
  std::vector<int> holds;
  std::vector<int> fails;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Equality here = is_itself ? compared_with_itself(values[i])
                                    : compared(values[i], literal);
    if (here.may_hold) holds.push_back(static_cast<int>(i));
    if (here.may_fail) fails.push_back(static_cast<int>(i));
  }
  const Expression now =
      Expression::variable(static_cast<std::int32_t>(index(entry->second)));
  script.may_hold = is_one_of(now, holds);
  script.may_fail = is_one_of(now, fails);
  return script;
}

Script NodeScripts::set_blackboard(const BtcppInstance& node) const {
  return of("", compile_set_blackboard(expansion_, world_, node));
}

Script NodeScripts::unset_blackboard(const BtcppInstance& node) const {
  Script script = of("", compile_unset_blackboard(expansion_, world_, node));
  script.may_fail = Expression::constant(0);
  return script;
}

std::optional<std::string> NodeScripts::why_abstracted(
    std::uint32_t subtree, std::string_view name) const {
  const EntryName entry = entry_of(expansion_, subtree, name);
  const auto found =
      std::find_if(world_.abstracted.begin(), world_.abstracted.end(),
                   [&](const auto& each) { return each.entry == entry; });
  if (found == world_.abstracted.end()) return std::nullopt;
  return found->reason;
}

}  // namespace btcheck::btcpp
