// SPDX-License-Identifier: MIT
//
// The man page, in the macros of man(7).
#include <fmt/format.h>

#include "cli/options/completions.hpp"
#include "cli/options/option_help.hpp"
#include "cli/options/option_table.hpp"
#include "cli/options/version.hpp"

namespace btcheck {
namespace {

// A text as troff reads it: what would be a request or a hyphen is itself.
std::string troff(std::string_view text) {
  std::string result;
  if (text.starts_with('.') || text.starts_with('\'')) result = "\\&";
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if (c == '`') {
      result += "\\(ga";
    } else {
      result += c;
    }
  }
  return result;
}

std::string item(std::string_view name, std::string_view text) {
  return fmt::format(".TP\n{}\n{}\n", name, troff(text));
}

std::string option_item(const OptionRow& option) {
  std::string name = fmt::format("\\fB{}\\fR", troff(option.name));
  if (option.name == "--help") name = "\\fB\\-h\\fR, " + name;
  if (!option.value.empty()) {
    name += fmt::format(" \\fI{}\\fR", troff(option.value));
  }
  std::string text = shown_help(option);
  const std::string owners = commands_with_row(option);
  if (!owners.empty()) text += fmt::format(". For {}.", owners);
  return item(name, text);
}

constexpr std::string_view kExamples = R"(.TP
\fBbtcheck mission.btf\fR
Tells what each node of the tree can and cannot do.
.TP
\fBbtcheck mission.btf \-\-prop rules.ltl \-\-trace\-dir runs\fR
Checks rules, and keeps the runs that break them.
.TP
\fBbtcheck trace runs/mission.rule.itf.json \-\-to svg \-o run.svg\fR
Draws such a run.
.TP
\fBbtcheck lint mission.btf\fR
Tells what is wrong with the tree as it stands.
)";

}  // namespace

std::string man_page() {
  std::string text = fmt::format(
      ".TH BTCHECK 1 \"\" \"btcheck {}\" \"User Commands\"\n.SH NAME\n"
      "btcheck \\- a model checker for behavior trees\n.SH SYNOPSIS\n",
      kVersion);
  std::string commands;
  for (const CommandRow& row : command_rows()) {
    if (row.is_hidden) continue;
    text +=
        fmt::format("{}.B {}\n", text.ends_with("SYNOPSIS\n") ? "" : ".br\n",
                    troff(usage_of(row)));
    commands += item(fmt::format("\\fB{}\\fR", row.word), row.description);
  }
  text += ".SH DESCRIPTION\n" +
          troff(
              "Tries every combination of action results, sensor values and "
              "interleavings of a behavior tree, and either proves a rule or "
              "shows a run that breaks it. A verdict is HOLDS, VIOLATED or "
              "UNDECIDED; verdicts go to standard output, everything else to "
              "standard error.") +
          "\n.SH COMMANDS\n" + commands + ".SH OPTIONS\n";
  for (const OptionRow& option : option_rows()) text += option_item(option);
  text += ".SH \"EXIT STATUS\"\n";
  for (const ExitCodeRow& row : exit_code_rows()) {
    text += item(fmt::format("{}", static_cast<int>(row.code)), row.meaning);
  }
  text += ".SH ENVIRONMENT\n" +
          item("NO_COLOR", "When it is set, messages have no colours.") +
          item("GITHUB_WORKSPACE",
               "Where reports name files from, as GitHub counts them.");
  return text + ".SH EXAMPLES\n" + std::string(kExamples);
}

}  // namespace btcheck
