// SPDX-License-Identifier: MIT
//
// What the words of a command line mean, and which do not go together.
#include "cli/options/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <thread>

#include "cli/options/option_help.hpp"
#include "cli/options/option_table.hpp"
#include "cli/options/option_words.hpp"
#include "cli/options/sizes.hpp"

namespace btcheck {
namespace {

using Refusal = std::optional<Answer>;

constexpr std::uint64_t kLeastMemory = std::uint64_t{16} << 20;

// A whole number of that range into `number`, when the option is given.
template <class Number>
Refusal settle_number(const OptionWords& words, std::string_view name,
                      std::uint64_t least, std::uint64_t most, Number& number) {
  if (!words.has(name)) return std::nullopt;
  const std::string word = words.value(name);
  std::uint64_t read = 0;
  const char* end = word.data() + word.size();
  const auto [stop, fault] = std::from_chars(word.data(), end, read);
  if (fault == std::errc() && stop == end && read >= least && read <= most) {
    number = static_cast<Number>(read);
    return std::nullopt;
  }
  return usage_error(
      fmt::format("{} {}: not a number that it takes", name, word),
      most == UINT64_MAX
          ? fmt::format("write a whole number from {} on, below 2^64", least)
          : fmt::format("write a whole number from {} to {}", least, most));
}

Refusal settle_timeout(const OptionWords& words, Options& options) {
  if (!words.has("--timeout")) return std::nullopt;
  const std::string word = words.value("--timeout");
  const char* end = word.data() + word.size();
  const auto [stop, fault] = std::from_chars(word.data(), end, options.timeout);
  if (fault == std::errc() && stop == end && std::isfinite(options.timeout) &&
      options.timeout >= 0) {
    return std::nullopt;
  }
  return usage_error(fmt::format("--timeout {}: not a number of seconds", word),
                     "write for instance 60 or 0.5; 0 is no limit");
}

Refusal settle_memory(const OptionWords& words, Options& options) {
  if (!words.has("--memory")) return std::nullopt;
  const auto bytes = bytes_in(words.value("--memory"));
  if (!bytes) {
    return usage_error(
        fmt::format("--memory {}: not a size", words.value("--memory")),
        "write for instance 500M or 4G");
  }
  if (*bytes < kLeastMemory) {
    return usage_error(
        fmt::format("--memory {}: less than btcheck itself takes",
                    words.value("--memory")),
        "write 16M or more");
  }
  options.max_bytes = *bytes;
  return std::nullopt;
}

// The choice of an option whose choices stand in the order of the enumeration.
template <class Enum>
void settle_choice(const OptionWords& words, std::string_view name,
                   Enum& chosen) {
  if (const auto place = words.choice(name)) {
    chosen = static_cast<Enum>(*place);
  }
}

unsigned core_count() {
  return std::clamp(std::thread::hardware_concurrency(), 1u, kMostThreads);
}

// How the words are meant that a search is told.
Refusal settle_search(const OptionWords& words, Options& options) {
  if (words.has("--assume")) options.assume = ExtraAssumption::ActionsEnd;
  options.ticks = tick_semantics(words.value("--tick"));
  settle_choice(words, "--search", options.search);
  settle_choice(words, "--store", options.store);
  if (options.command == Command::Space) options.reduce = Reduction::None;
  if (words.has("--reduce")) {
    options.reduce = *reduction_named(words.value("--reduce"));
  }
  options.threads = core_count();
  options.scratch_dir = words.value("--on-disk");
  if (auto refused =
          settle_number(words, "--threads", 1, kMostThreads, options.threads)) {
    return refused;
  }
  if (auto refused = settle_number(words, "--max-states", 1, UINT64_MAX,
                                   options.max_states)) {
    return refused;
  }
  if (auto refused = settle_timeout(words, options)) return refused;
  if (auto refused = settle_memory(words, options)) return refused;
  if (words.has("--on-disk") && options.search == SearchOrder::DepthFirst) {
    return usage_error("--on-disk needs --search bfs",
                       "a depth-first search keeps its states in memory");
  }
  return std::nullopt;
}

// How trees are read.
Refusal settle_trees(const OptionWords& words, Options& options) {
  constexpr int kMostMilliseconds = 3'600'000;
  if (words.has("--profile")) {
    options.profile = profile_named(words.value("--profile"));
  }
  options.models = words.all("--models");
  options.leaves = words.all("--leaves");
  options.loops = words.has("--loop");
  options.wakes = words.has("--wake-ups");
  options.main_tree = words.value("--main-tree");
  return settle_number(words, "--tick-ms", 1, kMostMilliseconds,
                       options.tick_ms);
}

// What results are told in.
Refusal settle_reports(const OptionWords& words, Options& options) {
  options.trace_dir = words.value("--trace-dir");
  settle_choice(words, "--stats", options.statistics);
  if (!words.has("--format")) return std::nullopt;
  const OptionRow& format = *option_of(options.command, "--format");
  const std::vector<std::string> choices = choices_of(format);
  for (const std::string& word : words.all("--format")) {
    const std::string name = word.substr(0, word.find('='));
    if (std::find(choices.begin(), choices.end(), name) != choices.end()) {
      continue;
    }
    return usage_error(
        fmt::format("{}--format {}: no such format", spoken_of(options.command),
                    word),
        fmt::format("write {}, or FORMAT=FILE", listed(choices, "or")));
  }
  auto targets = report_targets(words.all("--format"));
  if (const auto* complaint = std::get_if<TargetComplaint>(&targets)) {
    return usage_error(complaint->message, complaint->help);
  }
  options.reports = std::get<std::vector<ReportTarget>>(std::move(targets));
  return std::nullopt;
}

// Where the graph of a space goes: "aut", "dot=FILE".
Refusal settle_graph(const OptionWords& words, Options& options) {
  if (!words.has("--export")) return std::nullopt;
  const std::string word = words.value("--export");
  const std::size_t sign = word.find('=');
  const std::string format = word.substr(0, sign);
  if (sign != word.npos) options.graph_file = word.substr(sign + 1);
  if ((format != "aut" && format != "dot") ||
      (sign != word.npos && options.graph_file.empty())) {
    return usage_error(fmt::format("--export {}: no such graph", word),
                       "write aut, dot, aut=FILE or dot=FILE");
  }
  options.graph = format == "aut" ? GraphFormat::Aldebaran : GraphFormat::Dot;
  return std::nullopt;
}

// What an export or a run is written as.
Refusal settle_formats(const OptionWords& words, Options& options) {
  if (options.command == Command::Export) {
    settle_choice(words, "--to", options.format);
  } else {
    settle_choice(words, "--to", options.trace_format);
  }
  options.output = words.value("-o");
  int tick = 0;
  if (auto refused = settle_number(words, "--at", 0, INT32_MAX, tick)) {
    return refused;
  }
  if (words.has("--at")) options.trace_tick = tick;
  return settle_graph(words, options);
}

// A simulation, and what does not go together in one.
Refusal settle_simulation(const OptionWords& words, Options& options) {
  options.script = words.value("--script");
  std::uint64_t seed = 0;
  int ticks = 0;
  if (auto refused = settle_number(words, "--seed", 0, UINT64_MAX, seed)) {
    return refused;
  }
  if (auto refused = settle_number(words, "--ticks", 1, 1'000'000'000, ticks)) {
    return refused;
  }
  if (words.has("--seed")) options.seed = seed;
  if (words.has("--ticks")) options.simulated_ticks = ticks;
  if (options.command != Command::Simulate) return std::nullopt;
  const bool is_asked_of_one = options.seed || !options.script.empty();
  if (options.seed && !options.script.empty()) {
    return usage_error("a run is either random or scripted",
                       "leave out --seed or --script");
  }
  if (options.simulated_ticks && !is_asked_of_one) {
    return usage_error("--ticks needs --seed or --script",
                       "step by hand as long as you like; t goes on to the "
                       "next tick");
  }
  if (!options.output.empty() && !is_asked_of_one) {
    return usage_error("-o needs --seed or --script",
                       "type s FILE while you step by hand");
  }
  return std::nullopt;
}

// How the entries of a batch are shared out; before the threads are.
Refusal settle_batch(const OptionWords& words, Options& options) {
  if (options.command != Command::Batch) return std::nullopt;
  BatchOptions& batch = options.batch;
  batch.sources = options.inputs;
  batch.jobs = core_count();
  if (auto refused =
          settle_number(words, "--jobs", 1, kMostThreads, batch.jobs)) {
    return refused;
  }
  if (!words.has("--threads")) {
    options.threads = std::max(1u, core_count() / batch.jobs);
  }
  batch.stops_early = words.has("--fail-fast");
  batch.resumes = words.has("--resume");
  batch.page = words.value("--report");
  if (!words.has("--shard")) return std::nullopt;
  const std::string word = words.value("--shard");
  const auto shard = shard_of(word);
  if (!shard) {
    return usage_error(fmt::format("--shard {}: not a part", word),
                       "write for instance 1/4, the first of four");
  }
  batch.shard = *shard;
  return std::nullopt;
}

// What a command cannot do without.
Refusal refuse_missing(const OptionWords& words) {
  const CommandRow& command = row_of(words.command);
  if (words.inputs.empty() && !command.missing.empty()) {
    return usage_error(command.missing, command.example);
  }
  for (const OptionRow& option : option_rows()) {
    if (!option.is_required || !option.commands.contains(words.command) ||
        words.has(option.name)) {
      continue;
    }
    const std::vector<std::string> choices = choices_of(option);
    return usage_error(fmt::format("{}: no format", command.word),
                       fmt::format("write {} {}{}", option.name,
                                   choices.size() > 4 ? "and one of: " : "",
                                   listed(choices, "or")));
  }
  return std::nullopt;
}

std::variant<Options, Answer> meant(const OptionWords& words) {
  if (words.has("--help")) {
    return Answer{words.names_command ? help_text(words.command) : help_text(),
                  ExitCode::Met};
  }
  if (words.has("--version")) return Answer{version_text(), ExitCode::Met};
  Options options;
  options.command = words.command;
  options.inputs = words.inputs;
  if (!words.inputs.empty()) options.input = words.inputs[0];
  options.properties = words.all("--prop");
  options.is_quiet = words.has("-q");
  options.is_verbose = words.has("-v");
  settle_choice(words, "--color", options.color);
  for (const auto settle : {settle_search, settle_trees, settle_reports,
                            settle_formats, settle_simulation, settle_batch}) {
    if (auto refused = settle(words, options)) return *refused;
  }
  if (auto refused = refuse_missing(words)) return *refused;
  return options;
}

}  // namespace

std::variant<Options, Answer> parse_options(int argc, const char* const* argv) {
  std::vector<std::string> line(argv + 1, argv + argc);
  if (line.empty()) return Answer{short_help(), ExitCode::Met};
  const auto words = sorted_words(std::move(line));
  if (const auto* refused = std::get_if<Answer>(&words)) return *refused;
  return meant(std::get<OptionWords>(words));
}

}  // namespace btcheck
