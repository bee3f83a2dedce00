// SPDX-License-Identifier: MIT
#include "check/bind/name_help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "ltl/rules/name_help.hpp"
#include "ltl/rules/parser.hpp"
#include "model/tree/answers.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

bool is_word(std::string_view text) {
  const auto is_part = [](char c) {
    return is_letter(c) || is_digit(c) || c == '_';
  };
  return std::ranges::all_of(text, is_part) &&
         !std::ranges::all_of(text, is_digit) && !is_reserved(text);
}

std::string in_quotes(std::string_view word) {
  return is_word(word) ? std::string(word) : fmt::format("\"{}\"", word);
}

// The names of a path, each in quotes where rules need them: `fail/"Go home"`;
// that of an XML tree as a whole, "Dock::2/Plug::6".
std::string as_path(std::string_view path) {
  if (path.find("::") != path.npos) return fmt::format("\"{}\"", path);
  std::string text;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    text +=
        (begin == 0 ? "" : "/") + in_quotes(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return text;
}

// The first few, "a, b, …".
template <class Text>
std::string first_of(const std::vector<NodeId>& nodes, Text text) {
  constexpr std::size_t kMostListed = 6;
  std::string list;
  for (std::size_t i = 0; i < nodes.size() && i < kMostListed; ++i) {
    list += (i == 0 ? "" : ", ") + text(nodes[i]);
  }
  return list + (nodes.size() > kMostListed ? ", …" : "");
}

const StateVariable* variable_called(const BehaviorTree& tree,
                                     std::string_view name) {
  const auto found =
      std::ranges::find_if(tree.variables, [&](const StateVariable& variable) {
        return equal_ignoring_case(name, variable.name);
      });
  return found == tree.variables.end() ? nullptr : &*found;
}

// A variable with a value that it has: the last that needs no quotes.
std::string comparison_with(const StateVariable& variable) {
  std::string value = variable.value_name(variable.initial);
  for (const std::string& state : variable.states) {
    const bool is_plain =
        is_word(state) || std::ranges::all_of(state, is_digit);
    if (is_plain) value = state;
  }
  const bool is_plain = !variable.is_enumeration() || is_word(value) ||
                        std::ranges::all_of(value, is_digit);
  return fmt::format("{} == {}", in_quotes(variable.name),
                     is_plain ? value : in_quotes(value));
}

// `.ticked`, and what else a node of this kind can answer at all.
std::string events_help(const BehaviorTree& tree,
                        const std::vector<NodeId>& nodes) {
  const Answers answers = possible_answers(tree)[index(nodes[0])];
  const std::string name = name_in_rules(tree, nodes[0]);
  std::vector<std::string> events;
  const auto add = [&](bool is_possible, std::string_view event) {
    if (is_possible) events.push_back(fmt::format("`{}.{}`", name, event));
  };
  add(true, "ticked");
  add(answers.success, "success");
  add(answers.failure, "failure");
  add(answers.runs, "running");
  const std::string which =
      nodes.size() == 1 ? ""
                        : fmt::format("there are {}: {}; ", nodes.size(),
                                      names_in_rules(tree, nodes));
  return fmt::format("{}write {}", which, fmt::join(events, ", "));
}

std::string told_node(const BehaviorTree& tree, const NodeNames& names,
                      std::string_view near) {
  const std::vector<NodeId> nodes = names.called(near);
  if (nodes.size() == 1) {
    return fmt::format("did you mean `{}` ({})?", name_in_rules(tree, nodes[0]),
                       line_of(tree, nodes[0]));
  }
  // "`fail/land` (line 31)"; of an XML node the full path.
  const auto place = [&](NodeId node) {
    const std::string& path = tree.node(node).path;
    return fmt::format("`{}` ({})",
                       as_path(path.empty() ? path_name(tree, node) : path),
                       line_of(tree, node));
  };
  return fmt::format("did you mean `{}`? there are {}: {}", near, nodes.size(),
                     first_of(nodes, place));
}

enum class Wanted : std::uint8_t { Node, Variable, Either };

std::string nearest(const BehaviorTree& tree, const NodeNames& names,
                    std::string_view name, Wanted wanted) {
  std::vector<std::string> known;
  if (wanted != Wanted::Variable) {
    for (const Node& node : tree.nodes) known.push_back(node.name);
  }
  if (wanted != Wanted::Node) {
    for (const StateVariable& each : tree.variables) {
      known.push_back(each.name);
    }
  }
  const auto near = closest_match(name, known);
  if (!near) return {};
  const bool is_node =
      wanted != Wanted::Variable && !names.called(*near).empty();
  return is_node ? told_node(tree, names, *near)
                 : fmt::format("did you mean `{}`?", in_quotes(*near));
}

}  // namespace

std::string name_in_rules(const BehaviorTree& tree, NodeId node) {
  const std::string name = short_name(tree, node);
  const std::string line = fmt::format("@{}", tree.node(node).span.line);
  return name.ends_with(line)
             ? as_path(name.substr(0, name.size() - line.size())) + line
             : as_path(name);
}

std::string names_in_rules(const BehaviorTree& tree,
                           const std::vector<NodeId>& nodes) {
  return first_of(nodes, [&](NodeId node) {
    return fmt::format("`{}`", name_in_rules(tree, node));
  });
}

std::string nearest_help_in(const BehaviorTree& tree, const NodeNames& names,
                            std::string_view name) {
  return nearest(tree, names, name, Wanted::Either);
}

std::string node_help(const BehaviorTree& tree, const NodeNames& names,
                      std::string_view reference) {
  if (const StateVariable* known = variable_called(tree, reference)) {
    return fmt::format("`{}` is a variable: compare it, `{}`", reference,
                       comparison_with(*known));
  }
  return nearest(tree, names, reference.substr(0, reference.rfind('@')),
                 Wanted::Node);
}

std::string variable_help(const BehaviorTree& tree, const NodeNames& names,
                          std::string_view name) {
  const std::vector<NodeId> nodes = names.called(name);
  if (nodes.empty()) return nearest(tree, names, name, Wanted::Variable);
  return fmt::format("`{}` is a node: {}", name, events_help(tree, nodes));
}

std::string condition_help(const BehaviorTree& tree, const NodeNames& names,
                           std::string_view name) {
  if (equal_ignoring_case(name, "root")) {
    return "write `root.success`, `root.failure`, `root.ended`";
  }
  const std::vector<NodeId> nodes = names.called(name);
  if (!nodes.empty()) return events_help(tree, nodes);
  if (const StateVariable* known = variable_called(tree, name)) {
    return fmt::format("compare it: `{}`", comparison_with(*known));
  }
  const std::string near = nearest_help_in(tree, names, name);
  return near.empty()
             ? fmt::format("no node and no variable is called `{}`", name)
             : near;
}

Result<PropertyFile> read_rules(std::string_view file_name,
                                const FileText& text,
                                const BehaviorTree& tree) {
  auto read = read_properties(file_name, text);
  if (read.value) return read;
  const NodeNames names(tree);
  return read_properties(file_name, text, [&](std::string_view name) {
    return condition_help(tree, names, name);
  });
}

}  // namespace btcheck
