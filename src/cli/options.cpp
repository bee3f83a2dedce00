// SPDX-License-Identifier: MIT
//
// CLI11 reads the words; what they mean, and which belong to a later release,
// is said here. `btcheck TREE` is the default command, so the first word
// decides: it names a command, or it is the tree.
#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <thread>

#include "cli/sizes.hpp"
#include "cli/version.hpp"
#include "diagnostic.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kShortHelp =
    R"(btcheck: a model checker for behavior trees

  btcheck TREE.btf                     what each node can and cannot do
  btcheck TREE.btf --prop RULES.ltl    check rules; show runs that break them
  btcheck batch FOLDER                 check all trees and rules in a folder
  btcheck space TREE.btf               build and measure the state space
  btcheck export TREE.btf --to dot     draw it; models: promela, smv, fiacre
  btcheck trace RUN.itf.json --to svg  a run that was kept, as a picture or log
  btcheck simulate TREE.btf            step through it; --seed, --script: a run
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

constexpr std::array<std::string_view, 1> kLaterCommands = {"lint"};

struct CommandWord {
  std::string_view word;
  Command command;
};
constexpr std::array<CommandWord, 7> kCommands = {
    {{"check", Command::Check},
     {"space", Command::Space},
     {"export", Command::Export},
     {"trace", Command::Trace},
     {"simulate", Command::Simulate},
     {"demo", Command::Demo},
     {"batch", Command::Batch}}};

struct TraceFormatWord {
  std::string_view word;
  TraceFormat format;
};
constexpr std::array<TraceFormatWord, 12> kTraceFormats = {
    {{"text", TraceFormat::Text},
     {"html", TraceFormat::Html},
     {"itf", TraceFormat::Itf},
     {"svg", TraceFormat::Svg},
     {"strip", TraceFormat::Strip},
     {"dot", TraceFormat::Dot},
     {"mermaid", TraceFormat::Mermaid},
     {"btlog", TraceFormat::Btlog},
     {"chrome", TraceFormat::Chrome},
     {"chrome-stack", TraceFormat::ChromeStack},
     {"mcap", TraceFormat::Mcap},
     {"substitution", TraceFormat::Substitution}}};

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
        "this version has: check, batch, space, export, trace, simulate, demo");
  }
  return std::nullopt;
}

// Options whose words are looked at once all are known.
struct Words {
  std::string ticks;
  std::string search;
  std::string reduce;
  std::string store;
  std::string memory;
  std::string color;
  std::string profile;
  std::vector<std::string> formats;
  std::string statistics;
  std::string to;
  std::string graph;
  std::vector<std::string> assume;
  unsigned jobs = 0;  // 0: not said
  std::string shard;
};

void add_search_options(CLI::App& app, Options& options, Words& words) {
  app.add_option("--tick", words.ticks,
                 "where time passes: root, leaves, nodes or none (default: "
                 "what the property file says, else root)")
      ->check(CLI::IsMember({"root", "leaves", "nodes", "none"}));
  app.add_option("--search", words.search,
                 "bfs: shortest runs; dfs: deep first (default: bfs)")
      ->check(CLI::IsMember({"bfs", "dfs"}));
  app.add_option("--reduce", words.reduce,
                 "none: every interleaving and every value; live: values "
                 "nothing reads any more are one; full: and independent steps "
                 "are not interleaved (default: full; space: none)")
      ->check(CLI::IsMember({"none", "live", "full"}));
  app.add_option("--threads", options.threads,
                 "how many search at a time (default: one for each core)")
      ->check(CLI::Range(1u, kMostThreads));
  app.add_option("--store", words.store,
                 "exact: states as pairs of halves; compressed: the same in "
                 "half the memory (default: compressed)")
      ->check(CLI::IsMember({"exact", "compressed"}));
  app.add_option("--max-states", options.max_states,
                 "stop after about so many states (default: no limit)")
      ->check(CLI::PositiveNumber);
  app.add_option("--memory", words.memory,
                 "stop at so much memory, e.g. 4G (default: three quarters of "
                 "the machine's)");
  app.add_option("--on-disk", options.scratch_dir,
                 "at the limit of --memory, go on in this directory: space, "
                 "and rules about single states (default: stop there)");
  app.add_option("--timeout", options.timeout,
                 "stop after so many seconds (default: never)")
      ->check(CLI::NonNegativeNumber);
}

