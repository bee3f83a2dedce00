// SPDX-License-Identifier: MIT
//
// Node ids are in pre-order, so the order of the nodes is that of the file.
// Lines are filled greedily: a piece, which ends with its joint, goes on the
// line as long as it fits.
#include "model/export/layout.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// The length of what goes on one line in one piece, up to the next joint.
std::size_t piece_length(std::string_view text,
                         std::initializer_list<std::string_view> joints) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const std::string_view joint : joints) {
      if (text.substr(at).starts_with(joint)) return at + joint.size() - 1;
    }
  }
  return text.size();
}

std::string tree_lines(const BehaviorTree& tree, std::string_view margin) {
  std::string text;
  std::vector<std::size_t> depth(tree.nodes.size(), 0);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    if (!node.is_root()) depth[n] = depth[index(node.parent)] + 1;
    text += fmt::format("{}line {:<4}{:{}}{} {}\n", margin, node.span.line, "",
                        1 + 2 * depth[n], type_name(node.type),
                        comment_text(unique_name(tree, NodeId{n})));
  }
  return text;
}

}  // namespace

std::string scale_lines(const BehaviorTree& tree, std::string_view margin) {
  std::string text;
  for (const StateVariable& variable : tree.variables) {
    if (variable.scale.is_one()) continue;
    text += fmt::format("{}{} is counted in steps of {}: {} is {}\n", margin,
                        comment_text(variable.name), variable.scale.text(1),
                        variable.max, variable.scale.text(variable.max));
  }
  return text;
}

std::string comment_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    const bool ends_comment = c == '/' && !safe.empty() && safe.back() == '*';
    const bool is_control = static_cast<unsigned char>(c) < ' ';
    if (ends_comment) safe += ' ';
    safe += is_control || c == '\\' ? ' ' : c;
  }
  return safe;
}

std::string model_heading(const BehaviorTree& tree, TickSemantics ticks,
                          std::string_view begin, std::string_view margin) {
  const std::string_view blank = margin.substr(0, margin.size() - 1);
  const std::string scales = scale_lines(tree, margin);
  return fmt::format("{}{}, tick {}; made by btcheck\n{}\n{}{}{}{}", begin,
                     comment_text(tree.file), tick_name(ticks), blank,
                     tree_lines(tree, margin), scales.empty() ? "" : blank,
                     scales.empty() ? "" : "\n", scales);
}

std::string remark_lines(const std::vector<std::string>& remarks,
                         std::string_view begin, std::string_view end) {
  std::string text;
  for (const std::string& remark : remarks) {
    text += fmt::format("{}{}{}\n", begin, comment_text(remark), end);
  }
  return text;
}

std::string edge_remark(const Automaton& automaton, const Edge& edge) {
  return fmt::format("{}: {} -> {}{}{}", comment_text(automaton.name),
                     comment_text(automaton.source(edge).name),
                     comment_text(automaton.target(edge).name),
                     edge.label.empty() ? "" : ", ", comment_text(edge.label));
}

std::string with_propositions(
    std::string_view formula,
    const std::function<std::string(std::size_t)>& text) {
  constexpr std::string_view kDigits = "0123456789";
  constexpr std::string_view kOfNames =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789";
  std::string result;
  while (!formula.empty()) {
    const std::size_t end = formula.find_first_not_of(kOfNames);
    const std::string word(formula.substr(0, std::max<std::size_t>(end, 1)));
    const bool is_place = word.size() > 1 && word[0] == 'p' &&
                          word.find_first_not_of(kDigits, 1) == word.npos;
    result += is_place ? text(std::stoul(word.substr(1))) : word;
    formula.remove_prefix(word.size());
  }
  return result;
}

std::string filled(std::string_view text, std::size_t indent,
                   std::string_view line_end,
                   std::initializer_list<std::string_view> joints) {
  constexpr std::size_t kWidth = 78;
  std::string result;
  std::size_t column = indent;
  while (!text.empty()) {
    const std::size_t length = piece_length(text, joints);
    if (!result.empty() && column + 1 + length > kWidth) {
      result += fmt::format("{}\n{:{}}", line_end, "", indent);
      column = indent;
    } else if (!result.empty()) {
      result += ' ';
      ++column;
    }
    result += text.substr(0, length);
    column += length;
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return result;
}

void append(std::string& text, std::string_view joint, std::string_view more) {
  if (!text.empty() && !more.empty()) text += joint;
  text += more;
}

}  // namespace btcheck
