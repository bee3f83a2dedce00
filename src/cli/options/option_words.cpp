// SPDX-License-Identifier: MIT
//
// CLI11 takes the line apart; which words there may be is in the table, and
// what is said of the others is said here. `btcheck TREE` is the default
// command, so the first word decides: it names a command, or it is the tree.
#include "cli/options/option_words.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>

#include "text/diagnostic.hpp"

namespace btcheck {
namespace {

std::vector<std::string> visible_commands() {
  std::vector<std::string> words;
  for (const CommandRow& row : command_rows()) {
    if (!row.is_hidden) words.emplace_back(row.word);
  }
  return words;
}

// A word that is neither a command nor a file, and nearly a command.
std::optional<Answer> refuse_command(const std::string& word) {
  std::error_code fault;
  if (word.starts_with('-') || word.find_first_of("./") != word.npos ||
      std::filesystem::exists(word, fault)) {
    return std::nullopt;
  }
  const auto meant = closest_match(word, visible_commands());
  if (!meant) return std::nullopt;
  return usage_error(fmt::format("no command and no file `{}`", word),
                     fmt::format("did you mean `btcheck {}`?", *meant));
}

// An option of other commands, for which it is said where it belongs.
Answer misplaced(const OptionRow& option, Command command) {
  const std::string owners = commands_with(option.name);
  const bool has_one_owner = owners.find(' ') == std::string::npos;
  const std::string belongs =
      has_one_owner ? fmt::format("`btcheck {}`", owners) : owners;
  // With a few owners an example says more than a list of what there is.
  return usage_error(
      fmt::format("{} belongs to {}", option.name, belongs),
      !option.example.empty()
          ? std::string(option.example)
          : fmt::format("btcheck {} --help lists what {} takes",
                        row_of(command).word, row_of(command).word));
}

Answer refuse_option(const std::string& word, Command command) {
  if (word.starts_with("-=")) {
    return usage_error(fmt::format("`{}` follows an option that takes no value",
                                   word.substr(1)),
                       "leave it out");
  }
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> own;
  std::vector<std::string> all;
  for (const OptionRow& row : option_rows()) {
    if (row.name == name) return misplaced(row, command);
    all.emplace_back(row.name);
    if (row.commands.contains(command)) own.emplace_back(row.name);
  }
  auto meant = closest_match(name, own);
  std::string_view owner = row_of(command).word;
  std::string where;
  if (!meant && (meant = closest_match(name, all))) {
    for (const OptionRow& row : option_rows()) {
      if (row.name != *meant) continue;
      where = " of " + commands_with(row.name);
      break;
    }
  }
  return usage_error(
      fmt::format("unknown option {}", name),
      meant ? fmt::format("did you mean {}{}?", *meant, where)
            : fmt::format("btcheck {} --help lists every option", owner));
}

bool takes_many(ArgumentKind kind) {
  return kind == ArgumentKind::Trees || kind == ArgumentKind::Batches;
}

std::optional<Answer> refuse_extra(const CommandRow& command,
                                   const std::vector<std::string>& inputs) {
  const std::size_t most = command.argument == ArgumentKind::None ? 0
                           : takes_many(command.argument)         ? SIZE_MAX
                                                                  : 1;
  if (inputs.size() <= most) return std::nullopt;
  if (command.command == Command::Demo) {
    return usage_error("demo takes no files", "btcheck TREE.btf checks a tree");
  }
  for (const std::string& word : inputs) {
    if (command_named(word) == nullptr) continue;
    return usage_error(fmt::format("`{}` is not the first word", word),
                       fmt::format("btcheck {} ...: the command comes first, "
                                   "then its options",
                                   word));
  }
  return usage_error(
      fmt::format("one word too many: `{}`", inputs[most]),
      fmt::format("btcheck {}{}{}", command.word,
                  command.shown.empty() ? "" : " ", command.shown));
}

// A value that is none of the choices. Targets are left to whoever reads them.
std::optional<Answer> refuse_value(const OptionRow& option, Command command,
                                   const std::string& word) {
  if (option.kind != ValueKind::Choice) return std::nullopt;
  const std::vector<std::string> choices = choices_of(option);
  if (std::find(choices.begin(), choices.end(), word) != choices.end()) {
    return std::nullopt;
  }
  std::string kind(option.value);
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](char c) { return static_cast<char>(c - 'A' + 'a'); });
  const auto meant = closest_match(word, choices);
  return usage_error(
      fmt::format("{}{} {}: no such {}", spoken_of(command), option.name, word,
                  kind),
      fmt::format("{}{} takes {}{}",
                  meant ? fmt::format("did you mean `{}`? ", *meant) : "",
                  option.name, listed(choices, "or"), option.also));
}