// What the words ask for that this version does not have.
std::optional<Answer> refuse_later(const Words& words) {
  if (!words.profile.empty() && words.profile != "paper") {
    return usage_error(
        fmt::format("--profile {} is not in this version", words.profile),
        "leave it out: .btf trees are checked under `paper`");
  }
  for (const std::string& assumption : words.assume) {
    if (assumption == "actions-end") continue;
    return usage_error(
        fmt::format("--assume {}: no such assumption", assumption),
        "write --assume actions-end, or an `assume` line in the property file");
  }
  return std::nullopt;
}

std::string version_text() { return fmt::format("btcheck {}", kVersion); }

void add_simulation_options(CLI::App& app, Options& options) {
  const auto is_seed = [](const std::string& text) -> std::string {
    return text.starts_with('-') ? "a seed is a number from 0 on" : "";
  };
  app.add_option("--seed", options.seed,
                 "simulate: a random run, the same for the same number "
                 "(default: stepping by hand)")
      ->check(is_seed);
  app.add_option("--script", options.script,
                 "simulate: the run in which the leaves answer what this file "
                 "says");
  app.add_option("--ticks", options.simulated_ticks,
                 "simulate: stop such a run after so many ticks (default: 100)")
      ->check(CLI::Range(1, 1'000'000'000));
}

void add_batch_options(CLI::App& app, BatchOptions& batch, Words& words) {
  app.add_option("--jobs", words.jobs,
                 "batch: how many entries are checked at a time (default: one "
                 "for each core)")
      ->check(CLI::Range(1u, kMostThreads));
  app.add_option("--shard", words.shard,
                 "batch: i/n, the i-th of n parts (default: all of it)");
  app.add_flag("--fail-fast", batch.stops_early,
               "batch: stop at the first entry that is not as expected");
  app.add_flag("--resume", batch.resumes,
               "batch: take results of an earlier run where nothing has "
               "changed");
  app.add_option("--report", batch.page,
                 "batch: write the results to this file, as an HTML page");
}

void add_options(CLI::App& app, Options& options, Words& words) {
  if (options.command == Command::Batch) {
    app.add_option("DIR|MANIFEST", options.batch.sources,
                   "folders with trees and property files, manifests (.toml)");
  } else {
    app.add_option("TREE", options.input,
                   "a .btf tree, or a property file that names its tree");
  }
  app.add_option("--prop", options.properties,
                 "a file of properties; may be given several times")
      ->allow_extra_args(false);
  add_search_options(app, options, words);
  app.add_option("--profile", words.profile,
                 "node semantics: paper (the default)");
  app.add_option("--assume", words.assume,
                 "actions-end: an action ticked again and again ends again "
                 "and again (default: it may run for ever)")
      ->allow_extra_args(false);
  app.add_option(
         "--format", words.formats,
         "check: text, json, jsonl, sarif, junit or github; FORMAT=FILE "
         "writes a file; may be given several times (default: text)")
      ->allow_extra_args(false);
  app.add_option("--stats", words.statistics,
                 "space: json for one JSON object (default: a table)")
      ->check(CLI::IsMember({"table", "json"}));
  app.add_option("--trace-dir", options.trace_dir,
                 "write each run to this directory, as ITF JSON");
  app.add_option("--to", words.to,
                 "export: dot, promela, smv or fiacre; with --prop the "
                 "properties as well. trace: text, html, itf, svg, strip, dot, "
                 "mermaid, btlog, chrome, chrome-stack, mcap or substitution");
  app.add_option("-o", options.output,
                 "trace: the file to write (default: standard output). "
                 "simulate: keep the run here, as ITF JSON");
  app.add_option("--at", options.trace_tick,
                 "trace: the tick that svg, dot and mermaid draw (default: the "
                 "last)")
      ->check(CLI::NonNegativeNumber);
  add_simulation_options(app, options);
  add_batch_options(app, options.batch, words);
  app.add_option("--export", words.graph,
                 "space: aut or dot, the states and steps of a small space; "
                 "aut=FILE writes them to a file");
  app.add_option("--color", words.color,
                 "auto, always or never (default: auto)")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  app.add_flag("-q", options.is_quiet, "no progress and no statistics");
  app.add_flag("-v", options.is_verbose, "tell every run, step by step");
  app.set_version_flag("--version", version_text());
}

// How the words are meant that a search is told.
std::optional<Answer> settle_search(const Words& words, Options& options) {
  if (!words.assume.empty()) options.assume = ExtraAssumption::ActionsEnd;
  if (!words.ticks.empty()) options.ticks = tick_semantics(words.ticks);
  if (words.search == "dfs") options.search = SearchOrder::DepthFirst;
  if (options.command == Command::Space) options.reduce = Reduction::None;
  if (!words.reduce.empty()) options.reduce = *reduction_named(words.reduce);
  if (words.store == "exact") options.store = StateSetKind::Exact;
  if (words.statistics == "json") options.statistics = StatisticsFormat::Json;
  if (words.memory.empty()) return std::nullopt;
  const auto bytes = bytes_in(words.memory);
  if (!bytes) {
    return usage_error(fmt::format("--memory {}: not a size", words.memory),
                       "write for instance 500M or 4G");
  }
  options.max_bytes = *bytes;
  return std::nullopt;
}

// How the entries of a batch are shared out, and what only a batch is told.
std::optional<Answer> settle_batch(const Words& words, Options& options) {
  BatchOptions& batch = options.batch;
  const bool is_told = words.jobs > 0 || !words.shard.empty() ||
                       batch.stops_early || batch.resumes ||
                       !batch.page.empty();
  const unsigned cores =
      std::clamp(std::thread::hardware_concurrency(), 1u, kMostThreads);
  if (options.command != Command::Batch) {
    if (options.threads == 0) options.threads = cores;
    if (!is_told) return std::nullopt;
    return usage_error(
        "--jobs, --shard, --fail-fast, --resume and --report belong to batch",
        "btcheck batch FOLDER --jobs 4");
  }
  batch.jobs = words.jobs > 0 ? words.jobs : cores;
  if (options.threads == 0) options.threads = std::max(1u, cores / batch.jobs);
  if (!options.properties.empty()) {
    return usage_error("batch takes no --prop",
                       "property files are found by name, or named in a "
                       "manifest: docs/batch.md");
  }
  if (words.shard.empty()) return std::nullopt;
  const auto shard = shard_of(words.shard);
  if (!shard) {
    return usage_error(fmt::format("--shard {}: not a part", words.shard),
                       "write for instance 1/4, the first of four");
  }
  batch.shard = *shard;
  return std::nullopt;
}

// What results are told in.
std::optional<Answer> settle_reports(const Words& words, Options& options) {
  auto targets = report_targets(words.formats);
  if (const auto* complaint = std::get_if<TargetComplaint>(&targets)) {
    return usage_error(complaint->message, complaint->help);
  }
  const bool has_plain_text = words.formats == std::vector<std::string>{"text"};
  if (options.command != Command::Check && options.command != Command::Batch &&
      !words.formats.empty() && !has_plain_text) {
    return usage_error("--format belongs to `btcheck check` and `batch`",
                       "btcheck TREE.btf --format json");
  }
  options.reports = std::get<std::vector<ReportTarget>>(std::move(targets));
  return std::nullopt;
}

// What is exported, and where to.
std::optional<Answer> settle_export(const Words& words, Options& options) {
  if (words.to == "promela") {
    options.format = ExportFormat::Promela;
  } else if (words.to == "smv") {
    options.format = ExportFormat::Smv;
  } else if (words.to == "fiacre") {
    options.format = ExportFormat::Fiacre;
  } else if (options.command == Command::Export && words.to != "dot") {
    return usage_error(
        words.to.empty()
            ? "export: no format"
            : fmt::format("export --to {}: no such format", words.to),
        "write --to dot, promela, smv or fiacre");
  }
  if (words.graph.empty()) return std::nullopt;
  if (options.command != Command::Space) {
    return usage_error("--export belongs to `btcheck space`",
                       "btcheck space TREE.btf --export aut");
  }
  const std::size_t sign = words.graph.find('=');
  const std::string format = words.graph.substr(0, sign);
  if (sign != words.graph.npos)
    options.graph_file = words.graph.substr(sign + 1);
  if ((format != "aut" && format != "dot") ||
      (sign != words.graph.npos && options.graph_file.empty())) {
    return usage_error(fmt::format("--export {}: no such graph", words.graph),
                       "write aut, dot, aut=FILE or dot=FILE");
  }
  options.graph = format == "aut" ? GraphFormat::Aldebaran : GraphFormat::Dot;
  return std::nullopt;
}

// What a run is converted to.
std::optional<Answer> settle_trace(const Words& words, Options& options) {
  if (options.command != Command::Trace) return std::nullopt;
  for (const TraceFormatWord& known : kTraceFormats) {
    if (known.word != words.to) continue;
    options.trace_format = known.format;
    return std::nullopt;
  }
  std::string formats;
  for (const TraceFormatWord& known : kTraceFormats) {
    formats += fmt::format("{}{}", formats.empty() ? "" : ", ", known.word);
  }
  return usage_error(
      words.to.empty() ? std::string("trace: no format")
                       : fmt::format("trace --to {}: no such format", words.to),
      "write --to and one of: " + formats);
}

// What does not go together in a simulation, or belongs to one.
std::optional<Answer> refuse_simulation(const Options& options) {
  const bool is_asked_of_one = options.seed || !options.script.empty();
  if (options.command != Command::Simulate) {
    if (!is_asked_of_one && !options.simulated_ticks) return std::nullopt;
    return usage_error("--seed, --script and --ticks belong to simulate",
                       "btcheck simulate TREE.btf --seed 7");
  }
  if (options.seed && !options.script.empty()) {
    return usage_error("a run is either random or scripted",
                       "leave out --seed or --script");
  }
  if (!options.properties.empty()) {
    return usage_error("simulate takes no properties",
                       "btcheck TREE.btf --prop RULES.ltl checks them");
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

// What does not go together.
std::optional<Answer> refuse_mismatch(const Words& words,
                                      const Options& options) {
  if (!words.statistics.empty() && options.command != Command::Space) {
    return usage_error("--stats belongs to `btcheck space`",
                       "btcheck space TREE.btf --stats json");
  }
  if (options.command == Command::Demo &&
      (!options.input.empty() || !options.properties.empty())) {
    return usage_error("demo takes no files", "btcheck TREE.btf checks a tree");
  }
  if (!options.scratch_dir.empty() &&
      options.search == SearchOrder::DepthFirst) {
    return usage_error("--on-disk needs --search bfs",
                       "a depth-first search keeps its states in memory");
  }
  if (!(options.timeout >= 0)) {
    return usage_error("--timeout: not a number of seconds", "");
  }
  if (options.command == Command::Batch) {
    if (!options.batch.sources.empty()) return std::nullopt;
    return usage_error("no folder and no manifest", "btcheck batch FOLDER");
  }
  if (options.command != Command::Demo && options.input.empty()) {
    return options.command == Command::Trace
               ? usage_error("no file", "btcheck trace RUN.itf.json --to html")
               : usage_error("no tree", "btcheck TREE.btf");
  }
  return std::nullopt;
}

std::variant<Options, Answer> parsed(std::vector<std::string> line,
                                     Options options) {
  CLI::App app("btcheck: a model checker for behavior trees", "btcheck");
  app.footer(std::string(kExitCodes));
  Words words;
  options.threads = 0;  // not said
  add_options(app, options, words);
  try {
    std::reverse(line.begin(), line.end());
    app.parse(line);
  } catch (const CLI::CallForHelp&) {
    return Answer{app.help(), ExitCode::Met};
  } catch (const CLI::CallForVersion&) {
    return Answer{version_text() + "\n", ExitCode::Met};
  } catch (const CLI::ParseError& error) {
    std::string message = error.what();
    if (!message.empty() && message[0] >= 'A' && message[0] <= 'Z') {
      message[0] = static_cast<char>(message[0] - 'A' + 'a');
    }
    return usage_error(message, "btcheck --help lists every option");
  }
  if (auto refused = refuse_later(words)) return *refused;
  if (auto refused = settle_search(words, options)) return *refused;
  if (auto refused = refuse_mismatch(words, options)) return *refused;
  if (auto refused = settle_batch(words, options)) return *refused;
  if (auto refused = refuse_simulation(options)) return *refused;
  if (words.color == "always") options.color = When::Always;
  if (words.color == "never") options.color = When::Never;
  if (auto refused = settle_reports(words, options)) return *refused;
  if (auto refused = settle_export(words, options)) return *refused;
  if (auto refused = settle_trace(words, options)) return *refused;
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
