// SPDX-License-Identifier: MIT
//
// All entries are looked at in each round, for a tree may depend on more than
// on what it has read: on a file that was not there. What was saved decides
// what comes first and what is told, not what is looked at.
#include "batch/watch/watch.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "batch/command.hpp"
#include "batch/entries/entries.hpp"
#include "batch/report.hpp"
#include "batch/results/results_file.hpp"
#include "batch/run.hpp"
#include "batch/watch/changes.hpp"
#include "batch/watch/view.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/file_changes.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/write_reports.hpp"
#include "report/formats/formats.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

std::string plain_name(const std::string& file) {
  return fs::path(file).lexically_normal().string();
}

// The file of the tree, and those of its rules.
Names own_files(const BatchEntry& entry) {
  Names names = {plain_name(entry.input)};
  for (const std::string& rules : entry.properties) {
    names.insert(plain_name(rules));
  }
  return names;
}

bool has_any(const Names& names, const Names& of) {
  return std::ranges::any_of(
      of, [&](const std::string& name) { return names.contains(name); });
}

// What is saved while a batch goes on.
class SavedMeanwhile : public BreakOff {
 public:
  using Listener = std::function<void(const std::string&, const LookedAt&)>;

  SavedMeanwhile(FileChanges& changes, Listener listener)
      : changes_(changes), listener_(std::move(listener)) {}

  int number() const override { return changes_.number(); }
  bool is_wanted() override {
    names_.merge(changes_.take());
    return !names_.empty();
  }
  void looks_at(const std::string& entry, const LookedAt& names) override {
    listener_(entry, names);
  }
  Names take() {
    if (!names_.empty()) changes_.settle(names_);
    return std::exchange(names_, {});
  }

 private:
  FileChanges& changes_;
  Listener listener_;
  Names names_;
};

std::string clock_time() {
  return fmt::format("{:%H:%M:%S}", fmt::localtime(std::time(nullptr)));
}

class Watching {
 public:
  // `view` may be nullptr.
  Watching(const Options& options, CheckView* view)
      : options_(options),
        view_(view),
        layout_(layout_of(options)),
        kept_(options.batch.resumes ? results_file(options.batch) : "",
              options.batch.resumes ? ResultsFile::Start::TakeUp
                                    : ResultsFile::Start::Over) {
    for (const ReportTarget& target : options.reports) {
      has_text_ = has_text_ ||
                  (target.file.empty() && target.format == ReportFormat::Text);
    }
  }

  ExitCode run() {
    if (!changes_.flaw().empty()) {
      warn_of_flaw(Severity::Error);
      return ExitCode::BadInput;
    }
    while (!InterruptWatch::is_interrupted()) {
      const bool is_over = round();
      if (!is_readable_ && !is_waiting_) return ExitCode::BadInput;
      if (!is_over) continue;
      if (!std::exchange(is_waiting_, true)) tell_waiting();
      saved_ = newest_ = changes_.wait();
    }
    return code();
  }

 private:
  // One entry that is the tree of the command line, or those of a batch.
  std::vector<BatchEntry> entries() {
    if (options_.command == Command::Batch) {
      const LookingOn looking;
      auto all = gather_batch(options_);
      gathered_ = looking.seen();
      return all;
    }
    gathered_ = {};
    BatchEntry entry;
    entry.name = entry.input = options_.input;
    entry.properties = options_.properties;
    return {entry};
  }

  // What is told in full comes first, then what has read a file that was saved.
  // What is new is there because of one.
  int rank_of(const BatchEntry& entry) const {
    if (has_any(newest_, own_files(entry))) return 0;
    if (has_any(saved_, own_files(entry))) return 1;
    const auto seen = looked_at_.find(entry.name);
    if (seen == looked_at_.end() || has_any(saved_, seen->second.files)) {
      return 2;
    }
    return 3;
  }

  bool watch() {
    LookedAt all = gathered_;
    for (const auto& [entry, seen] : looked_at_) all.add(seen);
    const bool has_new = changes_.watch(all);
    if (changes_.flaw() != told_flaw_) {
      told_flaw_ = changes_.flaw();
      if (!told_flaw_.empty()) warn_of_flaw(Severity::Warning);
    }
    return has_new;
  }

