// SPDX-License-Identifier: MIT
#include "check/findings/judgement.hpp"

#include <algorithm>

namespace btcheck {
namespace {

bool allows(std::string_view line, std::string_view code) {
  constexpr std::string_view kWord = "btcheck: allow";
  const auto at = line.find(kWord);
  return at != line.npos && line.find(code, at) != line.npos;
}

// A line of comments alone, as far as one line tells.
bool is_comment(std::string_view line) {
  const auto first = line.find_first_not_of(" \t?");
  if (first == line.npos) return false;
  const std::string_view text = line.substr(first);
  return text.starts_with("<!--") || text.starts_with(';') ||
         text.ends_with("-->");
}

bool is_allowed_at(const SourceText& source, int line, std::string_view code) {
  if (allows(source.line(line), code)) return true;
  for (int above = line - 1; above > 0; --above) {
    const std::string text = source.line(above);
    if (!is_comment(text)) return false;
    if (allows(text, code)) return true;
  }
  return false;
}

}  // namespace

std::size_t take_allowed(std::vector<TreeFinding>& findings,
                         const BehaviorTree& tree,
                         const std::vector<SourceText>& files) {
  std::size_t taken = 0;
  for (const SourceText& source : files) {
    taken += std::erase_if(findings, [&](const TreeFinding& finding) {
      return tree.file_of(finding.node) == source.name() &&
             is_allowed_at(source, tree.node(finding.node).span.line,
                           finding.code);
    });
  }
  return taken;
}

bool is_denied(const std::vector<std::string>& denied, std::string_view code,
               Severity severity) {
  return std::ranges::any_of(denied, [&](const std::string& word) {
    return equal_ignoring_case(word, code) ||
           (word == "warnings" && severity == Severity::Warning);
  });
}

}  // namespace btcheck
