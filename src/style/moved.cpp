// SPDX-License-Identifier: MIT
#include "style/moved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "ltl/rules/parser.hpp"
#include "model/btcpp/xml_text.hpp"
#include "model/btf/forms.hpp"
#include "model/tree_file.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// With the line they are on as the one before.
std::vector<MovedNode> nodes_in(const InputFile& tree) {
  std::vector<MovedNode> nodes;
  if (is_xml(tree.name, tree.text)) {
    const auto parsed = tree.text.parsed<btcpp::ParsedXml>();
    if (!parsed->value) return nodes;
    for (const auto& each : *parsed->value) {
      nodes.push_back({each.name, each.span.line});
    }
  } else {
    const btf::Forms& forms = tree.text.parsed<btf::ParsedForms>()->forms;
    for (const btf::Form& each : forms.all) {
      if (!each.is_list() || each.items.empty()) continue;
      const btf::Form& head = forms[each.items.front()];
      nodes.push_back({std::string(head.text), head.span.line});
    }
  }
  return nodes;
}

std::optional<int> line_in(std::string_view digits) {
  const auto number = as_number<int>(digits);
  return number && *number > 0 ? std::optional(*number) : std::nullopt;
}

// A name that is made of a type and a line.
struct LineName {
  std::string_view type;  // "" for any
  int line = 0;
};

// `ReactiveSequence17`, `ReactiveSequence17_btn4`.
std::optional<LineName> line_name(std::string_view name) {
  name = name.substr(0, name.find("_btn"));
  std::size_t digits = name.size();
  while (digits > 0 && is_digit(name[digits - 1])) --digits;
  const auto line = line_in(name.substr(digits));
  if (!line || digits == 0) return std::nullopt;
  return LineName{name.substr(0, digits), *line};
}

}  // namespace

std::vector<MovedNode> moved_nodes(const InputFile& tree,
                                   const std::string& text) {
  std::vector<MovedNode> nodes = nodes_in(tree);
  const std::vector<MovedNode> after = nodes_in({tree.name, text});
  nodes.resize(std::min(nodes.size(), after.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].after = after[i].before;
  }
  return nodes;
}

std::vector<Diagnostic> stale_names(const InputFile& rules,
                                    const std::string& tree,
                                    const std::vector<MovedNode>& nodes) {
  const SourceText source(rules.name, rules.text.text());
  const TokenList read = tokenize(source);
  std::multimap<int, const MovedNode*> by_line;
  for (const MovedNode& node : nodes) by_line.emplace(node.before, &node);
  std::vector<Diagnostic> found;
  for (std::size_t i = 0; i < read.tokens.size(); ++i) {
    if (found.size() == kMostFindings) break;
    const Token& token = read.tokens[i];
    std::optional<LineName> name = line_name(token.text);
    if (i > 0 && read.tokens[i - 1].kind == TokenKind::At) {
      const auto line = line_in(token.text);
      name = line ? std::optional(LineName{{}, *line}) : std::nullopt;
    }
    if (!name) continue;
    std::set<int> lines;
    const auto [first, end] = by_line.equal_range(name->line);
    for (auto node = first; node != end; ++node) {
      const bool is_it = name->type.empty() ||
                         equal_ignoring_case(node->second->word, name->type);
      if (is_it) lines.insert(node->second->after);
    }
    if (lines.empty() || lines == std::set<int>{name->line}) continue;
    found.push_back(source.diagnostic(
        Severity::Warning, "BT0014", token.span,
        fmt::format("what stood on line {} of `{}` stands on line {}",
                    name->line, tree, fmt::join(lines, " or ")),
        "named by its old line",
        "write the new line, or give the node a name and write that"));
  }
  return found;
}

}  // namespace btcheck
