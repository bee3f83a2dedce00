// SPDX-License-Identifier: MIT
//
// The help and the man page say the same of each option: both are written from
// the rows of `tables`, the one in columns, the other in the macros of man(7).
#include "cli/options/tables.hpp"

#include <fmt/format.h>

#include <array>

#include "cli/options/interface.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kTitle =
    "btcheck: a model checker for behavior trees\n";

// In the order of ExitCode.
constexpr std::array<std::string_view, 5> kExitCodes = {
    "every property met its expectation",
    "some property missed its expectation, the default report or `lint` found "
    "a fault, or `fmt --check` a file in another style",
    "usage, input or model error: nothing was checked",
    "undecided: a limit, a timeout or an interrupt, and nothing violated",
    "internal error"};

// --- Rows as both the help and the man page have them --------------------

std::string usage_of(const CommandRow& command) {
  std::string text = fmt::format("btcheck {}", command.word);
  if (!command.shown.empty()) text += fmt::format(" {}", command.shown);
  for (const OptionRow& option : option_rows()) {
    if (option.is_required && option.commands.contains(command.command)) {
      text += fmt::format(" {} {}", option.name, option.value);
    }
  }
  return text + " [OPTION]...";
}

std::string shown_help(const OptionRow& option) {
  std::string text(option.help);
  // Choices that the help does not speak of.
  if (!option.choices.empty() && option.help.find(": ") == option.help.npos) {
    text += fmt::format(": {}", listed(choices_of(option), "or"));
  }
  if (option.kind() == ValueKind::Target) {
    text += fmt::format("; {}=FILE writes a file", option.value);
  }
  if (option.is_repeatable) text += "; may be given several times";
  if (!option.fallback.empty()) {
    text += fmt::format(" (default: {})", option.fallback);
  }
  return text;
}

// The commands that take an option in this meaning, "check, space"; "" for all.
std::string owners_of(const OptionRow& option) {
  std::vector<std::string_view> words;
  for (const CommandRow& row : shown_commands()) {
    if (option.commands.contains(row.command)) words.push_back(row.word);
  }
  const bool is_for_all = words.size() == shown_commands().size();
  return is_for_all ? "" : fmt::format("{}", fmt::join(words, ", "));
}

// --- Help ----------------------------------------------------------------

constexpr std::size_t kIndent = 2;
constexpr std::size_t kHelpColumn = 26;

// A name, and beside or below it what is said of it.
std::string entry(std::string_view name, std::string_view help,
                  std::size_t column) {
  const std::string text = wrapped(help, column);
  if (name.size() + kIndent + 1 < column) {
    return fmt::format("  {:<{}}{}\n", name, column - kIndent, text);
  }
  return fmt::format("  {}\n{:{}}{}\n", name, "", column, text);
}

std::string commands_text() {
  std::string text = "Commands:\n";
  for (const CommandRow& row : shown_commands()) {
    text += entry(row.word, row.summary, 12);
  }
  return text;
}

std::string exit_codes_text() {
  std::string text = "Exit codes:\n";
  for (std::size_t code = 0; code < kExitCodes.size(); ++code) {
    text += entry(std::to_string(code), kExitCodes[code], 5);
  }
  return text;
}

std::string option_entry(const OptionRow& option, std::string_view owners) {
  return entry(shown_name(option),
               fmt::format("{}{}", owners, shown_help(option)), kHelpColumn);
}

// --- The man page, in the macros of man(7) -------------------------------

// Escapes what troff would take for a request or a hyphen.
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
  if (option.may_stand_alone) {
    name += fmt::format("[=\\fI{}\\fR]", troff(option.value));
  } else if (!option.value.empty()) {
    name += fmt::format(" \\fI{}\\fR", troff(option.value));
  }
  std::string text = shown_help(option);
  const std::string owners = owners_of(option);
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
Tells what is wrong with the tree, without a search.
)";

}  // namespace

std::string short_help() {
  return std::string(kTitle) + R"(
  btcheck TREE                         what is wrong with a tree
  btcheck FOLDER                       the same of all trees in a folder
  btcheck TREE --prop RULES.ltl        check rules; show runs that break them
  btcheck init TREE -o RULES.ltl       write rules to begin with
  btcheck conform LOG TREE             can the tree have written this log?
  btcheck simulate TREE                step through it; --seed, --script: a run
  btcheck export TREE --to svg         draw it; models: promela, smv, fiacre
  btcheck demo                         a drone mission, and the hole in it

  btcheck --help                       a screen of help, and where the rest is
)";
}

