// SPDX-License-Identifier: MIT
#include "batch/run.hpp"

#include <algorithm>
#include <utility>

#include "batch/entry_check.hpp"
#include "batch/job_pool.hpp"
#include "cli/inputs/progress.hpp"
#include "cli/inputs/watch.hpp"

namespace btcheck {
namespace {

// Ends the search of one entry: at its time limit, or when nobody waits for it
// any more.
class EntryMonitor : public SearchMonitor {
 public:
  EntryMonitor(const ProcessLimits& limits, BatchProgress& progress,
               std::function<bool()> is_cancelled)
      : limits_(limits),
        progress_(progress),
        is_cancelled_(std::move(is_cancelled)) {}

  StopReason observe(const SearchProgress&) override {
    progress_.observe();
    return limits_.reached(is_cancelled());
  }
  bool may_tell() override { return limits_.may_tell(is_cancelled()); }

  double seconds() const { return limits_.seconds(); }
  // Its results are not what they would have been.
  bool was_cancelled() const { return was_cancelled_; }

 private:
  bool is_cancelled() {
    if (is_cancelled_()) was_cancelled_ = true;
    return was_cancelled_;
  }

  ProcessLimits limits_;
  BatchProgress& progress_;
  std::function<bool()> is_cancelled_;
  std::atomic<bool> was_cancelled_ = false;
};

bool fails(const ReportedTree& tree) {
  return tree.not_run.empty() && tree.code != ExitCode::Met &&
         tree.code != ExitCode::Undecided;
}

}  // namespace

BatchRun::BatchRun(const Options& options,
                   const std::vector<BatchEntry>& entries, KeptResults& kept,
                   Listener listener)
    : options_(options),
      entries_(entries),
      kept_(kept),
      listener_(std::move(listener)),
      progress_(progress_style(options), entries.size()),
      last_(entries.size()),
      done_(entries.size()) {}

std::vector<ReportedTree> BatchRun::run() {
  run_jobs(entries_.size(), options_.batch.jobs,
           [this](std::size_t entry) { work(entry); });
  // What an interrupt or a failure left out, and what is behind it.
  for (std::size_t i = told_.size(); i < entries_.size(); ++i) {
    const bool is_behind = i > last_;
    if (done_[i] && !is_behind) {
      tell(std::move(*done_[i]));
    } else {
      tell(unrun_tree(entries_[i], is_behind ? "an entry before it has failed"
                                             : "interrupted"));
    }
  }
  return std::move(told_);
}

bool BatchRun::is_cancelled(std::size_t entry) const {
  return entry > last_ || InterruptWatch::is_interrupted();
}

void BatchRun::work(std::size_t entry) {
  if (is_cancelled(entry)) return;
  progress_.begin(entry, entries_[entry].name);
  std::optional<ReportedTree> tree = result_of(entry);
  progress_.end(entry);
  if (tree) finish(entry, std::move(*tree));
}

// Nothing for an entry that was broken off.
std::optional<ReportedTree> BatchRun::result_of(std::size_t entry) {
  const BatchEntry& what = entries_[entry];
  if (has_error(what.diagnostics)) return broken_tree(what, what.diagnostics);
  std::vector<Diagnostic> found = what.diagnostics;
  const Options options = applied(options_, what.choices);
  const auto inputs =
      gather_inputs(what.input, what.properties, options, found);
  if (!inputs) return broken_tree(what, std::move(found));
  const std::string key = key_of(what, *inputs, options);
  if (options.batch.resumes) {
    auto kept = kept_.find(key);
    if (kept && has_all_pages(*kept)) {
      ++resumed_;
      return kept;
    }
  }
  auto tree = checked(entry, *inputs, options);
  if (tree && may_be_kept(*tree)) kept_.add(key, *tree);
  return tree;
}

std::optional<ReportedTree> BatchRun::checked(std::size_t entry,
                                              const Inputs& inputs,
                                              const Options& options) {
  // Memory is the whole process's: entries beside this one hold some, too.
  EntryMonitor monitor(
      {options.timeout, options_.max_bytes * options_.batch.jobs}, progress_,
      [this, entry] { return is_cancelled(entry); });
  const Limits limits{options.max_states, options.max_bytes, &monitor};
  ReportedTree tree = checked_tree(entries_[entry], inputs, options, limits);
  if (monitor.was_cancelled()) return std::nullopt;
  tree.seconds = monitor.seconds();
  tree.peak_bytes = peak_bytes();
  return tree;
}

void BatchRun::finish(std::size_t entry, ReportedTree tree) {
  const std::lock_guard lock(mutex_);
  if (options_.batch.stops_early && fails(tree)) {
    last_ = std::min(last_.load(), entry);
  }
  done_[entry] = std::move(tree);
  for (std::size_t i = told_.size(); i < done_.size() && done_[i] && i <= last_;
       ++i) {
    tell(std::move(*done_[i]));
  }
}

void BatchRun::tell(ReportedTree tree) {
  progress_.print([&] { listener_(tree); });
  told_.push_back(std::move(tree));
}

}  // namespace btcheck
