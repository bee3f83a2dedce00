// SPDX-License-Identifier: MIT
//
// In a format of lines, standard output grows as entries are done; everything
// else is written at the end, from one report.
#include "batch/command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <utility>

#include "batch/entries/entries.hpp"
#include "batch/report.hpp"
#include "batch/results/results_file.hpp"
#include "batch/results/results_folder.hpp"
#include "batch/run.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/keep_baseline.hpp"
#include "cli/outputs/write_reports.hpp"
#include "report/formats/formats.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// Tells each entry as soon as it can be told, where standard output has a
// format that grows.
class LiveOutput {
 public:
  LiveOutput(const Options& options, std::size_t entries)
      : options_(options), layout_(layout_of(options)) {
    for (const ReportTarget& target : options.reports) {
      if (!target.file.empty()) continue;
      has_text_ = target.format == ReportFormat::Text;
      has_lines_ = target.format == ReportFormat::JsonLines;
    }
    if (has_text_) show(batch_heading());
    if (has_lines_) print_exactly(json_batch_line(entries));
    flush_output();
  }

  void take(const ReportedTree& tree) {
    tell_settings(options_, tree.file);
    show_findings(tree);
    if (!options_.is_quiet) tell(tree.left_out);
    if (has_text_) show(batch_lines(tree, layout_));
    if (has_lines_) {
      print_exactly(json_tree_lines(new_report(0), tree));
    }
    flush_output();
  }

  void end(const Report& report) const {
    if (has_text_) show(batch_ending(report, layout_));
    if (has_lines_) print_exactly(json_end_line(report));
  }

  // The targets that nothing has been told of yet.
  std::vector<ReportTarget> others() const {
    std::vector<ReportTarget> targets = options_.reports;
    if (!has_text_ && !has_lines_) return targets;
    std::erase_if(targets, [](const auto& one) { return one.file.empty(); });
    return targets;
  }

  std::size_t hidden() const { return hidden_; }

 private:
  void show(const std::string& text) const {
    print_exactly(painted(options_, text, STDOUT_FILENO));
  }

  // What the text does not tell: why a tree was not checked. Notes of two
  // hundred trees would hide it: they are counted.
  void show_findings(const ReportedTree& tree) {
    std::vector<Diagnostic> shown = tree.diagnostics;
    if (!options_.is_verbose) {
      const bool is_told = has_text_ && !tree.files.empty();
      hidden_ += notes_left_out(tree, layout_);
      std::erase_if(shown, [&](const Diagnostic& found) {
        return is_told || found.severity != Severity::Error;
      });
    }
    btcheck::show(options_, shown);
  }

  const Options& options_;
  Layout layout_;
  bool has_text_ = false;
  bool has_lines_ = false;
  std::size_t hidden_ = 0;
};

}  // namespace

Options shared_out(Options options) {
  const unsigned jobs = options.batch.jobs;
  options.max_bytes = std::max<std::uint64_t>(1, memory_limit(options) / jobs);
  return options;
}

bool can_write(const Options& options) {
  std::string obstacle = obstacle_to(options);
  if (obstacle.empty() && !options.batch.page.empty()) {
    obstacle = obstacle_to(options.batch.page);
  }
  if (obstacle.empty() && !options.trace_dir.empty()) {
    obstacle = make_directory(options.trace_dir);
  }
  if (obstacle.empty() && !options.batch.shared.empty() &&
      !options.batch.joins) {
    obstacle = make_directory(options.batch.shared);
  }
  if (!obstacle.empty()) complain("BT0004", obstacle);
  return obstacle.empty() && can_use_disk(options);
}