std::optional<Answer> refuse_values(const OptionWords& words) {
  for (const auto& [name, values] : words.values) {
    const OptionRow& option = *option_of(words.command, name);
    if (values.size() > 1 && !option.is_repeatable) {
      if (option.kind == ValueKind::Flag) continue;
      return usage_error(fmt::format("{} is given twice", name),
                         "leave out one of them");
    }
    for (const std::string& word : values) {
      if (word.empty() && option.kind != ValueKind::Flag) {
        return usage_error(
            fmt::format("{} needs a value", name),
            fmt::format("{} {}: {}", name, option.value, option.help));
      }
      if (auto refused = refuse_value(option, words.command, word)) {
        return refused;
      }
    }
  }
  return std::nullopt;
}

// The only way in which a line of known words cannot be taken apart.
Answer without_value(Command command, const std::string& complaint) {
  const std::string name = complaint.substr(0, complaint.find_first_of(": "));
  const OptionRow* option = option_of(command, name);
  if (option == nullptr) return usage_error(complaint, "btcheck --help");
  if (option->kind == ValueKind::Flag) {
    return usage_error(fmt::format("{} takes no value", name), option->help);
  }
  return usage_error(
      fmt::format("{} needs a value", name),
      fmt::format("{} {}: {}", name, option->value, option->help));
}

// A line taken apart, with the words that nobody takes.
struct Taken {
  std::vector<std::string> inputs;
  std::map<std::string_view, std::vector<std::string>> values;
  std::vector<std::string> unknown;
};
Taken taken_apart(std::vector<std::string> line, Command command) {
  Taken taken;
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  app.add_option("INPUT", taken.inputs);
  std::vector<CLI::Option*> added;
  std::vector<const OptionRow*> rows;
  for (const OptionRow& row : option_rows()) {
    if (!row.commands.contains(command)) continue;
    const std::string name =
        row.name == "--help" ? "-h,--help" : std::string(row.name);
    added.push_back(
        row.kind == ValueKind::Flag
            ? app.add_flag(name)
            : app.add_option(name)
                  ->expected(1)
                  ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
                  ->allow_extra_args(false));
    rows.push_back(&row);
  }
  std::reverse(line.begin(), line.end());
  app.parse(line);
  for (std::size_t i = 0; i < added.size(); ++i) {
    if (added[i]->count() == 0) continue;
    taken.values[rows[i]->name] = added[i]->results();
  }
  taken.unknown = app.remaining();
  return taken;
}

}  // namespace

std::string OptionWords::value(std::string_view name) const {
  const auto found = values.find(name);
  return found == values.end() ? "" : found->second.back();
}

std::vector<std::string> OptionWords::all(std::string_view name) const {
  const auto found = values.find(name);
  return found == values.end() ? std::vector<std::string>{} : found->second;
}

std::optional<std::size_t> OptionWords::choice(std::string_view name) const {
  const OptionRow* option = option_of(command, name);
  if (option == nullptr || !has(name)) return std::nullopt;
  const std::vector<std::string> choices = choices_of(*option);
  return static_cast<std::size_t>(
      std::find(choices.begin(), choices.end(), value(name)) - choices.begin());
}

Answer usage_error(std::string_view message, std::string_view help) {
  std::string text = fmt::format("error[BT0001]: {}\n", message);
  if (!help.empty()) text += fmt::format("  = help: {}\n", help);
  return {std::move(text), ExitCode::BadInput};
}

std::string spoken_of(Command command) {
  return command == Command::Check ? ""
                                   : fmt::format("{} ", row_of(command).word);
}

std::variant<OptionWords, Answer> sorted_words(std::vector<std::string> line) {
  OptionWords words;
  if (const CommandRow* named = command_named(line[0])) {
    words.command = named->command;
    words.names_command = true;
    line.erase(line.begin());
  } else if (auto refused = refuse_command(line[0])) {
    return *refused;
  }
  try {
    Taken taken = taken_apart(std::move(line), words.command);
    words.inputs = std::move(taken.inputs);
    words.values = std::move(taken.values);
    // A help that is asked for is better than a complaint.
    if (words.has("--help")) return words;
    for (const std::string& word : taken.unknown) {
      if (word != "--") return refuse_option(word, words.command);
    }
  } catch (const CLI::ParseError& error) {
    return without_value(words.command, error.what());
  }
  if (auto refused = refuse_values(words)) return *refused;
  if (auto refused = refuse_extra(row_of(words.command), words.inputs)) {
    return *refused;
  }
  return words;
}

}  // namespace btcheck
