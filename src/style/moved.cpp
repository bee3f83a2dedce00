// SPDX-License-Identifier: MIT
#include "style/moved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "ltl/rules/parser.hpp"
#include "model/btcpp/xml_text.hpp"
#include "model/btf/forms.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// The lines of the words that may name a node, in their order.
std::vector<int> lines_of_nodes(const InputFile& tree) {
  std::vector<int> lines;
  if (is_xml(tree.name, tree.text)) {
    const auto parsed = tree.text.parsed<btcpp::ParsedXml>();
    if (!parsed->value) return lines;
    for (const auto& each : *parsed->value) lines.push_back(each.span.line);
  } else {
    const auto parsed = tree.text.parsed<btf::ParsedForms>();
    for (const auto& each : parsed->forms.all) {
      if (!each.is_list() || each.items.empty()) continue;
      lines.push_back(parsed->forms[each.items.front()].span.line);
    }
  }
  return lines;
}

std::optional<int> line_in(std::string_view digits) {
  const auto number = as_number<int>(digits);
  return number && *number > 0 ? std::optional(*number) : std::nullopt;
}

// `ReactiveSequence17`, `ReactiveSequence17_btn4`.
std::optional<int> line_in_name(std::string_view name) {
  name = name.substr(0, name.find("_btn"));
  std::size_t digits = name.size();
  while (digits > 0 && is_digit(name[digits - 1])) --digits;
  const std::string_view type = name.substr(0, digits);
  const bool is_type = std::ranges::any_of(kNodeTypes, [&](const auto& info) {
    return equal_ignoring_case(info.name, type);
  });
  return is_type ? line_in(name.substr(digits)) : std::nullopt;
}

}  // namespace

std::map<int, int> moved_lines(const InputFile& tree, const std::string& text) {
  const std::vector<int> before = lines_of_nodes(tree);
  const std::vector<int> after = lines_of_nodes({tree.name, text});
  std::map<int, int> moved;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    if (before[i] != after[i]) moved.try_emplace(before[i], after[i]);
  }
  return moved;
}

std::vector<Diagnostic> stale_names(const InputFile& rules,
                                    const std::string& tree,
                                    const std::map<int, int>& moved) {
  const SourceText source(rules.name, rules.text.text());
  const TokenList read = tokenize(source);
  std::vector<Diagnostic> found;
  for (std::size_t i = 0; i < read.tokens.size(); ++i) {
    const Token& token = read.tokens[i];
    const bool is_behind_at = i > 0 && read.tokens[i - 1].kind == TokenKind::At;
    const auto line =
        is_behind_at ? line_in(token.text) : line_in_name(token.text);
    const auto now = line ? moved.find(*line) : moved.end();
    if (now == moved.end()) continue;
    found.push_back(source.diagnostic(
        Severity::Warning, "BT0014", token.span,
        fmt::format("`{}` has its nodes on other lines now", tree),
        fmt::format("what stood on line {} stands on line {}", now->first,
                    now->second),
        "write the new line, or give the node a name and write that"));
  }
  return found;
}

}  // namespace btcheck
