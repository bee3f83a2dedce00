// SPDX-License-Identifier: MIT
#include "model/btcpp/node_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "model/btcpp/script.hpp"

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

// A port in the words of a script; nothing for a literal that no script can
// write.
std::optional<std::string> operand(std::string_view port) {
  if (port.starts_with('{') && port.ends_with('}')) {
    port = port.substr(1, port.size() - 2);
    const std::size_t begin = port.find_first_not_of(' ');
    if (begin == port.npos) return std::nullopt;
    return std::string(
        port.substr(begin, port.find_last_not_of(' ') - begin + 1));
  }
  if (port.find('\'') != port.npos) return std::nullopt;
  return fmt::format("'{}'", port);
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
  const auto left = operand(one);
  const auto right = operand(other);
  if (!left || !right) return {};
  Script script = condition(subtree, fmt::format("{} == {}", *left, *right));
  script.may_fail =
      Expression::binary(Operation::Or, std::move(script.may_fail),
                         Expression::unary(Operation::Not, script.may_hold));
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
