// SPDX-License-Identifier: MIT
//
// What the words of a command line mean, and which do not go together. What is
// refused is thrown as a Refusal.
#include "cli/options/options.hpp"
#include "report/codes/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <thread>

#include "cli/options/roots.hpp"
#include "cli/options/tables.hpp"
#include "cli/options/words.hpp"
#include "model/tree_file.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// A whole number of that range into `number`, when the option is given.
template <class Number>
void settle_number(const OptionWords& words, std::string_view name,
                   std::uint64_t least, std::uint64_t most, Number& number) {
  if (!words.has(name)) return;
  const std::string word = words.value(name);
  const auto read = whole_number(word);
  if (!read || *read < least || *read > most) {
    refuse(
        fmt::format("{} {}: not a number that it takes", name, word),
        most == UINT64_MAX
            ? fmt::format("write a whole number from {} on, below 2^64", least)
            : fmt::format("write a whole number from {} to {}", least, most));
  }
  number = static_cast<Number>(*read);
}

// A number of seconds into `seconds`, when the option is given.
void settle_seconds(const OptionWords& words, std::string_view name,
                    std::string_view hint, double& seconds) {
  if (!words.has(name)) return;
  const std::string word = words.value(name);
  const char* end = word.data() + word.size();
  const auto [stop, fault] = std::from_chars(word.data(), end, seconds);
  if (fault != std::errc() || stop != end || !std::isfinite(seconds) ||
      seconds < 0) {
    refuse(fmt::format("{} {}: not a number of seconds", name, word),
           std::string(hint));
  }
}

void settle_memory(const OptionWords& words, Options& options) {
  constexpr std::uint64_t kLeastMemory = std::uint64_t{16} << 20;
  if (!words.has("--memory")) return;
  const std::string word = words.value("--memory");
  const auto bytes = bytes_in(word);
  if (!bytes) {
    refuse(fmt::format("--memory {}: not a size", word),
           "write for instance 500M or 4G");
  }
  if (*bytes < kLeastMemory) {
    refuse(fmt::format("--memory {}: less than btcheck itself takes", word),
           "write 16M or more");
  }
  options.max_bytes = *bytes;
}

// The choice of an option whose choices stand in the order of the enumeration.
template <class Enum>
void settle_choice(const OptionWords& words, std::string_view name,
                   Enum& chosen) {
  if (const auto place = words.choice(name)) {
    chosen = static_cast<Enum>(*place);
  }
}
template <class Enum>
void settle_choice(const OptionWords& words, std::string_view name,
                   std::optional<Enum>& chosen) {
  if (words.has(name)) settle_choice(words, name, chosen.emplace());
}

// The last two choices of `space` are no reductions of its search: they say
// which of the states that it finds count as one.
void settle_reduction(const OptionWords& words, Options& options) {
  if (options.command != Command::Space) {
    settle_choice(words, "--reduce", options.reduce);
    return;
  }
  options.reduce = Reduction::None;
  const std::string word = words.value("--reduce");
  if (word == "bisimulation") {
    options.modulo = Equivalence::Branching;
  } else if (word == "strong") {
    options.modulo = Equivalence::Strong;
  } else {
    settle_choice(words, "--reduce", options.reduce);
  }
  settle_choice(words, "--observe", options.seen);
  if (words.has("--observe") && !options.modulo &&
      (!words.has("--export") || options.reduce != Reduction::None)) {
    refuse("--observe needs --reduce bisimulation, or --export of all steps",
           "it says which answers are seen of a quotient, or of a graph");
  }
}

void settle_search(const OptionWords& words, Options& options) {
  if (words.has("--assume")) options.assume = ExtraAssumption::ActionsEnd;
  settle_choice(words, "--tick", options.ticks);
  settle_choice(words, "--search", options.search);
  settle_choice(words, "--store", options.store);
  settle_reduction(words, options);
  options.threads = core_count();
  options.scratch_dir = words.value("--on-disk");
  options.cache_dir = words.value("--cache");
  settle_number(words, "--threads", 1, kMostThreads, options.threads);
  settle_number(words, "--max-states", 1, UINT64_MAX, options.max_states);
  settle_seconds(words, "--timeout",
                 "write for instance 60 or 0.5; 0 is no limit",
                 options.timeout);
  settle_memory(words, options);
  if (words.has("--on-disk") && options.search == SearchOrder::DepthFirst) {
    refuse("--on-disk needs --search bfs",
           "a depth-first search keeps its states in memory");
  }
}

