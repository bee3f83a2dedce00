// SPDX-License-Identifier: MIT
//
// Both networks are told line by line, in names that stay when lines move, and
// the lines are compared. What is declared, and what moves by itself, is told
// in the order of its names.
#include "style/kept.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "model/automata/network.hpp"
#include "model/btcpp/tree/entry_programs.hpp"
#include "model/tree/tree.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

class NetworkTeller {
 public:
  explicit NetworkTeller(const LoweredInput& input)
      : tree_(input.tree), network_(input.network) {
    for (std::size_t at = 0; at < tree_.nodes.size(); ++at) {
      const Node& node = tree_.nodes[at];
      const std::string stable = stable_name(node);
      if (stable != node.name) stable_names_.try_emplace(node.name, stable);
      node_names_.push_back(fmt::format("{}:{}", at, stable));
    }
  }

  std::vector<std::string> told() {
    tell_network();
    for (const Node& node : tree_.nodes) tell(node);
    std::vector<std::string> declared;
    for (const Variable& variable : network_.variables) {
      std::string text = variable_text(variable);
      (variable.role == VariableRole::State ? declared : lines_)
          .push_back(std::move(text));
    }
    for (const Automaton& automaton : network_.automata) {
      const std::size_t first = lines_.size();
      tell(automaton);
      if (automaton.kind != AutomatonKind::StateVariable) continue;
      std::string text;
      for (std::size_t i = first; i < lines_.size(); ++i) {
        text += lines_[i] + "; ";
      }
      lines_.resize(first);
      declared.push_back(std::move(text));
    }
    std::ranges::sort(declared);
    lines_.insert(lines_.end(), declared.begin(), declared.end());
    return std::move(lines_);
  }

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> format, Parts&&... parts) {
    lines_.push_back(fmt::format(format, std::forward<Parts>(parts)...));
  }

  std::string name_of(const Automaton& automaton) const {
    if (automaton.kind == AutomatonKind::StateVariable) {
      return tree_.variable(automaton.state_variable).name;
    }
    return fmt::format("{} {}", static_cast<int>(automaton.kind),
                       node_names_[index(automaton.node)]);
  }
  std::string name_of(const Variable& variable) const {
    if (variable.role == VariableRole::State || !variable.owner) {
      return variable.name;
    }
    return fmt::format("{}.{}", name_of(network_.automaton(*variable.owner)),
                       variable.name);
  }
  std::string name_of(VariableId id) const {
    return name_of(network_.variable(id));
  }
  std::string name_of(const std::optional<VariableId>& id) const {
    return id ? name_of(*id) : "-";
  }

  std::string text_of(const Expression& expression) const {
    std::string text;
    for (const Term& term : expression.terms()) {
      text += term.operation == Operation::Variable
                  ? fmt::format(" [{}]",
                                name_of(VariableId{
                                    static_cast<std::uint32_t>(term.operand)}))
                  : fmt::format(" {}:{}", static_cast<int>(term.operation),
                                term.operand);
    }
    return text;
  }
  // With names of nodes that stay: `Sequence17_btn2_done`.
  std::string text_of(std::string_view text) const {
    std::string told;
    while (!text.empty()) {
      std::size_t end = 0;
      while (end < text.size() && is_in_word(text[end])) ++end;
      const std::size_t base = std::min(text.substr(0, end).find("_btn"), end);
      const auto found = stable_names_.find(text.substr(0, base));
      told += found == stable_names_.end() ? text.substr(0, base)
                                           : std::string_view(found->second);
      end = std::min(end + 1, text.size());
      told += text.substr(base, end - base);
      text.remove_prefix(end);
    }
    return told;
  }
  static bool is_in_word(char c) {
    return is_letter(c) || is_digit(c) || c == '_';
  }
  std::string_view program_text(std::int32_t program) const {
    const auto& programs = tree_.programs;
    if (program == kNoProgram || programs == nullptr) return "-";
    return programs->programs[static_cast<std::size_t>(program)].text;
  }

  void tell_network() {
    add("{} {} {} {}", profile_name(network_.profile),
        tick_name(network_.ticks), name_of(network_.fault),
        network_.automata.size());
    for (const PastMemory& past : network_.past) {
      add("{} {}", text_of(past.key), name_of(past.variable));
    }
  }

  void tell(const Node& node) {
    std::vector<std::string> arguments;
    for (const Argument& each : node.arguments) {
      arguments.push_back(each.key + "=" + each.value);
    }
    std::ranges::sort(arguments);
    add("{} {} {} {} <{}>", type_name(node.type), stable_name(node), node.id,
        node.path, fmt::join(arguments, " "));
  }

  std::string variable_text(const Variable& variable) const {
    return fmt::format(
        "{} {} {} {} {} {} {} {} <{}>", static_cast<int>(variable.role),
        static_cast<int>(variable.local), name_of(variable), variable.min,
        variable.max, variable.initial, variable.scale.step,
        variable.scale.decimals,
        text_of(fmt::format("{}", fmt::join(variable.value_names, " "))));
  }

  void tell(const Automaton& automaton) {
    add("{} {} {}", name_of(automaton), name_of(automaton.location),
        name_of(automaton.gate));
    for (const Location& location : automaton.locations) {
      const bool is_of_child = location.role == LocationRole::Call ||
                               location.role == LocationRole::Called;
      add("{} {} {}", text_of(location.name), static_cast<int>(location.role),
          is_of_child ? node_names_[index(location.child)] : "");
    }
    for (const Edge& edge : automaton.edges) tell(edge);
  }

  void tell(const Edge& edge) {
    std::string text;
    for (const Assignment& each : edge.updates) {
      text +=
          fmt::format(" {} :={};", name_of(each.variable), text_of(each.value));
    }
    for (const ScriptStep& each : edge.scripts) {
      text += fmt::format(" {} {};", program_text(each.program),
                          static_cast<int>(each.outcome));
    }
    add("{} -> {} if{} then{} in {} {} `{}` {}{}{}", index(edge.source),
        index(edge.target), text_of(edge.guard), text, edge.when.lower,
        edge.when.upper, text_of(edge.label), edge.asks_world, edge.tells_why,
        edge.is_like_time);
  }

  const BehaviorTree& tree_;
  const Network& network_;
  std::vector<std::string> node_names_;
  std::map<std::string, std::string, std::less<>> stable_names_;
  std::vector<std::string> lines_;
};

}  // namespace

std::string difference(const LoweredInput& before, const LoweredInput& after) {
  const auto one = NetworkTeller(before).told();
  const auto other = NetworkTeller(after).told();
  const auto [here, there] = std::ranges::mismatch(one, other);
  if (here == one.end() && there == other.end()) return {};
  return fmt::format("`{}` instead of `{}`", there == other.end() ? "" : *there,
                     here == one.end() ? "" : *here);
}

}  // namespace btcheck
