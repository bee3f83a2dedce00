// SPDX-License-Identifier: MIT
#include "cli/codes/codes.hpp"

#include <algorithm>

namespace btcheck {

std::vector<const CodeRow*> all_codes() {
  std::vector<const CodeRow*> rows;
  for (const auto family :
       {usage_codes(), tree_codes(), name_codes(), property_codes(),
        run_codes(), batch_codes(), btcpp_codes(), btcpp_finding_codes(),
        contract_codes(), verdict_codes(), lint_codes()}) {
    for (const CodeRow& row : family) rows.push_back(&row);
  }
  std::sort(rows.begin(), rows.end(), [](const auto* left, const auto* right) {
    return left->code < right->code;
  });
  return rows;
}

const CodeRow* code_named(std::string_view code) {
  const std::vector<const CodeRow*> rows = all_codes();
  const auto found = std::find_if(
      rows.begin(), rows.end(),
      [&](const CodeRow* row) { return equal_ignoring_case(row->code, code); });
  return found == rows.end() ? nullptr : *found;
}

namespace {

std::string tree_name(const CodeExample& example) {
  return example.tree.starts_with('<') ? "tree.xml" : "tree.btf";
}

}  // namespace

std::vector<ExampleFile> files_of(const CodeExample& example) {
  std::vector<ExampleFile> files;
  const auto add = [&](std::string_view name, std::string_view text) {
    if (text.empty()) return;
    files.push_back({std::string(name), std::string(text) + '\n'});
  };
  add(tree_name(example), example.tree);
  add("rules.ltl", example.rules);
  add("script.txt", example.script);
  add(example.other_name, example.other);
  return files;
}

std::vector<std::string> commands_of(const CodeExample& example) {
  if (!example.exists()) return {};
  if (example.command.empty()) {
    return {tree_name(example) +
            (example.rules.empty() ? "" : " --prop rules.ltl")};
  }
  std::vector<std::string> lines = {""};
  for (const char c : example.command) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

}  // namespace btcheck
