// SPDX-License-Identifier: MIT
//
// `btcheck trace RUN --prop RULES`: rules asked of one recorded run.
#include "cli/recordings.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/write_reports.hpp"
#include "ltl/rules/property.hpp"
#include "project/sources.hpp"
#include "report/text/report.hpp"
#include "trace/conform/conform.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck {
namespace {

void add(std::vector<Diagnostic>& to, std::vector<Diagnostic> found) {
  to.insert(to.end(), std::make_move_iterator(found.begin()),
            std::make_move_iterator(found.end()));
}

// The names of a log's nodes: those of the tree that the rules name, where they
// name one, since a log has no lines. Nothing, with the reason, where the tree
// cannot be read or is another one.
Result<LogInTree> names_for(const Options& options, const InputFile& rules,
                            const std::string& file, const BehaviorLog& read) {
  Result<LogInTree> result;
  const auto inputs =
      gather_inputs(rules.name, {}, options, result.diagnostics);
  if (!inputs) return result;
  const TreeInput& input = inputs->tree;
  auto tree = read_tree(input.name, input.text, input.reading);
  if (!tree.value) {
    result.diagnostics = std::move(tree.diagnostics);
    return result;
  }
  RecordedRun run = recorded_tree(*tree.value, input);
  auto log = placed(read, *tree.value, run);
  for (Diagnostic& found : log.diagnostics) found.file = file;
  add(result.diagnostics, std::move(log.diagnostics));
  if (!log.value) return result;
  auto nodes = LoggedNodes::match(*log.value, *tree.value, run);
  if (nodes.value) {
    result.value = {std::move(run), std::move(*log.value)};
  } else {
    nodes.diagnostics.front().file = file;
    add(result.diagnostics, std::move(nodes.diagnostics));
  }
  return result;
}

Diagnostic without_tree(const std::string& file) {
  return file_error("BT1807", file,
                    "a recording of ROS 2 does not bring its tree along",
                    "name the tree in the rules: tree \"nav.xml\"");
}

// The files of --prop, and what -e says; nothing, and shows why, where one
// cannot be read.
std::optional<std::vector<InputFile>> asked_rules(const Options& options) {
  std::vector<InputFile> asked;
  for (const std::string& name : options.properties) {
    auto rules = read_file(name);
    show(options, rules.diagnostics);
    if (!rules.value) return std::nullopt;
    asked.push_back(std::move(*rules.value));
  }
  if (!options.rules.empty()) asked.push_back(typed_rules(options.rules));
  return asked;
}

Result<WatchReport> watched_log(const Options& options, const InputFile& file,
                                const InputFile& rules,
                                const PropertyFile& read,
                                const BehaviorLog& log) {
  const LogReading reading = reading_of(options);
  const SourceText source(rules.name, rules.text);
  if (read.tree.empty() && !log.has_places()) {
    return {std::nullopt, {without_tree(file.name)}};
  }
  if (read.tree.empty()) {
    return watch_log(file.name, log, reading, read, source);
  }
  auto names = names_for(options, rules, file.name, log);
  if (!names.value) return {std::nullopt, std::move(names.diagnostics)};
  auto report = watch_log_as(names.value->names, file.name, names.value->log,
                             reading, read, source);
  add(names.diagnostics, std::move(report.diagnostics));
  return {std::move(report.value), std::move(names.diagnostics)};
}

// The rules of one file, asked of the recording.
Result<WatchReport> watched(const Options& options, const InputFile& file,
                            const InputFile& rules) {
  auto read = read_properties(rules.name, rules.text);
  Result<WatchReport> result{std::nullopt, std::move(read.diagnostics)};
  if (!read.value) return result;
  const SourceText source(rules.name, rules.text);
  const auto ask = [&](auto recorded, const auto& watch) {
    add(result.diagnostics, std::move(recorded.diagnostics));
    if (!recorded.value) return;
    Result<WatchReport> report = watch(*recorded.value);
    add(result.diagnostics, std::move(report.diagnostics));
    result.value = std::move(report.value);
  };
  if (is_log(file.name, file.text)) {
    ask(read_whole_log(options, file.name, file.text,
                       {.max_bytes = memory_limit(options)}),
        [&](const BehaviorLog& log) {
          return watched_log(options, file, rules, *read.value, log);
        });
  } else {
    ask(read_itf(file.name, file.text), [&](const RecordedRun& run) {
      return watch_run(file.name, run, *read.value, source);
    });
  }
  return result;
}

// Writes the runs that break rules to --trace-dir; false, and complains, where
// that fails.
bool keep_runs(const Options& options, const WatchReport& report) {
  if (options.trace_dir.empty()) return true;
  for (const WatchedRule& rule : report.rules) {
    if (!rule.run) continue;
    const std::string complaint =
        write_trace(options.trace_dir, options.input, rule.name, *rule.run);
    if (complaint.empty()) continue;
    complain("BT0004", complaint);
    return false;
  }
  return true;
}

}  // namespace