  // False where there has to be another one at once.
  bool round() {
    Options options = options_;
    is_readable_ = take_baseline(options);
    if (!is_readable_) {
      gathered_.files.insert(options.baseline);
      watch();
      return true;
    }
    std::vector<BatchEntry> all = entries();
    for (const BatchEntry& entry : all) {
      gathered_.files.merge(own_files(entry));
    }
    if (!options.baseline.empty()) gathered_.files.insert(options.baseline);
    std::ranges::stable_sort(
        all, {}, [&](const BatchEntry& entry) { return rank_of(entry); });
    ChangeTeller teller(options_, layout_, saved_);
    begin_round(all);
    bool looks_again = watch();
    SavedMeanwhile meanwhile(
        changes_, [&](const std::string& entry, const LookedAt& names) {
          looked_at_[entry].add(names);
          looks_again |= watch();
        });
    std::size_t at = 0;
    const BatchRun run = run_entries(
        shared_out(options), all, kept_,
        [&](const ReportedTree& tree) { take(all[at++], tree, teller); },
        &meanwhile);
    for (const auto& [name, seen] : run.looked_at) looked_at_[name] = seen;
    Names more = meanwhile.take();
    const bool is_whole = std::ranges::all_of(
        run.trees,
        [](const ReportedTree& tree) { return tree.not_run.empty(); });
    has_unchecked_ = std::ranges::any_of(run.trees, [&](const auto& tree) {
      return !known_.contains(tree.entry);
    });
    if (is_whole) {
      drop_others(all);
      kept_.drop_unused();
      end_round(run.seconds);
    }
    newest_ = more;
    saved_ = is_whole ? std::move(more) : left_over(all, run, std::move(more));
    // What was looked at for the first time may have changed in between.
    looks_again |= watch();
    return is_whole && saved_.empty() && !looks_again;
  }

  // What was saved, and not told yet: beside what was saved since.
  Names left_over(const std::vector<BatchEntry>& all, const BatchRun& run,
                  Names since) const {
    Names left = saved_;
    for (std::size_t i = 0; i < run.trees.size(); ++i) {
      if (!run.trees[i].not_run.empty()) continue;
      for (const std::string& name : own_files(all[i])) left.erase(name);
    }
    left.merge(since);
    return left;
  }

  // --- What is told --------------------------------------------------------

  void begin_round(const std::vector<BatchEntry>& all) {
    has_heading_ = false;
    is_viewed_ = false;
    // In full, or as a table.
    is_table_ = !is_waiting_ && all.size() > 1;
    if (!is_waiting_ && known_.empty()) {
      has_heading_ = true;
      is_told_ = true;
      if (is_table_) print_text(batch_heading());
      return;
    }
    Names used;
    for (const BatchEntry& entry : all) used.merge(own_files(entry));
    for (const auto& [entry, seen] : looked_at_) {
      used.insert(seen.files.begin(), seen.files.end());
    }
    used.insert(gathered_.files.begin(), gathered_.files.end());
    if (has_any(used, saved_)) head();
  }

  // Once, before the first that is told of a round.
  void head() {
    is_told_ = true;
    if (std::exchange(has_heading_, true)) return;
    std::vector<std::string> names(newest_.begin(), newest_.end());
    std::ranges::set_difference(saved_, newest_, std::back_inserter(names));
    for (std::string& name : names) {
      std::error_code fault;
      if (!fs::exists(name, fault)) name += " (gone)";
    }
    print_text(round_heading(clock_time(), names, layout_.width));
  }

  void take(const BatchEntry& entry, const ReportedTree& tree,
            ChangeTeller& teller) {
    if (!tree.not_run.empty()) return;
    const auto known = known_.find(entry.name);
    const ReportedTree* before =
        known == known_.end() ? nullptr : &known->second;
    std::string text;
    if (is_table_ && before == nullptr) {
      // The table does not say why a tree was not checked.
      text = tree.files.empty() ? teller.whole(before, tree) + '\n'
                                : batch_lines(tree, layout_);
    } else {
      text = has_any(saved_, own_files(entry))
                 ? teller.whole(before, tree)
                 : teller.difference(before, tree);
    }
    if (!text.empty()) {
      has_difference_ = true;
      head();
      print_text(text);
      view(tree);
    }
    known_[entry.name] = tree;
  }

  // The first of a round that is told; of those that are told the first time,
  // the first with a run.
  void view(const ReportedTree& tree) {
    if (view_ == nullptr || is_viewed_) return;
    is_viewed_ = !is_table_ || CheckView::has_run(tree);
    if (is_viewed_ || !has_viewed_) view_->show(tree);
    has_viewed_ = true;
  }

