// SPDX-License-Identifier: MIT
#include "cli/explain_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "cli/options/option_words.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

std::string indented(const std::string& text, std::string_view indent) {
  std::string result;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != text.npos;
       begin = end + 1) {
    result += fmt::format("{}{}\n", indent, text.substr(begin, end - begin));
  }
  return result;
}

std::string example_text(const CodeExample& example) {
  std::string text = "\nThe smallest example\n";
  for (const ExampleFile& file : files_of(example)) {
    text += fmt::format("\n  {}\n{}", file.name, indented(file.text, "    "));
  }
  text += '\n';
  for (const std::string& command : commands_of(example)) {
    text += fmt::format("  $ btcheck {}\n", command);
  }
  return text;
}

// "1014" is BT1014.
std::string full_code(const std::string& word) {
  const bool is_number =
      !word.empty() && std::all_of(word.begin(), word.end(),
                                   [](char c) { return c >= '0' && c <= '9'; });
  return is_number ? "BT" + word : word;
}

Answer no_such_code(const std::string& word) {
  std::vector<std::string> codes;
  for (const CodeRow* row : all_codes()) codes.emplace_back(row->code);
  const auto meant = closest_match(full_code(word), codes);
  return usage_error(
      fmt::format("no code `{}`", word),
      meant ? fmt::format("did you mean {}? `btcheck explain` lists them all",
                          *meant)
            : "`btcheck explain` lists them all");
}

}  // namespace

std::string explanation(const CodeRow& row) {
  std::string summary(row.summary);
  if (summary.ends_with('.')) summary.pop_back();
  std::string text =
      fmt::format("{}: {}\n\n{}\n\nWhat to do: {}\n", row.code, summary,
                  wrapped(row.description, 0), wrapped(row.help, 12));
  if (row.example.exists()) text += example_text(row.example);
  return text;
}

std::string code_list() {
  std::string text;
  for (const CodeRow* row : all_codes()) {
    text += fmt::format("{}  {}\n", row->code, wrapped(row->summary, 8));
  }
  return text + "\n`btcheck explain CODE` tells more about one of them.\n";
}

ExitCode run_explain(const Options& options) {
  if (options.input.empty()) {
    fmt::print("{}", code_list());
    return ExitCode::Met;
  }
  const CodeRow* row = code_named(full_code(options.input));
  if (row == nullptr) {
    const Answer answer = no_such_code(options.input);
    fmt::print(stderr, "{}", answer.text);
    return answer.code;
  }
  fmt::print("{}", explanation(*row));
  return ExitCode::Met;
}

}  // namespace btcheck