std::string first_help() {
  std::string text = std::string(kTitle) + R"(
It tries every answer that the leaves of a tree can give, finds what goes wrong
in some run, and shows that run.

  btcheck TREE                   what is wrong with a tree
  btcheck FOLDER                 the same of all trees in a folder
  btcheck --watch FOLDER         and again, whenever a file in it is saved
  btcheck TREE --prop RULES.ltl  check rules; -e 'never land.failure': one rule
  btcheck conform LOG TREE       can the tree have written this log of a robot?
  btcheck explain BT2208         what the code in a message means

TREE is XML of BehaviorTree.CPP (.xml, .btproj) or a .btf file. `btcheck demo`
shows it all on a drone mission; `btcheck init TREE` writes rules to begin with.

)";
  std::vector<std::string_view> others;
  for (const CommandRow& row : shown_commands()) others.push_back(row.word);
  text +=
      "Commands: " + wrapped(fmt::format("{}", fmt::join(others, ", ")), 10);
  return text + R"(

  btcheck COMMAND --help         one command, with an example
  btcheck COMMAND --help all     with all of its options
  btcheck --help all             every command and option; also: man btcheck

Exit code 0: as expected, 1: something is wrong, 2: nothing was checked,
3: undecided, 4: a mistake of btcheck.
)";
}

std::string help_text() {
  std::string text = fmt::format(
      "{}\nUsage: btcheck [COMMAND] TREE [OPTION]...\n\n{}\nOptions, and "
      "the commands that take them:\n",
      kTitle, commands_text());
  for (const OptionRow& option : option_rows()) {
    const std::string owners = owners_of(option);
    text += option_entry(option, owners.empty() ? owners : owners + ": ");
  }
  return text + '\n' + exit_codes_text();
}

namespace {

// A few choices, and nothing of defaults and repetition.
std::string brief_help(const OptionRow& option) {
  constexpr std::size_t kFew = 7;
  const std::vector<std::string> choices = choices_of(option);
  const bool tells_them = option.help.find(": ") != option.help.npos;
  if (choices.empty() || choices.size() > kFew || tells_them) {
    return std::string(option.help);
  }
  return fmt::format("{}: {}", option.help, listed(choices, "or"));
}

}  // namespace

std::string first_help(Command command) {
  const CommandRow& row = row_of(command);
  std::string text =
      fmt::format("btcheck {}: {}\n\nUsage: {}\n\n{}\n", row.word, row.summary,
                  usage_of(row), wrapped(row.description, 0));
  const bool is_usage = row.example == fmt::format("btcheck {}", row.shown);
  if (!is_usage && !row.example.empty()) {
    text += fmt::format("\n  {}\n", row.example);
  }
  std::string told;
  std::vector<std::string_view> others;
  for (const OptionRow& option : option_rows()) {
    if (!option.commands.contains(command)) continue;
    if (option.first.contains(command)) {
      told += entry(shown_name(option), brief_help(option), kHelpColumn);
    } else {
      others.push_back(option.name);
    }
  }
  if (!told.empty()) text += "\n" + told;
  return text + fmt::format("\n{}\n`btcheck {} --help all` tells of each.\n",
                            wrapped(fmt::format("Options{}: {}",
                                                told.empty() ? "" : " besides",
                                                fmt::join(others, " ")),
                                    0),
                            row.word);
}

std::string help_text(Command command) {
  const CommandRow& row = row_of(command);
  std::string text =
      fmt::format("btcheck {}: {}\n\nUsage: {}\n\n{}\n\nOptions:\n", row.word,
                  row.summary, usage_of(row), wrapped(row.description, 0));
  for (const OptionRow& option : option_rows()) {
    if (option.commands.contains(command)) text += option_entry(option, "");
  }
  return text + '\n' + exit_codes_text();
}

std::string shown_name(const OptionRow& option) {
  if (option.name == "--help") return "-h, --help";
  if (option.value.empty()) return std::string(option.name);
  return fmt::format(fmt::runtime(option.may_stand_alone ? "{}[={}]" : "{} {}"),
                     option.name, option.value);
}

std::string version_text() { return fmt::format("btcheck {}\n", kVersion); }

std::string man_page() {
  std::string text = fmt::format(
      ".TH BTCHECK 1 \"\" \"btcheck {}\" \"User Commands\"\n.SH NAME\n"
      "btcheck \\- a model checker for behavior trees\n.SH SYNOPSIS\n",
      kVersion);
  std::string commands;
  for (const CommandRow& row : shown_commands()) {
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
  for (std::size_t code = 0; code < kExitCodes.size(); ++code) {
    text += item(std::to_string(code), kExitCodes[code]);
  }
  text +=
      ".SH ENVIRONMENT\n" +
      item("NO_COLOR", "When it is set, messages have no colours.") +
      item("GITHUB_WORKSPACE, CI_PROJECT_DIR",
           "Where reports name files from, as GitHub and GitLab count them.");
  return text + ".SH EXAMPLES\n" + std::string(kExamples);
}

}  // namespace btcheck
