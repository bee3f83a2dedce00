// SPDX-License-Identifier: MIT
//
// What has to be true of every row of the tables.
#include "cli/options/tables.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "text/utf8.hpp"

namespace btcheck::tables_test {
namespace {

// A line that gives `option` to `command`, with all it needs besides.
std::variant<Options, Answer> parsed(const CommandRow& command,
                                     const OptionRow& option,
                                     const std::string& value) {
  std::vector<std::string> line = {"btcheck", std::string(command.word)};
  if (!command.missing.empty()) line.push_back("bash");
  if (command.command == Command::Explain) line.push_back("robot.mcap");
  const bool asks_run =
      command.command == Command::Trace &&
      (option.name == "--trace-dir" || option.name == "--tick-ms");
  for (const OptionRow& needed : option_rows()) {
    if (!needed.is_required || !needed.commands.contains(command.command) ||
        needed.name == option.name ||
        (!needed.instead.empty() &&
         (asks_run ||
          std::ranges::count(words_of(needed.instead), option.name) > 0))) {
      continue;
    }
    line.emplace_back(needed.name);
    line.push_back(option.name == "--namespace" ? "monitor-cpp"
                                                : choices_of(needed)[0]);
  }
  if (option.name == "--ticks" || option.name == "-o") {
    if (command.command == Command::Simulate) line.push_back("--seed=1");
  }
  if (asks_run) line.push_back("--prop=rules.ltl");
  if (command.command == Command::Tests && option.name != "-o") {
    line.insert(line.end(), {"-o", "suites"});
  }
  if (command.command == Command::Run && option.name != "--script" &&
      option.name != "--leaves-exec") {
    line.push_back("--leaves-exec=true");
  }
  const bool needs_others =
      option.name == "--lease" || option.name == "--no-wait";
  if (command.command == Command::Batch && needs_others) {
    line.emplace_back("--results=shared");
  }
  const bool checks =
      command.command == Command::Check || command.command == Command::Batch;
  if (checks && option.name == "--view") line.emplace_back("--watch");
  if (option.name == "--stdin-name" && command.command == Command::Fmt) {
    line.at(2) = "-";
  }
  if (option.name == "--topic") {
    const bool reads_tree = command.command != Command::Trace &&
                            command.command != Command::Explain &&
                            command.command != Command::Conform;
    if (reads_tree) {
      line.emplace_back("--from=robot.mcap");
    } else {
      line.at(2) = "robot.mcap";
    }
  }
  if (option.name == "--tick-gap") {
    if (command.command == Command::Conform) {
      line.emplace_back("--learn-leaves=new.leaves");
    } else if (command.command != Command::Trace &&
               command.command != Command::Explain &&
               command.command != Command::Watch) {
      line.emplace_back("--from=robot.btlog@1");
    }
  }
  if (command.command == Command::Diff && option.name != "--git") {
    line.emplace_back("other.xml");
  }
  if (command.command == Command::Watch) {
    line.at(2) = "groot2://robot";
    const bool injects = option.name == "--inject" ||
                         option.name == "--break" ||
                         option.name == "--break-for";
    if (injects) line.emplace_back("--allow-inject");
    const bool goes_with =
        option.name == "--break-for" || option.name == "--allow-inject";
    if (goes_with) line.emplace_back("--break=dock");
  }
  if (option.name == "--observe" && command.command == Command::Space) {
    line.emplace_back("--reduce=bisimulation");
  }
  line.emplace_back(option.name);
  if (option.may_stand_alone) {
    line.back() += '=' + value;
  } else if (option.kind() != ValueKind::Flag) {
    const bool is_log =
        command.command == Command::Watch && option.name == "-o";
    line.push_back(is_log ? value + ".btlog" : value);
  }
  std::vector<const char*> argv;
  for (const std::string& word : line) argv.push_back(word.c_str());
  return parse_options(static_cast<int>(argv.size()), argv.data());
}

std::vector<std::string> values_of(const OptionRow& option) {
  std::vector<std::string> values = choices_of(option);
  if (option.kind() == ValueKind::Target) values.push_back(values[0] + "=file");
  if (option.name == "--memory") values.push_back("1G");
  if (option.name == "--shard") values.push_back("1/2");
  if (option.name == "--deny") values = {"warnings", "BT2205"};
  if (option.name == "--namespace") values = {"robot::rules", "_a"};
  if (option.name == "--inject") values = {"dock fails"};
  if (values.empty()) values.push_back("7");
  return values;
}

TEST_CASE("each command takes its options, with each of their choices") {
  for (const CommandRow& command : command_rows()) {
    for (const OptionRow& option : option_rows()) {
      if (!option.commands.contains(command.command)) continue;
      for (const std::string& value : values_of(option)) {
        CAPTURE(command.word);
        CAPTURE(option.name);
        CAPTURE(value);
        const auto result = parsed(command, option, value);
        const auto* answer = std::get_if<Answer>(&result);
        const bool is_understood =
            answer == nullptr || answer->code == ExitCode::Met;
        CHECK(is_understood);
      }
    }
  }
}

TEST_CASE("no command takes an option of another") {
  for (const CommandRow& command : command_rows()) {
    for (const OptionRow& option : option_rows()) {
      if (option_of(command.command, option.name) != nullptr) continue;
      CAPTURE(command.word);
      CAPTURE(option.name);
      const auto result = parsed(command, option, values_of(option)[0]);
      const auto* answer = std::get_if<Answer>(&result);
      REQUIRE(answer != nullptr);
      CHECK(answer->code == ExitCode::BadInput);
      CHECK(answer->text.find("belongs to") != std::string::npos);
    }
  }
}

TEST_CASE("an option means one thing to a command") {
  for (const CommandRow& command : command_rows()) {
    std::set<std::string_view> names;
    for (const OptionRow& option : option_rows()) {
      if (!option.commands.contains(command.command)) continue;
      CAPTURE(option.name);
      CHECK(names.insert(option.name).second);
    }
  }
}

TEST_CASE("the words of --to mean the formats they name") {
  const OptionRow* to = option_of(Command::Trace, "--to");
  REQUIRE(to != nullptr);
  const CommandRow& trace = row_of(Command::Trace);
  const std::vector<TraceFormat> formats = {
      TraceFormat::Text,        TraceFormat::Html,  TraceFormat::Itf,
      TraceFormat::Svg,         TraceFormat::Strip, TraceFormat::Dot,
      TraceFormat::Mermaid,     TraceFormat::Btlog, TraceFormat::Chrome,
      TraceFormat::ChromeStack, TraceFormat::Mcap,  TraceFormat::Substitution};
  const std::vector<std::string> words = {
      "text",    "html",  "itf",    "svg",          "strip", "dot",
      "mermaid", "btlog", "chrome", "chrome-stack", "mcap",  "substitution"};
  CHECK(choices_of(*to) == words);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto result = parsed(trace, *to, words[i]);
    REQUIRE(std::holds_alternative<Options>(result));
    CHECK(std::get<Options>(result).trace.format == formats[i]);
  }
}

TEST_CASE("the help of a command names its options and no others") {
  for (const CommandRow& command : command_rows()) {
    const std::string text = help_text(command.command);
    const std::string options =
        text.substr(text.find("Options:"),
                    text.find("Exit codes:") - text.find("Options:"));
    for (const OptionRow& option : option_rows()) {
      CAPTURE(command.word);
      CAPTURE(option.name);
      const bool is_named =
          options.find("\n  " + shown_name(option)) != std::string::npos;
      // As this command takes it.
      const OptionRow* own = option_of(command.command, option.name);
      CHECK(is_named ==
            (own != nullptr && shown_name(*own) == shown_name(option)));
    }
  }
}

TEST_CASE("the first help of a command names each of its options") {
  for (const CommandRow& command : command_rows()) {
    std::string text = first_help(command.command);
    std::ranges::replace(text, '\n', ' ');
    for (const OptionRow& option : option_rows()) {
      CAPTURE(command.word);
      CAPTURE(option.name);
      const bool is_named =
          text.find(fmt::format(" {} ", option.name)) != std::string::npos ||
          text.find(fmt::format("  {}", shown_name(option))) !=
              std::string::npos;
      const bool is_taken = option_of(command.command, option.name) != nullptr;
      CHECK((is_named || !is_taken));
    }
  }
}

TEST_CASE("no line of help is wider than a terminal") {
  std::string all = short_help() + first_help() + help_text();
  for (const CommandRow& row : command_rows()) {
    all += first_help(row.command) + help_text(row.command);
  }
  std::size_t begin = 0;
  for (std::size_t end; (end = all.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    CAPTURE(all.substr(begin, end - begin));
    CHECK(end - begin <= kLineWidth);
  }
}

TEST_CASE("a text is broken between words, a long one is left whole") {
  CHECK(wrapped("a bb  ccc", 0, 4) == "a bb\nccc");
  CHECK(wrapped("a bb ccc", 2, 6) == "a bb\n  ccc");
  CHECK(wrapped("abcdefgh i", 0, 4) == "abcdefgh\ni");
  CHECK(wrapped("é é é", 0, 3) == "é é\né");
  CHECK(wrapped("", 3) == "");
}

}  // namespace
}  // namespace btcheck::tables_test