  void drop_others(const std::vector<BatchEntry>& all) {
    Names names;
    for (const BatchEntry& entry : all) names.insert(entry.name);
    std::erase_if(looked_at_,
                  [&](const auto& one) { return !names.contains(one.first); });
    for (auto at = known_.begin(); at != known_.end();) {
      if (names.contains(at->first)) {
        ++at;
        continue;
      }
      has_difference_ = true;
      head();
      print_text(fmt::format("\nno longer checked: {}\n", one_line(at->first)));
      at = known_.erase(at);
    }
  }

  void end_round(double seconds) {
    if (!std::exchange(is_told_, false)) return;
    Report report = new_report(seconds);
    for (const auto& [name, tree] : known_) report.trees.push_back(tree);
    if (is_table_) {
      print_text(batch_ending(report, layout_));
    } else {
      std::string text = has_difference_ ? "" : "nothing has changed\n";
      if (report.trees.size() > 1) text += '\n' + sum_of(report) + '\n';
      print_text(text);
    }
    has_difference_ = false;
    write(report);
    flush_output();
  }

  void write(const Report& report) {
    std::vector<ReportTarget> targets = options_.reports;
    // Lines are not told as a check goes on: each round is whole.
    if (prints_lines(targets)) print_exactly(json_lines(report));
    if (has_text_ || prints_lines(targets)) {
      std::erase_if(targets, [](const auto& one) { return one.file.empty(); });
    }
    std::string complaint = write_report(options_, targets, report,
                                         harmless(batch_text(report, layout_)));
    const std::string& page = options_.batch.page;
    if (complaint.empty() && !page.empty()) {
      complaint = write_file(page, html_report(report, page));
    }
    if (!complaint.empty()) complain("BT0004", complaint);
    can_write_ = complaint.empty();
  }

  void print_text(const std::string& text) {
    if (!has_text_) return;
    print_exactly(painted(options_, text, STDOUT_FILENO));
    flush_output();
  }

  void warn_of_flaw(Severity severity) const {
    Diagnostic flaw = file_error(
        "BT1514", "", changes_.flaw(),
        severity == Severity::Error
            ? "check without --watch"
            : "what is changed there is seen when something else changes");
    flaw.severity = severity;
    show(options_, {flaw});
  }

  void tell_waiting() const {
    if (!options_.is_quiet) tell("waiting for changes; Ctrl-C ends\n");
  }

  ExitCode code() const {
    ExitCode worst =
        is_readable_ && can_write_ ? ExitCode::Met : ExitCode::BadInput;
    for (const auto& [name, tree] : known_) worst = worst_of(worst, tree.code);
    return has_unchecked_ ? worst_of(worst, ExitCode::Undecided) : worst;
  }

  const Options& options_;
  CheckView* const view_;
  const Layout layout_;
  FileChanges changes_;
  ResultsFile kept_;
  Names newest_;                               // of these, what was saved last
  Names saved_;                                // and not told yet
  std::map<std::string, ReportedTree> known_;  // by the names of entries
  std::map<std::string, LookedAt> looked_at_;  // likewise
  LookedAt gathered_;                          // to find the entries
  std::string told_flaw_;
  bool has_text_ = false;    // on standard output
  bool is_waiting_ = false;  // the first round is over
  bool is_readable_ = true;  // what belongs to no entry
  bool can_write_ = true;
  bool has_unchecked_ = true;  // entries of which nothing is known yet
  // Of a round:
  bool is_table_ = false;
  bool has_heading_ = false;
  bool is_viewed_ = false;
  // Since the last round that was whole:
  bool is_told_ = false;
  bool has_difference_ = false;
  bool has_viewed_ = false;  // in some round
};

// A name that was never there is mistyped.
bool are_there(const Options& options) {
  for (const std::string& input : options.inputs) {
    std::error_code fault;
    if (fs::exists(input, fault)) continue;
    show(options,
         {file_error("BT0002", input, fmt::format("cannot find `{}`", input))});
    return false;
  }
  return true;
}

}  // namespace

ExitCode run_watch(const Options& asked) {
  Guard::dismiss();
  limits_of_command().allow(0, UINT64_MAX);
  Options options = asked;
  if (options.command != Command::Batch) options.batch.jobs = 1;
  std::optional<CheckView> view;
  if (options.view) view.emplace(options);
  if (!are_there(options) || !can_write(options)) return ExitCode::BadInput;
  if (view && !view->open(options)) return ExitCode::BadInput;
  const ExitCode code = Watching(options, view ? &*view : nullptr).run();
  if (view) view->end();
  return code;
}

}  // namespace btcheck
