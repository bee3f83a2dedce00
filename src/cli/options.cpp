// SPDX-License-Identifier: MIT
//
// CLI11 reads the words; what they mean, and which belong to a later release,
// is said here. `btcheck TREE` is the default command, so the first word
// decides: it names a command, or it is the tree.
#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>

#include "diagnostic.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kShortHelp =
    R"(btcheck: a model checker for behavior trees

  btcheck TREE.btf                     what each node can and cannot do
  btcheck TREE.btf --prop RULES.ltl    check rules; show runs that break them
  btcheck space TREE.btf               build and measure the state space
  btcheck export TREE.btf --to dot     draw the automata; promela: for SPIN
  btcheck demo                         a drone mission, and the hole in it

  btcheck --help                       every option, default and exit code
)";

constexpr std::string_view kExitCodes = R"(
Exit codes:
  0  every property met its expectation
  1  some property missed its expectation, or the default report found a fault
  2  usage, input or model error: nothing was checked
  3  undecided: a limit, a timeout or an interrupt, and nothing violated
  4  internal error
)";

constexpr std::array<std::string_view, 4> kLaterCommands = {
    "batch", "lint", "simulate", "trace"};

struct CommandWord {
  std::string_view word;
  Command command;
};
constexpr std::array<CommandWord, 4> kCommands = {{{"check", Command::Check},
                                                   {"space", Command::Space},
                                                   {"export", Command::Export},
                                                   {"demo", Command::Demo}}};

Answer usage_error(std::string_view message, std::string_view help) {
  std::string text = fmt::format("error[BT0001]: {}\n", message);
  if (!help.empty()) text += fmt::format("  = help: {}\n", help);
  return {std::move(text), ExitCode::BadInput};
}

// Takes the command word off the front, if there is one.
std::optional<Answer> take_command(std::vector<std::string>& words,
                                   Options& options) {
  if (words.empty()) return std::nullopt;
  for (const CommandWord& known : kCommands) {
    if (words[0] != known.word) continue;
    options.command = known.command;
    words.erase(words.begin());
    return std::nullopt;
  }
  for (std::string_view later : kLaterCommands) {
    if (words[0] != later) continue;
    return usage_error(
        fmt::format("`btcheck {}` is not in this version", later),
        "this version has: check, space, export, demo");
  }
  return std::nullopt;
}

void add_search_options(CLI::App& app, Options& options, std::string& ticks,
                        std::string& search, std::string& reduce,
                        std::string& memory) {
  app.add_option("--tick", ticks,
                 "where time passes: root, leaves, nodes or none (default: "
                 "what the property file says, else root)")
      ->check(CLI::IsMember({"root", "leaves", "nodes", "none"}));
  app.add_option("--search", search,
                 "bfs: shortest runs; dfs: deep first (default: bfs)")
      ->check(CLI::IsMember({"bfs", "dfs"}));
  app.add_option("--reduce", reduce,
                 "none: every interleaving; the only one in this version");
  app.add_option("--max-states", options.max_states,
                 "stop after about so many states (default: no limit)")
      ->check(CLI::PositiveNumber);
  app.add_option("--memory", memory,
                 "stop at so much memory, e.g. 4G (default: three quarters of "
                 "the machine's)");
  app.add_option("--timeout", options.timeout,
                 "stop after so many seconds (default: never)")
      ->check(CLI::NonNegativeNumber);
}