constexpr int kMostMilliseconds = 3'600'000;

// How trees are read.
void settle_trees(const OptionWords& words, Options& options) {
  settle_choice(words, "--profile", options.profile);
  options.models = words.all("--models");
  options.leaves = words.all("--leaves");
  options.loops = words.has("--loop");
  options.wakes = words.has("--wake-ups");
  options.main_tree = words.value("--main-tree");
  options.settings = words.value("--config");
  options.ignores_settings = words.has("--no-config");
  for (const auto& [name, values] : words.values) options.given.emplace(name);
  if (words.has("--config") && options.ignores_settings) {
    refuse("--config and --no-config do not go together",
           "leave out one of them");
  }
  settle_number(words, "--tick-ms", 1, kMostMilliseconds, options.tick_ms);
}

// "json", "dot=FILE": the place of the word among all choices of such an
// option, and the file; nothing for a word that is neither.
struct Target {
  std::size_t choice = 0;
  std::string file;  // "" for standard output
};
std::optional<Target> target_of(const std::string& word,
                                const std::vector<std::string>& choices) {
  const std::size_t sign = word.find('=');
  if (sign + 1 == word.size()) return std::nullopt;
  const auto found =
      std::find(choices.begin(), choices.end(), word.substr(0, sign));
  if (found == choices.end()) return std::nullopt;
  return Target{static_cast<std::size_t>(found - choices.begin()),
                sign == word.npos ? "" : word.substr(sign + 1)};
}

// What --format asks for, by the choices of Check or of the command itself.
// Standard output belongs to one format, and so does each file. Text, the first
// choice, goes to standard output unless another format does.
std::vector<Target> targets_of(const OptionWords& words, Command of) {
  std::vector<Target> targets;
  const auto find = [&](const std::string& file) {
    return std::ranges::find(targets, file, &Target::file);
  };
  for (const std::string& word : words.all("--format")) {
    const auto own = choices_of(*option_of(words.command, "--format"));
    const auto all = choices_of(*option_of(of, "--format"));
    const auto target = target_of(word, all);
    if (!target || std::ranges::count(own, all[target->choice]) == 0) {
      refuse(fmt::format("{}--format {}: no such format",
                         spoken_of(words.command), word),
             fmt::format("write {}, or FORMAT=FILE", listed(own, "or")));
    }
    if (find(target->file) != targets.end()) {
      refuse(target->file.empty()
                 ? "two formats on standard output"
                 : fmt::format("two formats in the file `{}`", target->file),
             fmt::format("give one of them a file: --format {}=FILE",
                         word.substr(0, word.find('='))));
    }
    targets.push_back(*target);
  }
  if (find("") == targets.end()) targets.insert(targets.begin(), Target{});
  return targets;
}

void settle_judgement(const OptionWords& words, Options& options) {
  options.judgement.denied = words.all("--deny");
  options.baseline = words.value("--baseline");
  options.new_baseline = words.value("--write-baseline");
  for (const std::string& word : options.judgement.denied) {
    const CodeRow* row = code_named(word);
    if (word == kWarnings || (row != nullptr && has_level(*row))) continue;
    const Objection objection = objection_to(word);
    refuse(fmt::format("--deny {}: {}", word, objection.message),
           objection.help);
  }
}

void settle_reports(const OptionWords& words, Options& options) {
  options.trace_dir = words.value("--trace-dir");
  options.tries_repairs = !words.has("--no-repairs");
  options.any_count = words.has("--any-count");
  settle_choice(words, "--stats", options.statistics);
  if (options.command == Command::WhatIf) {
    options.faults.outputs.clear();
    for (const Target& target : targets_of(words, Command::WhatIf)) {
      options.faults.outputs.push_back(
          {static_cast<FaultFormat>(target.choice), target.file});
    }
    return;
  }
  if (options.command == Command::Diff) {
    options.diff.outputs.clear();
    for (const Target& target : targets_of(words, Command::Diff)) {
      options.diff.outputs.push_back(
          {static_cast<DiffFormat>(target.choice), target.file});
    }
    return;
  }
  options.reports.clear();
  for (const Target& target : targets_of(words, Command::Check)) {
    options.reports.push_back(
        {static_cast<ReportFormat>(target.choice), target.file});
  }
}

