// SPDX-License-Identifier: MIT
//
// CLI11 takes the line apart. Which words there may be stands in the tables;
// what is said about any other word is said here. `btcheck TREE` is the default
// command, so the first word decides: it names a command, or it is the tree.
#include "cli/options/words.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>

#include "model/foreign_format.hpp"
#include "model/tree_file.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {
namespace {

// A word that is neither a command nor a file, and nearly a command.
void refuse_command(const std::string& word) {
  std::error_code fault;
  if (word.starts_with('-') || word.find_first_of("./") != word.npos ||
      std::filesystem::exists(word, fault)) {
    return;
  }
  std::vector<std::string> commands;
  for (const CommandRow& row : shown_commands()) {
    commands.emplace_back(row.word);
  }
  if (const auto meant = closest_match(word, commands)) {
    refuse(fmt::format("no command and no file `{}`", word),
           fmt::format("did you mean `btcheck {}`?", *meant));
  }
}

// A tree, or what another tool has written instead of one.
bool is_read_as_tree(const std::string& word) {
  return is_tree_name(word) || refusal_of_foreign(word, "").has_value();
}

// A folder, or several trees: `btcheck .` is `btcheck batch .`.
bool names_many(const std::vector<std::string>& inputs) {
  return std::ranges::any_of(inputs, is_folder) ||
         std::ranges::count_if(inputs, is_read_as_tree) > 1;
}

// An option of other commands: tells which.
[[noreturn]] void refuse_misplaced(const OptionRow& option, Command command) {
  std::string owners = commands_with(option.name);
  const bool has_one_owner = owners.find(' ') == std::string::npos;
  if (has_one_owner) owners = fmt::format("`btcheck {}`", owners);
  // With a few owners an example says more than a list of what there is.
  refuse(fmt::format("{} belongs to {}", option.name, owners),
         !option.example.empty()
             ? std::string(option.example)
             : fmt::format("btcheck {0} --help lists what {0} takes",
                           row_of(command).word));
}

[[noreturn]] void refuse_option(const std::string& word, Command command) {
  if (word.starts_with("-=")) {
    refuse(fmt::format("`{}` follows an option that takes no value",
                       word.substr(1)),
           "leave it out");
  }
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> own;
  std::vector<std::string> all;
  for (const OptionRow& row : option_rows()) {
    if (row.name == name) refuse_misplaced(row, command);
    all.emplace_back(row.name);
    if (row.commands.contains(command)) own.emplace_back(row.name);
  }
  const std::string message = fmt::format("unknown option {}", name);
  if (const auto meant = closest_match(name, own)) {
    refuse(message, fmt::format("did you mean {}?", *meant));
  }
  if (const auto meant = closest_match(name, all)) {
    refuse(message, fmt::format("did you mean {} of {}?", *meant,
                                commands_with(*meant)));
  }
  refuse(message, fmt::format("btcheck {} --help lists every option",
                              row_of(command).word));
}

void refuse_extra(const CommandRow& command,
                  const std::vector<std::string>& inputs) {
  const bool takes_many = command.argument == ArgumentKind::Trees ||
                          command.argument == ArgumentKind::Logs ||
                          command.argument == ArgumentKind::Robots ||
                          command.argument == ArgumentKind::Files ||
                          command.argument == ArgumentKind::Batches;
  const std::size_t most = command.argument == ArgumentKind::None ? 0
                           : takes_many                           ? SIZE_MAX
                                                                  : 1;
  if (inputs.size() <= most) return;
  if (command.command == Command::Demo) {
    refuse("demo takes no files", "btcheck TREE checks a tree");
  }
  for (const std::string& word : inputs) {
    if (command_named(word) == nullptr) continue;
    refuse(fmt::format("`{}` is not the first word", word),
           fmt::format("btcheck {} ...: the command comes first, then its "
                       "options",
                       word));
  }
  refuse(fmt::format("one word too many: `{}`", inputs[most]),
         fmt::format("btcheck {}{}{}", command.word,
                     command.shown.empty() ? "" : " ", command.shown));
}

[[noreturn]] void refuse_empty(const OptionRow& option) {
  refuse(fmt::format("{} needs a value", option.name),
         fmt::format("{} {}: {}", option.name, option.value, option.help));
}

// A value that is none of the choices. Targets are left to whoever reads them.
void refuse_value(const OptionRow& option, Command command,
                  const std::string& word) {
  if (option.kind() != ValueKind::Choice) return;
  const std::vector<std::string> choices = choices_of(option);
  if (std::find(choices.begin(), choices.end(), word) != choices.end()) return;
  std::string kind(option.value);
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](char c) { return static_cast<char>(c - 'A' + 'a'); });
  const auto meant = closest_match(word, choices);
  refuse(fmt::format("{}{} {}: no such {}", spoken_of(command), option.name,
                     word, kind),
         fmt::format("{}{} takes {}{}",
                     meant ? fmt::format("did you mean `{}`? ", *meant) : "",
                     option.name, listed(choices, "or"), option.also));
}

