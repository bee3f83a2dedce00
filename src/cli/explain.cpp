// SPDX-License-Identifier: MIT
//
// `btcheck explain CODE`: what the code of a message means; `btcheck explain
// LOG`: why the run of a log ended so.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/options/words.hpp"
#include "cli/recordings.hpp"
#include "report/codes/codes.hpp"
#include "report/explain/text.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/explain/explain.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

// --- Codes -------------------------------------------------------------------

std::string example_text(const CodeExample& example) {
  std::string text = "\nThe smallest example\n";
  for (const ExampleFile& file : files_of(example)) {
    text += fmt::format("\n  {}\n", file.name);
    for (const char c : file.text) {
      if (text.back() == '\n') text += "    ";
      text += c;
    }
  }
  text += '\n';
  for (const std::string& command : commands_of(example)) {
    text += fmt::format("  $ {}\n", command);
  }
  return text;
}

// "1014" is BT1014.
std::string full_code(const std::string& word) {
  const bool is_number =
      !word.empty() && std::all_of(word.begin(), word.end(),
                                   [](char c) { return c >= '0' && c <= '9'; });
  return is_number ? "BT" + word : word;
}

[[noreturn]] void refuse_code(const std::string& word) {
  std::vector<std::string> codes;
  for (const CodeRow* row : all_codes()) codes.emplace_back(row->code);
  const auto meant = closest_match(full_code(word), codes);
  refuse(fmt::format("no code `{}`", word),
         meant
             ? fmt::format("did you mean {}? `btcheck explain` lists them all",
                           *meant)
             : "`btcheck explain` lists them all");
}

// What the code means, what to do, and the smallest example.
std::string explanation(const CodeRow& row) {
  std::string summary(row.summary);
  if (summary.ends_with('.')) summary.pop_back();
  std::string text =
      fmt::format("{}: {}\n\n{}\n\nWhat to do: {}\n", row.code, summary,
                  wrapped(row.description, 0), wrapped(row.help, 12));
  if (row.example.exists()) text += example_text(row.example);
  return text;
}

// Every code with its summary, a line for each.
std::string code_list() {
  std::string text;
  for (const CodeRow* row : all_codes()) {
    text += fmt::format("{}  {}\n", row->code, wrapped(row->summary, 8));
  }
  return text + "\n`btcheck explain CODE` tells more about one of them.\n";
}

ExitCode explain_code(const Options& options) {
  const std::string& code = options.input;
  if (code.empty()) {
    print(code_list());
    return ExitCode::Met;
  }
  const CodeRow* row = code_named(full_code(code));
  if (row == nullptr) refuse_code(code);
  print(explanation(*row));
  return ExitCode::Met;
}

// --- Logs --------------------------------------------------------------------

// A log, or a run that btcheck has kept: that is a log as well.
std::optional<BehaviorLog> read_recording(const Options& options,
                                          const Limits& limits) {
  const std::string& name = options.input;
  const auto file = read_file_in(options.roots, name);
  show(options, file.diagnostics);
  if (!file.value) return std::nullopt;
  const std::string& text = file.value->text;
  const bool is_kept = !is_log(name, text);
  Result<BehaviorLog> log;
  if (is_kept) {
    auto run = read_itf(name, text);
    log.diagnostics = std::move(run.diagnostics);
    if (run.value) log = read_log(name, btlog_bytes(*run.value, 1), "", limits);
  } else {
    log = read_whole_log(options, name, text, limits);
  }
  show(options, log.diagnostics);
  // A kept run has the tree as it was drawn, without the ports of its nodes.
  if (is_kept && log.value) log.value->xml.clear();
  return std::move(log.value);
}

class Explaining {
 public:
  Explaining(const Options& options, BehaviorLog log, Lowered lowered,
             Watch& watch)
      : options_(options),
        log_(std::move(log)),
        lowered_(std::move(lowered)),
        watch_(watch) {}

  ExitCode run() {
    const BehaviorTree& tree = lowered_.tree;
    const RecordedRun recorded = recorded_tree(tree, lowered_.input);
    auto log = placed(std::move(log_), tree, recorded);
    if (!are_right(log.diagnostics) || !log.value) return ExitCode::BadInput;
    log_ = std::move(*log.value);
    auto nodes = LoggedNodes::match(log_, tree, recorded);
    if (!are_right(nodes.diagnostics) || !nodes.value) {
      return ExitCode::BadInput;
    }
    const LogReading reading = reading_of(options_);
    const LogMoments moments(log_, *nodes.value, reading);
    const ExplainedLog asked{log_, *nodes.value, reading, moments};
    const TreeInput& input = lowered_.input;
    const auto unlooped = tree_of_table();
    const Explanation found = explain(
        {{tree, SourceText(input.name, input.text), lowered_.network.ticks},
         lowered_.network,
         unlooped ? *unlooped : tree,
         threads_to_use(options_)},
        asked, watch_.limits);
    watch_.monitor.clear();
    return worst_of(told({options_.input, tree, asked, found}),
                    worst_of(code_of(found), lowered_.code()));
  }

 private:
  bool are_right(std::vector<Diagnostic>& found) {
    for (Diagnostic& each : found) each.file = options_.input;
    show(options_, found);
    return !has_error(found);
  }

  // The tree as `btcheck whatif` reads it: a log may need one that is ticked
  // again after its end.
  std::optional<BehaviorTree> tree_of_table() const {
    if (options_.loops || !lowered_.input.reading.loops) return std::nullopt;
    TreeInput input = lowered_.input;
    input.reading.loops = false;
    return std::move(read_tree(input.name, input.text, input.reading).value);
  }

  ExitCode told(const ExplainedRun& run) {
    ExitCode code = ExitCode::Met;
    for (const ReportTarget& target : options_.reports) {
      const bool is_text = target.format == ReportFormat::Text;
      std::string text =
          is_text ? harmless(explain_text(run)) : explain_json(run);
      if (is_text && target.file.empty()) {
        text = painted(options_, text, STDOUT_FILENO);
      }
      code = worst_of(code, write_output(target.file, text));
    }
    return code;
  }

  static ExitCode code_of(const Explanation& found) {
    if (found.stopped != StopReason::None) return ExitCode::Undecided;
    return found.is_refused() ? ExitCode::Missed : ExitCode::Met;
  }

  const Options& options_;
  BehaviorLog log_;
  Lowered lowered_;
  Watch& watch_;
};

}  // namespace

ExitCode run_explain(const Options& options) {
  if (!options.explains_log) return explain_code(options);
  Watch watch(options);
  auto log = read_recording(options, watch.limits);
  if (!log) {
    return watch.limits.reached({}) == StopReason::None ? ExitCode::BadInput
                                                        : ExitCode::Undecided;
  }
  auto lowered = tree_of_log(options, options.trace.tree, options.input, *log,
                             !is_own(*log));
  if (!lowered) return ExitCode::BadInput;
  return Explaining(options, std::move(*log), std::move(*lowered), watch).run();
}

}  // namespace btcheck