LogReading reading_of(const Options& options) {
  LogReading reading;
  reading.tick_time = std::int64_t{options.tick_ms} * 1000;
  reading.is_time_said = options.given.contains("--tick-ms");
  if (options.tick_gap) {
    reading.tick_gap = std::int64_t{*options.tick_gap} * 1000;
  }
  return reading;
}

std::optional<Result<InputFile>> marks_beside(const std::string& name,
                                              std::string_view bytes) {
  const std::string marks = name + std::string(kMarksEnding);
  std::error_code error;
  if (!bytes.starts_with(kBtlogMagic) ||
      !std::filesystem::exists(marks, error)) {
    return std::nullopt;
  }
  // As the log, which was named, it may lie outside of the roots; it must not
  // lead out of its folder.
  const std::string folder = std::filesystem::path(name).parent_path().string();
  return read_file_in({folder.empty() ? "." : folder}, marks);
}

Result<BehaviorLog> read_whole_log(const Options& options,
                                   const std::string& name,
                                   std::string_view bytes,
                                   const Limits& limits) {
  auto log = read_log(name, bytes, options.topic, limits);
  if (!log.value) return log;
  auto marks = marks_beside(name, bytes);
  if (!marks) return log;
  add(log.diagnostics, std::move(marks->diagnostics));
  if (marks->value) {
    const InputFile& file = *marks->value;
    add(log.diagnostics, read_marks(file.name, file.text, *log.value, limits));
  }
  if (has_error(log.diagnostics)) log.value.reset();
  return log;
}

std::optional<Lowered> tree_of_log(const Options& asked,
                                   const std::string& tree,
                                   const std::string& name,
                                   const BehaviorLog& log, bool loops) {
  Options options = asked;
  options.input = tree;
  options.loops |= loops;
  if (!tree.empty()) return read_and_lower(options);
  std::vector<Diagnostic> found;
  if (log.xml.empty()) {
    show(options,
         {file_error("BT1807", name, "this log does not bring its tree along",
                     asked.command == Command::Conform
                         ? "name the tree: btcheck conform LOG TREE"
                         : "name the tree: btcheck explain LOG --tree TREE")});
    return std::nullopt;
  }
  if (options.main_tree.empty()) options.main_tree = log.tree;
  auto inputs = inputs_of({name + ".xml", log.xml}, options, found);
  show(options, found);
  if (!inputs) return std::nullopt;
  return lowered_from(std::move(*inputs), options);
}

std::optional<std::vector<LiveRules>> live_rules(const Options& options,
                                                 const std::string& file) {
  const auto asked = asked_rules(options);
  if (!asked) return std::nullopt;
  std::vector<LiveRules> all;
  for (const InputFile& each : *asked) {
    const auto kept = std::make_shared<const InputFile>(each);
    const InputFile& rules = *kept;
    auto read = read_properties(rules.name, rules.text);
    show(options, read.diagnostics);
    if (!read.value) return std::nullopt;
    LiveRules& made = all.emplace_back(LiveRules{
        std::move(*read.value), SourceText(rules.name, rules.text), {}, kept});
    if (made.file.tree.empty()) {
      made.place = [file](const BehaviorLog& log) -> Result<LogInTree> {
        if (!log.has_places()) return {std::nullopt, {without_tree(file)}};
        RecordedRun names = LogPlayer(log, {}).heading();
        names.tree = file;
        return {LogInTree{std::move(names), log}, {}};
      };
    } else {
      made.place = [&options, rules, file](const BehaviorLog& log) {
        return names_for(options, rules, file, log);
      };
    }
  }
  return all;
}

ExitCode watch_recorded(const Options& options, const InputFile& file) {
  const auto asked = asked_rules(options);
  if (!asked) return ExitCode::BadInput;
  std::vector<WatchReport> reports;
  for (const InputFile& rules : *asked) {
    Result<WatchReport> report = watched(options, file, rules);
    show(options, report.diagnostics);
    if (!report.value) return ExitCode::BadInput;
    reports.push_back(std::move(*report.value));
  }
  ExitCode code = ExitCode::Met;
  for (const WatchReport& report : reports) {
    print(watch_text(report));
    if (!keep_runs(options, report)) return ExitCode::BadInput;
    if (is_broken(report)) code = ExitCode::Missed;
  }
  return code;
}

}  // namespace btcheck