// Where the graph of a space goes: "aut", "dot=FILE".
void settle_graph(const OptionWords& words, Options& options) {
  if (!words.has("--export")) return;
  const std::string word = words.value("--export");
  const auto target =
      target_of(word, choices_of(*option_of(Command::Space, "--export")));
  if (!target) {
    refuse(fmt::format("--export {}: no such graph", word),
           "write aut, dot, aut=FILE or dot=FILE");
  }
  options.graph = static_cast<GraphFormat>(target->choice);
  options.graph_file = target->file;
}

// Where tests are written to, and how.
void settle_tests(const OptionWords& words, Options& options) {
  const auto forms = choices_of(*option_of(Command::Tests, "--to"));
  for (const std::string& word : words.all("--to")) {
    const auto form = std::find(forms.begin(), forms.end(), word);
    if (form == forms.end()) {
      refuse(fmt::format("--to {}: no such format", word),
             fmt::format("write {}", listed(forms, "or")));
    }
    options.tests.forms.insert(static_cast<TestForm>(form - forms.begin()));
  }
  options.tests.forces = words.has("--force");
  if (words.value("-o").empty()) {
    refuse("tests: no folder to write into", "btcheck tests TREE -o DIRECTORY");
  }
}

// What an export or a run is written as.
void settle_formats(const OptionWords& words, Options& options) {
  if (options.command == Command::Export) {
    settle_choice(words, "--to", options.format);
  } else if (options.command == Command::Leaves) {
    settle_choice(words, "--to", options.leaf_form);
  } else if (options.command == Command::Tests) {
    settle_tests(words, options);
  } else {
    settle_choice(words, "--to", options.trace.format);
  }
  options.output = words.value("-o");
  settle_number(words, "--at", 0, INT32_MAX, options.trace.tick);
  options.trace.tree = words.value("--tree");
  settle_graph(words, options);
}