void refuse_values(const OptionWords& words) {
  for (const auto& [name, values] : words.values) {
    const OptionRow& option = *option_of(words.command, name);
    const bool is_flag = option.kind() == ValueKind::Flag;
    if (is_flag && values.size() > 1) continue;
    if (values.size() > 1 && !option.is_repeatable) {
      refuse(fmt::format("{} is given twice", name), "leave out one of them");
    }
    for (const std::string& word : values) {
      if (word.empty() && !is_flag && !option.may_stand_alone) {
        refuse_empty(option);
      }
      refuse_value(option, words.command, word);
    }
  }
}

// The only way in which a line of known words cannot be taken apart.
[[noreturn]] void refuse_unparsed(Command command,
                                  const std::string& complaint) {
  const std::string name = complaint.substr(0, complaint.find_first_of(": "));
  const OptionRow* option = option_of(command, name);
  if (option == nullptr) refuse(complaint, "btcheck --help");
  if (option->kind() == ValueKind::Flag) {
    refuse(fmt::format("{} takes no value", name), option->help);
  }
  refuse_empty(*option);
}

// Fills the words from the line; returns those that nobody takes.
std::vector<std::string> take_apart(std::vector<std::string> line,
                                    OptionWords& words) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  app.add_option("INPUT", words.inputs);
  std::vector<std::pair<const OptionRow*, CLI::Option*>> added;
  for (const OptionRow& row : option_rows()) {
    if (!row.commands.contains(words.command)) continue;
    std::string name =
        row.name == "--help" ? "-h,--help" : std::string(row.name);
    if (row.may_stand_alone) name += "{}";  // then its value is ""
    added.emplace_back(
        &row, row.kind() == ValueKind::Flag || row.may_stand_alone
                  ? app.add_flag(name)
                  : app.add_option(name)
                        ->expected(1)
                        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
                        ->allow_extra_args(false));
  }
  std::reverse(line.begin(), line.end());
  app.parse(line);
  for (const auto& [row, option] : added) {
    if (option->count() > 0) words.values[row->name] = option->results();
  }
  return app.remaining();
}

}  // namespace

bool is_folder(const std::string& input) {
  std::error_code fault;
  return std::filesystem::is_directory(input, fault);
}

bool names_tree(const std::string& input) {
  return is_tree_name(input) && !is_folder(input);
}

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

void refuse(std::string_view message, std::string_view help) {
  std::string text = fmt::format("error[BT0001]: {}\n", message);
  if (!help.empty()) text += fmt::format("  = help: {}\n", help);
  throw Refusal{{std::move(text), ExitCode::BadInput}};
}

std::string spoken_of(Command command) {
  return command == Command::Check ? ""
                                   : fmt::format("{} ", row_of(command).word);
}

OptionWords sorted_words(std::vector<std::string> line) {
  OptionWords words;
  if (const CommandRow* named = command_named(line[0])) {
    words.command = named->command;
    words.names_command = true;
    line.erase(line.begin());
  } else {
    refuse_command(line[0]);
  }
  try {
    auto unknown = take_apart(line, words);
    if (words.command == Command::Check && names_many(words.inputs)) {
      const bool names_command = words.names_command;
      words = {};
      words.command = Command::Batch;
      words.names_command = names_command;
      unknown = take_apart(std::move(line), words);
    }
    // A help that is asked for is better than a complaint.
    if (words.has("--help")) return words;
    for (const std::string& word : unknown) {
      if (word != "--") refuse_option(word, words.command);
    }
  } catch (const CLI::ParseError& error) {
    refuse_unparsed(words.command, error.what());
  }
  refuse_values(words);
  refuse_extra(row_of(words.command), words.inputs);
  return words;
}

}  // namespace btcheck
