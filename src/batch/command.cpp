// SPDX-License-Identifier: MIT
//
// Standard output gets lines as entries are done, where its format has lines;
// everything else is written at the end, from one report.
#include "batch/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "batch/entries/entries.hpp"
#include "batch/html_report.hpp"
#include "batch/kept/kept_results.hpp"
#include "batch/run.hpp"
#include "batch/text.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/write_reports.hpp"
#include "report/formats/json_report.hpp"
#include "report/formats/outcome.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

// The format of standard output, if it is one that grows.
enum class Live : std::uint8_t { None, Text, Lines };

// Tells each entry as soon as it can be told.
class LiveOutput {
 public:
  LiveOutput(const Options& options, std::size_t entries) : options_(options) {
    for (const ReportTarget& target : options.reports) {
      if (!target.file.empty()) continue;
      if (target.format == ReportFormat::Text) live_ = Live::Text;
      if (target.format == ReportFormat::JsonLines) live_ = Live::Lines;
    }
    if (live_ == Live::Text) fmt::print("{}", batch_heading());
    if (live_ == Live::Lines) fmt::print("{}", json_batch_line(entries));
    std::fflush(stdout);
  }

  void take(const ReportedTree& tree) {
    show_findings(tree);
    if (live_ == Live::Text) fmt::print("{}", batch_line(tree));
    if (live_ == Live::Lines) {
      fmt::print("{}", json_tree_lines(new_report(0), tree));
    }
    std::fflush(stdout);
  }

  void end(const Report& report) const {
    if (live_ == Live::Text) fmt::print("{}", batch_ending(report));
    if (live_ == Live::Lines) fmt::print("{}", json_end_line(report));
  }

  // The targets that nothing has been told of yet.
  std::vector<ReportTarget> others() const {
    std::vector<ReportTarget> targets = options_.reports;
    if (live_ == Live::None) return targets;
    std::erase_if(targets, [](const auto& one) { return one.file.empty(); });
    return targets;
  }

  std::size_t hidden() const { return hidden_; }

 private:
  // Warnings of two hundred trees are no news: they are counted.
  void show_findings(const ReportedTree& tree) {
    std::vector<Diagnostic> shown = tree.diagnostics;
    if (!options_.is_verbose) {
      hidden_ += std::erase_if(shown, [](const Diagnostic& found) {
        return found.severity != Severity::Error;
      });
    }
    show(options_, shown);
  }

  const Options& options_;
  Live live_ = Live::None;
  std::size_t hidden_ = 0;
};

// Options with what each of several entries at a time gets.
Options shared_out(Options options) {
  const unsigned jobs = options.batch.jobs;
  options.max_bytes = std::max<std::uint64_t>(1, memory_limit(options) / jobs);
  return options;
}

// Found out before anything is checked, not after.
bool can_write(const Options& options) {
  std::string obstacle = obstacle_to(options.reports);
  if (obstacle.empty() && !options.batch.page.empty()) {
    obstacle = obstacle_to(options.batch.page);
  }
  if (obstacle.empty() && !options.trace_dir.empty()) {
    obstacle = make_directory(options.trace_dir);
  }
  if (!obstacle.empty()) complain("BT0004", obstacle);
  return obstacle.empty() && can_use_disk(options);
}

void warn_of(const Options& options, const KeptResults& kept,
             const std::string& file) {
  Diagnostic warning;
  warning.severity = Severity::Warning;
  warning.file = file;
  if (kept.damaged() > 0) {
    warning.code = "BT1508";
    warning.message =
        fmt::format("{} of the results kept in `{}` {} damaged, and done again",
                    kept.damaged(), file, kept.damaged() == 1 ? "is" : "are");
    show(options, {warning});
  }
  if (options.batch.resumes && !kept.complaint().empty()) {
    warning.code = "BT1509";
    warning.message = "results are not kept: " + kept.complaint();
    show(options, {warning});
  }
}

void print_statistics(const Options& options, const BatchRun& run,
                      const LiveOutput& output, std::size_t entries) {
  if (options.is_quiet) return;
  std::string text =
      fmt::format("{} {} in {:.2f} s", entries,
                  entries == 1 ? "entry" : "entries", run.seconds());
  if (run.resumed() > 0) {
    text +=
        fmt::format(", {} of them taken from an earlier run", run.resumed());
  }
  if (output.hidden() > 0) {
    text += fmt::format("; {} warning{} not shown, -v shows {}",
                        output.hidden(), output.hidden() == 1 ? "" : "s",
                        output.hidden() == 1 ? "it" : "them");
  }
  fmt::print(stderr, "{}\n", text);
}

// Everything that is written when all is done. Returns what went wrong, or "".
std::string write_all(const Options& options, const Report& report,
                      const LiveOutput& output) {
  output.end(report);
  const std::string complaint =
      write_report(output.others(), report, batch_text(report));
  if (!complaint.empty() || options.batch.page.empty()) return complaint;
  return write_file(options.batch.page,
                    html_report(report, options.batch.page));
}

}  // namespace

ExitCode run_batch(const Options& options) {
  const InterruptWatch interrupt;
  if (!can_write(options)) return ExitCode::BadInput;
  const Batch batch = gather_batch(options.batch);
  const std::string file = results_file(options.batch);
  KeptResults kept(file, options.batch.resumes ? KeptResults::Start::TakeUp
                                               : KeptResults::Start::Over);
  LiveOutput output(options, batch.entries.size());
  const Options each = shared_out(options);
  BatchRun run(each, batch.entries, kept,
               [&](const ReportedTree& tree) { output.take(tree); });
  std::vector<ReportedTree> trees = run.run();
  Report report = new_report(run.seconds());
  report.trees = std::move(trees);
  // Of a batch that was broken off, what is not used may be used yet.
  const auto not_run = static_cast<std::size_t>(TreeOutcome::NotRun);
  if (outcomes_of(report)[not_run] == 0) kept.drop_unused();
  const std::string complaint = write_all(options, report, output);
  warn_of(options, kept, file);
  if (!complaint.empty()) complain("BT0004", complaint);
  std::fflush(stdout);
  print_statistics(options, run, output, batch.entries.size());
  return complaint.empty() ? report.code()
                           : worst_of(report.code(), ExitCode::BadInput);
}

}  // namespace btcheck