namespace {

// Whether the folder to be joined is there. Complains when it is not.
bool can_join(const BatchOptions& batch) {
  if (!batch.joins || is_folder(batch.shared)) return true;
  complain("BT0002", fmt::format("cannot find the folder `{}`", batch.shared));
  return false;
}

// Where results are kept.
std::string place_of_results(const BatchOptions& batch) {
  return batch.shared.empty() ? results_file(batch) : batch.shared;
}

// What they are sealed with; "" for a checksum.
std::string secret_of_results() {
  const char* key = std::getenv("BTCHECK_RESULTS_KEY");
  return key == nullptr ? "" : key;
}

std::unique_ptr<KeptResults> results_of(const BatchOptions& batch) {
  const std::string secret = secret_of_results();
  const std::string place = place_of_results(batch);
  if (batch.shared.empty()) {
    return std::make_unique<ResultsFile>(
        place,
        batch.resumes ? ResultsFile::Start::TakeUp : ResultsFile::Start::Over,
        secret);
  }
  auto folder = std::make_unique<ResultsFolder>(
      place,
      batch.joins ? ResultsFolder::Role::Joins : ResultsFolder::Role::Works,
      batch.patience, secret);
  if (batch.resumes) folder->drop_failed();
  return folder;
}

void warn(const Options& options, std::string_view code, std::string message,
          std::string help = {}) {
  Diagnostic warning = file_error(code, place_of_results(options.batch),
                                  std::move(message), std::move(help));
  warning.severity = Severity::Warning;
  show(options, {warning});
}

void warn_of_kept(const Options& options, const KeptResults& kept) {
  if (kept.damaged() > 0) {
    warn(options, "BT1508",
         fmt::format(
             "{} of the results kept in `{}` {} damaged{}, and done again",
             kept.damaged(), place_of_results(options.batch),
             kept.damaged() == 1 ? "is" : "are",
             secret_of_results().empty() ? "" : " or sealed with another key"));
  }
  if (!kept.complaint().empty()) {
    warn(options, "BT1509", "results are not kept: " + kept.complaint());
  }
}

// "a.ltl, b.ltl, c.ltl and 9 more"
std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 3;
  const std::vector<std::string> shown(
      names.begin(), names.begin() + std::min(kMost, names.size()));
  std::string text = fmt::format("{}", fmt::join(shown, ", "));
  if (names.size() > kMost) {
    text += fmt::format(" and {} more", names.size() - kMost);
  }
  return text;
}

void warn_of_missing(const Options& options, const BatchRun& run,
                     std::size_t entries) {
  for (const auto& [why, names] : run.missing) {
    warn(
        options, "BT1513",
        fmt::format("{} of {}: {}: {}", names.size(),
                    counted(entries, "entry", "entries"), why, first_of(names)),
        options.batch.joins ? "the same batch with --results instead of "
                              "--join checks what is left"
                            : "");
  }
}

void print_statistics(const Options& options, std::size_t entries,
                      const BatchRun& run, const LiveOutput& output) {
  if (options.is_quiet) return;
  std::string text = fmt::format(
      "{} in {:.2f} s", counted(entries, "entry", "entries"), run.seconds);
  if (run.resumed > 0) {
    text += fmt::format(", {} of them taken from {}", run.resumed,
                        options.batch.shared.empty()
                            ? "an earlier run"
                            : fmt::format("`{}`", options.batch.shared));
  }
  if (output.hidden() > 0) {
    text += fmt::format("; {} not shown, -v shows {}",
                        counted(output.hidden(), "note", "notes"),
                        output.hidden() == 1 ? "it" : "them");
  }
  tell(text + '\n');
}

// Everything that is written when all is done. Returns what went wrong, or "".
std::string write_all(const Options& options, const Report& report,
                      const LiveOutput& output) {
  output.end(report);
  std::string complaint =
      write_report(options, output.others(), report,
                   harmless(batch_text(report, layout_of(options))));
  if (!complaint.empty() || options.batch.page.empty()) return complaint;
  return write_file(options.batch.page,
                    html_report(report, options.batch.page));
}

}  // namespace

ExitCode run_batch(const Options& asked) {
  // Each entry has limits of its own; what follows waits for them.
  Guard::dismiss();
  limits_of_command().allow(0, UINT64_MAX);
  Options options = asked;
  if (!can_write(options) || !can_join(options.batch) ||
      !take_baseline(options)) {
    return ExitCode::BadInput;
  }
  const std::vector<BatchEntry> entries = gather_batch(options);
  const std::unique_ptr<KeptResults> kept = results_of(options.batch);
  LiveOutput output(options, entries.size());
  BatchRun run =
      run_entries(shared_out(options), entries, *kept,
                  [&](const ReportedTree& tree) { output.take(tree); });
  Report report = new_report(run.seconds);
  report.trees = std::move(run.trees);
  // A batch that was broken off may be resumed, and still use all of them.
  const auto not_run = static_cast<std::size_t>(TreeOutcome::NotRun);
  if (outcomes_of(report)[not_run] == 0) kept->drop_unused();
  const std::string complaint = write_all(options, report, output);
  warn_of_kept(options, *kept);
  warn_of_missing(options, run, entries.size());
  if (!complaint.empty()) complain("BT0004", complaint);
  flush_output();
  print_statistics(options, entries.size(), run, output);
  const ExitCode kept_baseline = keep_baseline(options, judged_of(report));
  return worst_of(worst_of(report.code(), kept_baseline),
                  complaint.empty() ? ExitCode::Met : ExitCode::BadInput);
}

}  // namespace btcheck
