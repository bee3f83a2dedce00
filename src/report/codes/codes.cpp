// SPDX-License-Identifier: MIT
#include "report/codes/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace btcheck {
namespace {

bool is_xml(const CodeExample& example) {
  return !example.body.empty() || example.tree.starts_with('<');
}

std::string tree_name(const CodeExample& example) {
  return is_xml(example) ? "tree.xml" : "tree.btf";
}

std::string tree_text(const CodeExample& example) {
  if (example.body.empty()) return std::string(example.tree);
  std::string text = fmt::format(
      "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"T\">\n{}\n"
      "</BehaviorTree>\n",
      example.body);
  if (!example.models.empty()) {
    text +=
        fmt::format("<TreeNodesModel>{}</TreeNodesModel>\n", example.models);
  }
  return text + "</root>";
}

Objection objection_to(const CodeRow& row) {
  const auto said = [&](std::string_view what, std::string help) {
    return Objection{fmt::format("{} is {} and has no level", row.code, what),
                     std::move(help)};
  };
  if (row.code.starts_with("BT20")) {
    return said("the verdict of a rule",
                "write `expect violated` at a rule that is meant to be broken");
  }
  if (row.code.starts_with("BT21")) {
    return said("an answer about the mission as a whole",
                "ask for what it is to do by rules, --prop FILE");
  }
  if (row.severity == Severity::Error) {
    return said("an error", "where there is one nothing can be checked");
  }
  return said("not about a tree or a rule",
              "levels are for BT22xx, BT23xx, BT25xx and what readers warn of");
}

}  // namespace

std::vector<const CodeRow*> all_codes() {
  std::vector<const CodeRow*> rows;
  for (const auto family :
       {command_codes(), tree_codes(), property_codes(), btcpp_codes(),
        verdict_codes(), lint_codes(), recording_codes(), robot_codes()}) {
    for (const CodeRow& row : family) rows.push_back(&row);
  }
  std::ranges::sort(rows, {}, &CodeRow::code);
  return rows;
}

const CodeRow* code_named(std::string_view code) {
  static const std::vector<const CodeRow*> rows = all_codes();
  const auto found = std::ranges::find_if(rows, [&](const CodeRow* row) {
    return equal_ignoring_case(row->code, code);
  });
  return found == rows.end() ? nullptr : *found;
}

bool has_level(const CodeRow& row) {
  constexpr std::string_view kFamilies[] = {"BT10", "BT11", "BT12", "BT16",
                                            "BT22", "BT23", "BT25"};
  constexpr std::string_view kMission = "BT21";  // as a whole
  if (row.code.starts_with(kMission)) return true;
  return row.severity != Severity::Error &&
         std::ranges::any_of(kFamilies, [&](std::string_view family) {
           return row.code.starts_with(family);
         });
}

Objection objection_to(std::string_view word) {
  if (const CodeRow* row = code_named(word)) return objection_to(*row);
  std::vector<std::string> words = {"warnings"};
  for (const CodeRow* row : all_codes()) words.emplace_back(row->code);
  return {
      fmt::format("no code `{}`", word),
      did_you_mean(word, words, "write a code such as BT2208, or `warnings`")};
}

std::vector<ExampleFile> files_of(const CodeExample& example) {
  std::vector<ExampleFile> files;
  const auto add = [&](std::string_view name, std::string_view text) {
    if (!text.empty())
      files.push_back({std::string(name), fmt::format("{}\n", text)});
  };
  add(tree_name(example), tree_text(example));
  add("rules.ltl", example.rules);
  add("script.txt", example.script);
  add(example.other_name, example.other);
  return files;
}

std::vector<std::string> commands_of(const CodeExample& example) {
  if (!example.exists()) return {};
  const std::string tree = tree_name(example);
  std::string words(example.command);
  if (words.empty()) {
    words = !example.script.empty()
                ? "simulate " + tree + " --script script.txt"
            : !example.rules.empty() ? tree + " --prop rules.ltl"
                                     : tree;
  }
  std::vector<std::string> lines;
  std::istringstream rest(words);
  for (std::string line; std::getline(rest, line);) {
    lines.push_back(line.starts_with("$ ") ? line.substr(2)
                                           : "btcheck " + line);
  }
  return lines;
}

}  // namespace btcheck
