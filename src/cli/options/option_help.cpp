// SPDX-License-Identifier: MIT
#include "cli/options/option_help.hpp"

#include <fmt/format.h>

#include <array>

#include "cli/options/version.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kTitle =
    "btcheck: a model checker for behavior trees\n";

constexpr std::array kExitCodes = {
    ExitCodeRow{ExitCode::Met, "every property met its expectation"},
    ExitCodeRow{ExitCode::Missed,
                "some property missed its expectation, or the default report "
                "or `lint` found a fault"},
    ExitCodeRow{ExitCode::BadInput,
                "usage, input or model error: nothing was checked"},
    ExitCodeRow{ExitCode::Undecided,
                "undecided: a limit, a timeout or an interrupt, and nothing "
                "violated"},
    ExitCodeRow{ExitCode::Internal, "internal error"}};

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
  for (const CommandRow& row : command_rows()) {
    if (!row.is_hidden) text += entry(row.word, row.summary, 12);
  }
  return text;
}

std::string exit_codes_text() {
  std::string text = "Exit codes:\n";
  for (const ExitCodeRow& row : kExitCodes) {
    text +=
        entry(fmt::format("{}", static_cast<int>(row.code)), row.meaning, 5);
  }
  return text;
}

std::string option_entry(const OptionRow& option, std::string_view owners) {
  return entry(shown_name(option),
               fmt::format("{}{}", owners, shown_help(option)), kHelpColumn);
}

}  // namespace

std::span<const ExitCodeRow> exit_code_rows() { return kExitCodes; }

std::string short_help() {
  return std::string(kTitle) + R"(
  btcheck TREE.btf                     what each node can and cannot do
  btcheck TREE.btf --prop RULES.ltl    check rules; show runs that break them
  btcheck batch FOLDER                 check all trees and rules in a folder
  btcheck space TREE.btf               build and measure the state space
  btcheck export TREE.btf --to dot     draw it; models: promela, smv, fiacre
  btcheck trace RUN.itf.json --to svg  a run that was kept, as a picture or log
  btcheck simulate TREE.btf            step through it; --seed, --script: a run
  btcheck demo                         a drone mission, and the hole in it

  btcheck --help                       every command, option and exit code
)";
}

std::string help_text() {
  std::string text = fmt::format(
      "{}\nUsage: btcheck [COMMAND] TREE.btf [OPTION]...\n\n{}\nOptions, and "
      "the commands that take them:\n",
      kTitle, commands_text());
  for (const OptionRow& option : option_rows()) {
    const std::string owners = commands_with_row(option);
    text += option_entry(option, owners.empty() ? owners : owners + ": ");
  }
  return text + '\n' + exit_codes_text();
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

std::string shown_name(const OptionRow& option) {
  if (option.name == "--help") return "-h, --help";
  return option.value.empty() ? std::string(option.name)
                              : fmt::format("{} {}", option.name, option.value);
}

std::string shown_help(const OptionRow& option) {
  std::string text(option.help);
  // Choices that the help does not speak of.
  if (!option.choices.empty() && option.help.find(": ") == option.help.npos) {
    text += fmt::format(": {}", listed(choices_of(option), "or"));
  }
  if (option.kind == ValueKind::Target) {
    text += fmt::format("; {}=FILE writes a file", option.value);
  }
  if (option.is_repeatable) text += "; may be given several times";
  if (!option.fallback.empty()) {
    text += fmt::format(" (default: {})", option.fallback);
  }
  return text;
}

std::string commands_with_row(const OptionRow& option) {
  std::string words;
  bool is_for_all = true;
  for (const CommandRow& row : command_rows()) {
    if (row.is_hidden) continue;
    const bool takes_it = option.commands.contains(row.command);
    is_for_all &= takes_it;
    if (takes_it)
      words += fmt::format("{}{}", words.empty() ? "" : ", ", row.word);
  }
  return is_for_all ? "" : words;
}

std::string version_text() { return fmt::format("btcheck {}\n", kVersion); }

}  // namespace btcheck