std::optional<std::uint64_t> bytes_in(const std::string& text) {
  std::size_t digits = 0;
  double number = 0;
  try {
    number = std::stod(text, &digits);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  const std::string unit = text.substr(digits);
  double factor = 1;
  if (unit == "k" || unit == "K")
    factor = 1024;
  else if (unit == "M")
    factor = 1024.0 * 1024;
  else if (unit == "G")
    factor = 1024.0 * 1024 * 1024;
  else if (!unit.empty())
    return std::nullopt;
  if (!(number * factor >= 1) || number * factor > 1e18) return std::nullopt;
  return static_cast<std::uint64_t>(number * factor);
}

// What the words ask for that this version does not have.
std::optional<Answer> refuse_later(const std::string& reduce,
                                   const std::string& profile,
                                   const std::vector<std::string>& assume) {
  if (!reduce.empty() && reduce != "none") {
    return usage_error(
        fmt::format("--reduce {} is not in this version", reduce),
        "leave it out: every interleaving is explored");
  }
  if (!profile.empty() && profile != "paper") {
    return usage_error(
        fmt::format("--profile {} is not in this version", profile),
        "leave it out: .btf trees are checked under `paper`");
  }
  for (const std::string& assumption : assume) {
    if (assumption == "actions-end") continue;
    return usage_error(
        fmt::format("--assume {}: no such assumption", assumption),
        "write --assume actions-end, or an `assume` line in the property file");
  }
  return std::nullopt;
}

std::variant<Options, Answer> parsed(std::vector<std::string> words,
                                     Options options) {
  CLI::App app("btcheck: a model checker for behavior trees", "btcheck");
  app.footer(std::string(kExitCodes));
  std::string ticks, search, reduce, memory, color, profile, format, to;
  std::vector<std::string> assume;
  app.add_option("TREE", options.input,
                 "a .btf tree, or a property file that names its tree");
  app.add_option("--prop", options.properties,
                 "a file of properties; may be given several times")
      ->allow_extra_args(false);
  add_search_options(app, options, ticks, search, reduce, memory);
  app.add_option("--profile", profile, "node semantics: paper (the default)");
  app.add_option("--assume", assume,
                 "actions-end: an action ticked again and again ends again "
                 "and again (default: it may run for ever)")
      ->allow_extra_args(false);
  app.add_option("--format", format, "text (the default)")
      ->check(CLI::IsMember({"text"}));
  app.add_option("--trace-dir", options.trace_dir,
                 "write each run to this directory, as ITF JSON");
  app.add_option("--to", to, "export: dot or promela")
      ->check(CLI::IsMember({"dot", "promela"}));
  app.add_option("--color", color, "auto, always or never (default: auto)")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  app.add_flag("-q", options.is_quiet, "no progress and no statistics");
  app.add_flag("-v", options.is_verbose, "tell every run, step by step");
  app.set_version_flag("--version", "btcheck 0.1.0");
  try {
    std::reverse(words.begin(), words.end());
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    return Answer{app.help(), ExitCode::Met};
  } catch (const CLI::CallForVersion&) {
    return Answer{"btcheck 0.1.0\n", ExitCode::Met};
  } catch (const CLI::ParseError& error) {
    std::string message = error.what();
    if (!message.empty() && message[0] >= 'A' && message[0] <= 'Z') {
      message[0] = static_cast<char>(message[0] - 'A' + 'a');
    }
    return usage_error(message, "btcheck --help lists every option");
  }
  if (auto refused = refuse_later(reduce, profile, assume)) return *refused;
  if (!assume.empty()) options.assume = ExtraAssumption::ActionsEnd;
  if (!ticks.empty()) options.ticks = tick_semantics(ticks);
  if (search == "dfs") options.search = SearchOrder::DepthFirst;
  if (!memory.empty()) {
    auto bytes = bytes_in(memory);
    if (!bytes) {
      return usage_error(fmt::format("--memory {}: not a size", memory),
                         "write for instance 500M or 4G");
    }
    options.max_bytes = *bytes;
  }
  if (color == "always") options.color = When::Always;
  if (color == "never") options.color = When::Never;
  if (options.command == Command::Export && to.empty()) {
    return usage_error("export: no format", "write --to dot or --to promela");
  }
  if (to == "promela") options.format = ExportFormat::Promela;
  if (options.command == Command::Demo &&
      (!options.input.empty() || !options.properties.empty())) {
    return usage_error("demo takes no files", "btcheck TREE.btf checks a tree");
  }
  if (!(options.timeout >= 0)) {
    return usage_error("--timeout: not a number of seconds", "");
  }
  if (options.command != Command::Demo && options.input.empty()) {
    return usage_error("no tree", "btcheck TREE.btf");
  }
  return options;
}

}  // namespace

std::variant<Options, Answer> parse_options(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) return Answer{std::string(kShortHelp), ExitCode::Met};
  Options options;
  if (auto refused = take_command(words, options)) return *refused;
  return parsed(std::move(words), std::move(options));
}

}  // namespace btcheck