// A simulation, and what does not go together in one.
void settle_simulation(const OptionWords& words, Options& options) {
  SimulationPlan& plan = options.simulation;
  plan.script = words.value("--script");
  settle_number(words, "--seed", 0, UINT64_MAX, plan.seed);
  settle_number(words, "--ticks", 1, 1'000'000'000, plan.ticks);
  if (options.command != Command::Simulate) return;
  if (plan.seed && !plan.script.empty()) {
    refuse("a run is either random or scripted",
           "leave out --seed or --script");
  }
  if (plan.seed || !plan.script.empty()) return;
  if (words.has("--ticks")) {
    refuse("--ticks needs --seed or --script",
           "step by hand as long as you like; t goes on to the next tick");
  }
  if (!options.output.empty()) {
    refuse("-o needs --seed or --script", "type s FILE while you step by hand");
  }
}

// Who answers for the leaves of a tree that is run.
void settle_run(const OptionWords& words, Options& options) {
  if (options.command != Command::Run) return;
  ExecutionPlan& plan = options.run;
  SimulationPlan& simulated = options.simulation;
  plan.leaves = words.value("--leaves-exec");
  plan.is_at_once = words.has("--no-wait");
  plan.btlog = words.value("--btlog");
  settle_choice(words, "--on-breach", plan.on_breach);
  settle_number(words, "--answer-ms", 1, kMostMilliseconds, plan.answer_ms);
  if (!words.has("--ticks")) simulated.ticks = 0;
  const bool has_process = words.has("--leaves-exec");
  if (has_process && plan.leaves.empty()) {
    refuse("--leaves-exec needs a command",
           "write for instance --leaves-exec 'python3 leaves.py'");
  }
  if (!simulated.script.empty() && (has_process || simulated.seed)) {
    refuse("leaves answer by a script, at random or by a process",
           "leave out --script, or the others");
  }
  if (simulated.script.empty() && !has_process && !simulated.seed) {
    refuse("run: nobody answers for the leaves",
           "write --leaves-exec COMMAND, --script FILE or --seed NUMBER");
  }
  if (words.has("--answer-ms") && !has_process) {
    refuse("--answer-ms needs --leaves-exec",
           "a script and chance answer at once");
  }
  if (words.has("--on-breach") && !has_process && simulated.script.empty()) {
    refuse("--on-breach needs --leaves-exec or --script",
           "chance answers what the model allows");
  }
  if (!plan.btlog.empty() && plan.btlog == options.output) {
    refuse("-o and --btlog name the same file", "give each a file of its own");
  }
}

// Where a run is shown while it goes on.
void settle_view(const OptionWords& words, Options& options) {
  if (!words.has("--view")) return;
  options.view = 0;
  if (words.value("--view").empty()) return;
  settle_number(words, "--view", 0, UINT16_MAX, *options.view);
}

void settle_formatting(const OptionWords& words, Options& options) {
  FormattingPlan& plan = options.formatting;
  plan.checks = words.has("--check");
  plan.shows = words.has("--diff");
  plan.verifies = words.has("--verify");
  plan.stdin_name = words.value("--stdin-name");
  if (words.has("--stdin-name") && options.input != kStandardInput) {
    refuse("--stdin-name goes with `-`",
           "btcheck fmt - --stdin-name TREE.xml <FILE >FORMATTED");
  }
}

void settle_conform(const OptionWords& words, Options& options) {
  options.learned = words.value("--learn-leaves");
  options.tells_coverage = words.has("--coverage");
}

// "robot.btlog@12": the file and the tick.
void settle_from(const OptionWords& words, Options& options) {
  options.from = words.value("--from");
  if (words.has("--from") && words.has("--any-count")) {
    refuse("--from and --any-count do not go together",
           "in the middle of a run a node has counted already");
  }
  const std::size_t sign = options.from.rfind('@');
  if (sign == std::string::npos) return;
  const std::string word = options.from.substr(sign + 1);
  const auto tick = whole_number(word);
  if (!tick || *tick > INT32_MAX) {
    refuse(fmt::format("--from {}: `{}` is no tick", options.from, word),
           "write FILE@TICK, the end of that tick");
  }
  options.from_tick = static_cast<int>(*tick);
  options.from.resize(sign);
}

// "robot::rules"
void settle_namespace(const OptionWords& words, Options& options) {
  options.space = words.value("--namespace");
  if (options.space.empty()) return;
  const std::string named = fmt::format("--namespace {}", options.space);
  const auto is_name = [](std::string_view name) {
    return !name.empty() && !is_digit(name[0]) &&
           std::ranges::all_of(name, [](char c) {
             return is_letter(c) || is_digit(c) || c == '_';
           });
  };
  std::string_view rest = options.space;
  bool are_names = true;
  for (bool is_last = false; !is_last;) {
    const std::size_t colons = std::min(rest.find("::"), rest.size());
    are_names &= is_name(rest.substr(0, colons));
    is_last = colons == rest.size();
    if (!is_last) rest.remove_prefix(colons + 2);
  }
  if (!are_names) {
    refuse(fmt::format("{}: that is no name of a namespace", named),
           "write names of letters, digits and _, with :: between them");
  }
  if (options.format != ExportFormat::MonitorCpp) {
    refuse(fmt::format("{} needs --to monitor-cpp", named), "");
  }
}

// Of several files one has topics; of a file whose name does not say what it
// is, its first bytes do.
void settle_topic(const OptionWords& words, Options& options) {
  options.topic = words.value("--topic");
  if (options.topic.empty()) return;
  const auto has_topics = [](const std::string& file) {
    return file.ends_with(".mcap") || file.ends_with(".db3") ||
           file.starts_with("/dev/");
  };
  if (has_topics(options.from) || has_topics(options.input) ||
      std::ranges::any_of(options.inputs, has_topics)) {
    return;
  }
  refuse("--topic needs a recording of ROS 2",
         "one is a file .mcap or .db3, as `ros2 bag record` writes it");
}

// A recorded run is either converted or asked.
void settle_recorded(const OptionWords& words, const Options& options) {
  if (options.command != Command::Trace) return;
  const bool is_asked = words.has("--prop") || words.has("-e");
  for (const std::string_view name : {"--to", "-o", "--at"}) {
    if (!is_asked || !words.has(name)) continue;
    refuse(fmt::format("{} and {} do not go together", name,
                       words.has("--prop") ? "--prop" : "-e"),
           "--trace-dir writes a page for each rule that is broken");
  }
  for (const std::string_view name :
       {"--to", "-o", "--at", "-v", "--trace-dir"}) {
    if (!options.view || !words.has(name)) continue;
    refuse(fmt::format("{} and --view do not go together", name),
           "btcheck trace robot.btlog --view");
  }
  for (const std::string_view name : {"--prop", "-e", "--view"}) {
    if (!words.has("--tree") || !words.has(name)) continue;
    refuse(fmt::format("{} and --tree do not go together", name),
           "btcheck trace run.csv --tree TREE --to text");
  }
  for (const std::string_view name : {"--trace-dir", "--tick-ms"}) {
    const bool is_used = is_asked || (options.view && name == "--tick-ms");
    if (is_used || !words.has(name)) continue;
    refuse(fmt::format("{} needs --prop", name),
           "btcheck trace RUN --prop RULES.ltl");
  }
}

// Ticks are asked for where a log is read, and where they matter.
void settle_tick_gap(const OptionWords& words, Options& options) {
  if (!words.has("--tick-gap")) return;
  int gap = 0;
  settle_number(words, "--tick-gap", 1, kMostMilliseconds, gap);
  options.tick_gap = gap;
  switch (options.command) {
    case Command::Trace:
      if (!words.has("--tree")) return;
      return refuse("--tick-gap and --tree do not go together",
                    "btcheck trace run.csv --tree TREE --to text");
    case Command::Watch:
      return;
    case Command::Explain:
      return;
    case Command::Conform:
      if (words.has("--learn-leaves")) return;
      return refuse("--tick-gap needs --learn-leaves",
                    "whether a log conforms does not depend on it");
    default:
      if (words.has("--from") && options.from_tick) return;
      return refuse("--tick-gap needs --from LOG@TICK",
                    "btcheck TREE --from robot.btlog@12 --tick-gap 5");
  }
}

// Where nobody can read a tree from standard input, or not so many.
void refuse_standard_input(const OptionWords& words, std::ptrdiff_t count) {
  const CommandRow& command = row_of(words.command);
  const std::string named = fmt::format("name a file: {}", command.example);
  if (count > 1) refuse("`-` is given twice", "standard input has one tree");
  if (words.command == Command::Fmt && words.inputs.size() > 1) {
    refuse("`-` goes with no other file", "btcheck fmt - <FILE >FORMATTED");
  }
  if (command.argument != ArgumentKind::Tree &&
      command.argument != ArgumentKind::Files &&
      command.argument != ArgumentKind::Trees) {
    refuse(fmt::format("{} does not read standard input", command.word), named);
  }
  if (words.command == Command::Monitor) {
    refuse("monitor reads events from standard input, not the tree", named);
  }
  if (words.command == Command::Simulate && !words.has("--seed") &&
      !words.has("--script")) {
    refuse("simulate reads your steps from standard input, not the tree",
           "name a file, or write --seed NUMBER or --script FILE");
  }
}

// A code is a word; what has a dot or a slash in it, or is there, is a file.
bool explains_log(const OptionWords& words) {
  if (words.command != Command::Explain || words.inputs.empty()) return false;
  const std::string& word = words.inputs[0];
  std::error_code fault;
  return code_named(word) == nullptr &&
         (word.find_first_of("./") != std::string::npos ||
          std::filesystem::exists(word, fault));
}

// What goes with a log does not go with a code.
void settle_explain(const OptionWords& words, const Options& options) {
  if (words.command != Command::Explain || options.explains_log) return;
  for (const auto& [name, values] : words.values) {
    if (name == "--color" || name == "-q") continue;
    refuse(fmt::format("{} goes with a log", name),
           "btcheck explain robot.btlog --tree TREE");
  }
}

// `-` among the inputs: the tree on standard input.
void settle_inputs(const OptionWords& words, Options& options) {
  options.inputs = words.inputs;
  const CommandRow& command = row_of(words.command);
  options.explains_log = explains_log(words);
  const bool names_no_file =
      (command.command == Command::Explain && !options.explains_log) ||
      command.argument == ArgumentKind::Shell;
  const auto count = std::ranges::count(words.inputs, "-");
  if (count > 0 && !names_no_file) refuse_standard_input(words, count);
  if (!names_no_file) {
    std::ranges::replace(options.inputs, "-", std::string(kStandardInput));
  }
  if (!options.inputs.empty()) options.input = options.inputs[0];
}

// The folder in which a batch meets others, and what goes with it.
void settle_shared(const OptionWords& words, BatchOptions& batch) {
  batch.joins = words.has("--join");
  batch.shared = words.value(batch.joins ? "--join" : "--results");
  batch.waits = !words.has("--no-wait");
  settle_seconds(words, "--lease", "write for instance 60", batch.patience);
  for (const char* name : {"--results", "--resume", "--no-wait", "--lease"}) {
    if (!batch.joins || !words.has(name)) continue;
    refuse(fmt::format("--join and {} do not go together", name),
           "--join makes a report of what is there, and checks nothing");
  }
  for (const char* name : {"--no-wait", "--lease"}) {
    if (!batch.shared.empty() || !words.has(name)) continue;
    refuse(fmt::format("{} goes with --results", name),
           "btcheck batch FOLDER --results DIRECTORY shares the work with "
           "others");
  }
}

// How the entries of a batch are shared out, and the cores among them.
void settle_batch(const OptionWords& words, Options& options) {
  BatchOptions& batch = options.batch;
  batch.sources = options.inputs;
  batch.jobs = core_count();
  settle_number(words, "--jobs", 1, kMostThreads, batch.jobs);
  if (options.command != Command::Batch) return;
  if (!words.has("--threads")) {
    options.threads = std::max(1u, core_count() / batch.jobs);
  }
  batch.stops_early = words.has("--fail-fast");
  batch.resumes = words.has("--resume");
  batch.page = words.value("--report");
  settle_shared(words, batch);
  if (!words.has("--shard")) return;
  const std::string word = words.value("--shard");
  const auto shard = shard_of(word);
  if (!shard) {
    refuse(fmt::format("--shard {}: not a part", word),
           "write for instance 1/4, the first of four");
  }
  batch.shard = *shard;
}

// The repositories of what the command line names. What lies in none may name
// what it likes; but a batch is the work of others, a pull request for
// instance: there the folder is all, and of files a link out of it is none.
std::vector<std::string> roots_around(const Options& options) {
  const bool is_batch = options.command == Command::Batch;
  std::vector<std::string> roots;
  const auto add = [&](const std::string& root) {
    if (std::ranges::count(roots, root) == 0) roots.push_back(root);
  };
  std::vector<std::string> inputs =
      options.command == Command::Watch ? options.properties : options.inputs;
  if (options.explains_log && !options.trace.tree.empty()) {
    inputs.push_back(options.trace.tree);
  }
  for (const std::string& input : inputs) {
    const std::size_t end =
        is_folder(input) ? input.size() : input.rfind('/') + 1;
    const std::string folder = end == 0 ? "." : input.substr(0, end);
    const std::string repository = repository_of(folder);
    if (repository.empty() && !is_batch && !is_folder(input)) return {};
    if (!repository.empty()) add(repository);
    add(folder);  // it may be hidden in the repository
    if (!is_batch) add(input);
  }
  for (const std::string& rules : options.properties) add(rules);
  return roots;
}

// Where inputs may lie.
void settle_roots(const OptionWords& words, Options& options) {
  options.roots =
      words.has("--root") ? words.all("--root") : roots_around(options);
  if (options.roots.empty()) return;
  for (const auto* files : {&options.models, &options.leaves}) {
    options.roots.insert(options.roots.end(), files->begin(), files->end());
  }
  if (!options.settings.empty()) options.roots.push_back(options.settings);
}

// Two profiles are compared in text, and nothing is kept of them.
void settle_against(const OptionWords& words, Options& options) {
  if (options.command == Command::WhatIf) return;
  settle_choice(words, "--against", options.against);
  if (!options.against || options.command == Command::Diff) return;
  for (const char* name : {"--any-count", "--format", "--from", "--trace-dir",
                           "--write-baseline"}) {
    if (!words.has(name)) continue;
    refuse(fmt::format("--against and {} do not go together", name),
           "btcheck TREE.xml --profile A --against B tells in text what "
           "differs");
  }
}

// What is checked again and again is told each time; what is kept once, and
// what ends by itself, is no part of it.
void settle_watch(const OptionWords& words, Options& options) {
  options.watches = words.has("--watch");
  const bool checks =
      options.command == Command::Check || options.command == Command::Batch;
  if (checks && options.view && !options.watches) {
    refuse("--view goes with --watch", "btcheck --watch TREE --view");
  }
  if (!options.watches) return;
  for (const auto& [name, instead] :
       {std::pair("--against", "each change is told beside what was before"),
        std::pair("--any-count", "it is for once: it takes many searches"),
        std::pair("--from", "the end of a run that is over is checked once"),
        std::pair("--write-baseline",
                  "write it once, and watch with --baseline"),
        std::pair("--fail-fast", "what was saved is checked first"),
        std::pair("--results", "--resume takes up an earlier batch"),
        std::pair("--join", "--resume takes up an earlier batch")}) {
    if (!words.has(name)) continue;
    refuse(fmt::format("--watch and {} do not go together", name), instead);
  }
  for (const std::string& input : options.inputs) {
    if (input != kStandardInput && !input.starts_with("/dev/")) continue;
    refuse(fmt::format("--watch: `{}` is no file that is saved again",
                       input == kStandardInput ? "-" : input),
           "btcheck --watch TREE");
  }
  for (const ReportTarget& target : options.reports) {
    const bool is_stream = target.format == ReportFormat::Text ||
                           target.format == ReportFormat::Json ||
                           target.format == ReportFormat::JsonLines;
    if (is_stream || !target.file.empty()) continue;
    const auto formats = choices_of(*option_of(options.command, "--format"));
    const std::string& name = formats[static_cast<std::size_t>(target.format)];
    refuse(
        fmt::format("--watch and --format {} on standard output do not go "
                    "together",
                    name),
        fmt::format("--format {}=FILE writes the file anew each time", name));
  }
}

// Robots are left alone unless somebody says that it is meant.
void settle_robots(const OptionWords& words, Options& options) {
  if (options.command != Command::Watch) return;
  RobotPlan& plan = options.robots;
  plan.faults = words.all("--inject");
  plan.breaks = words.all("--break");
  settle_number(words, "--break-for", 1, kMostMilliseconds, plan.break_ms);
  for (const std::string_view name : {"--inject", "--break"}) {
    if (!words.has(name) || words.has("--allow-inject")) continue;
    refuse(fmt::format("{} changes what the robot does", name),
           "where that is safe, add --allow-inject");
  }
  if (words.has("--break-for") && plan.breaks.empty()) {
    refuse("--break-for goes with --break",
           "btcheck watch groot2://robot --break NODE --break-for 500");
  }
  if (words.has("--allow-inject") && plan.faults.empty() &&
      plan.breaks.empty()) {
    refuse("--allow-inject goes with --inject or --break",
           "without it the robot is left alone");
  }
  if (words.has("-o") && !options.output.ends_with(".btlog")) {
    refuse(fmt::format("-o {}: a log is called FILE.btlog", options.output),
           "Groot2 opens no other");
  }
}

// Which faults are put in.
void settle_faults(const OptionWords& words, Options& options) {
  if (options.command != Command::WhatIf) return;
  FaultPlan& plan = options.faults;
  settle_choice(words, "--others", plan.choices.others);
  settle_number(words, "--late", 1, 1'000'000, plan.choices.late);
  settle_number(words, "--order", 1, 2, plan.order);
  // A tree that is too large is told in its parts.
  constexpr std::uint64_t kMostFaultStates = 300'000;
  if (!words.has("--max-states")) options.max_states = kMostFaultStates;
  plan.only = words.value("--only");
  plan.against = words.value("--against");
  for (const std::string& word : words.all("--faults")) {
    plan.choices.kinds.push_back(*fault_kind(word));
  }
}

// Which trees are compared, and as whom.
void settle_diff(const OptionWords& words, Options& options) {
  if (options.command != Command::Diff) return;
  DiffPlan& plan = options.diff;
  plan.observe = words.all("--observe");
  settle_choice(words, "--caller", plan.caller);
  plan.revision = words.value("--git");
  if (words.has("--git") &&
      (plan.revision.empty() || plan.revision[0] == '-')) {
    refuse(fmt::format("--git {}: no revision", plan.revision),
           "btcheck diff --git main TREE.xml");
  }
  const std::size_t count = words.inputs.size();
  const bool may_be_one = words.has("--git") || words.has("--against");
  const bool may_be_two = !words.has("--git");
  if (count == 0 || (count == 1 && may_be_one) || (count == 2 && may_be_two)) {
    return;
  }
  if (!may_be_two) {
    refuse("--git compares one tree with what it was",
           "btcheck diff --git main TREE.xml");
  }
  refuse(fmt::format("diff compares two trees, not {}", count),
         "btcheck diff OLD.xml NEW.xml");
}

// What a command cannot do without.
void refuse_missing(const OptionWords& words) {
  const CommandRow& command = row_of(words.command);
  if (words.inputs.empty() && !command.missing.empty()) {
    refuse(command.missing, command.example);
  }
  for (const OptionRow& option : option_rows()) {
    if (!option.is_required || !option.commands.contains(words.command) ||
        words.has(option.name) ||
        std::ranges::any_of(words_of(option.instead), [&](const auto& other) {
          return words.has(other);
        })) {
      continue;
    }
    const std::vector<std::string> choices = choices_of(option);
    refuse(fmt::format("{}: no format", command.word),
           fmt::format("write {} {}{}", option.name,
                       choices.size() > 4 ? "and one of: " : "",
                       listed(choices, "or")));
  }
}

std::variant<Options, Answer> meant(const OptionWords& words) {
  if (words.has("--help")) {
    const bool is_whole = std::ranges::count(words.inputs, "all") > 0;
    const Command command = words.command;
    return Answer{words.names_command
                      ? (is_whole ? help_text(command) : first_help(command))
                      : (is_whole ? help_text() : first_help()),
                  ExitCode::Met};
  }
  if (words.has("--version")) return Answer{version_text(), ExitCode::Met};
  if (words.has("--licenses")) return Answer{licenses_text(), ExitCode::Met};
  Options options;
  options.command = words.command;
  settle_inputs(words, options);
  options.properties = words.all("--prop");
  options.rules = words.all("-e");
  options.is_quiet = words.has("-q");
  options.is_verbose = words.has("-v");
  settle_choice(words, "--color", options.color);
  settle_search(words, options);
  settle_trees(words, options);
  settle_judgement(words, options);
  settle_reports(words, options);
  settle_formats(words, options);
  settle_simulation(words, options);
  settle_run(words, options);
  settle_view(words, options);
  settle_recorded(words, options);
  settle_conform(words, options);
  settle_explain(words, options);
  settle_formatting(words, options);
  settle_from(words, options);
  settle_topic(words, options);
  settle_namespace(words, options);
  settle_tick_gap(words, options);
  settle_against(words, options);
  settle_batch(words, options);
  settle_watch(words, options);
  settle_robots(words, options);
  settle_faults(words, options);
  settle_diff(words, options);
  settle_roots(words, options);
  refuse_missing(words);
  return options;
}

}  // namespace

unsigned core_count() {
  return std::clamp(std::thread::hardware_concurrency(), 1u, kMostThreads);
}

Options as_batch(Options options) {
  options.command = Command::Batch;
  options.batch.jobs = core_count();
  if (!options.given.contains("--threads")) options.threads = 1;
  return options;
}

std::variant<Options, Answer> parse_options(int argc, const char* const* argv) {
  std::vector<std::string> line(argv + 1, argv + argc);
  if (line.empty()) return Answer{short_help(), ExitCode::Met};
  try {
    auto options = meant(sorted_words(line));
    if (auto* found = std::get_if<Options>(&options)) {
      found->words = std::move(line);
    }
    return options;
  } catch (Refusal& refused) {
    return std::move(refused.answer);
  }
}

}  // namespace btcheck
