// SPDX-License-Identifier: MIT
#include "batch/run.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// Calls work(i) for each i below `count`, up to `jobs` (1 or more) at a time;
// they begin in the order of their numbers. The work may use threads of its
// own, and must not throw.
//
// There are as many loops as jobs, each of which takes the next number. TBB
// alone would split the range and begin the last numbers before the first are
// done; a batch that tells its results in order would be silent for long.
template <class Work>
void run_jobs(std::size_t count, unsigned jobs, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto loop = [&] {
    for (std::size_t i; (i = next.fetch_add(1)) < count;) work(i);
  };
  if (jobs <= 1 || count <= 1) return loop();
  // More than there are cores, if that is asked for.
  constexpr auto kMost = tbb::global_control::max_allowed_parallelism;
  const std::size_t threads =
      std::max<std::size_t>(jobs, tbb::global_control::active_value(kMost));
  const tbb::global_control control(kMost, threads);
  tbb::task_arena arena(static_cast<int>(jobs));
  arena.execute([&] {
    tbb::parallel_for(
        0u, jobs, [&](unsigned) { loop(); }, tbb::simple_partitioner());
  });
}

// How far the batch is, on stderr: one line that is rewritten on a terminal, a
// line now and then on a pipe. Every member may be called by several threads at
// once.
class BatchProgress {
 public:
  BatchProgress(ProgressStyle style, std::size_t entries)
      : line_(style, style == ProgressStyle::Lines ? 1 : 0.1),
        entries_(entries),
        start_(std::chrono::steady_clock::now()) {}

  void begin(std::size_t entry, const std::string& name) {
    const std::lock_guard lock(mutex_);
    running_[entry] = {one_line(name), seconds()};
    tell();
  }

  void end(std::size_t entry) {
    const std::lock_guard lock(mutex_);
    running_.erase(entry);
    ++done_;
    tell();
  }

  // Writes a line if the last one is long ago and no other thread is at it.
  void observe() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) tell();
  }

  // Prints something else, with no line of progress in its way.
  template <class Print>
  void print(const Print& what) {
    const std::lock_guard lock(mutex_);
    line_.clear();
    what();
  }

  double seconds() const {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - start_).count();
  }

 private:
  static constexpr std::size_t kWidth = 79;

  struct Running {
    std::string name;
    double since = 0;
  };

  // "12 of 200 entries in 3 s; now drone3.ltl (2 s), nav2.ltl (1 s)"
  std::string text(double now) const {
    std::string text =
        fmt::format("{} of {} entries in {:.0f} s", done_, entries_, now);
    const char* before = "; now ";
    for (const auto& [entry, running] : running_) {
      text += fmt::format("{}{} ({:.0f} s)", before, running.name,
                          now - running.since);
      before = ", ";
    }
    return shortened(text, kWidth);
  }

  void tell() {
    const double now = seconds();
    if (line_.is_due(now)) line_.write(text(now), now);
  }

  ProgressLine line_;
  std::size_t entries_;
  std::chrono::steady_clock::time_point start_;
  std::size_t done_ = 0;
  std::map<std::size_t, Running> running_;
  std::mutex mutex_;
};

// Ends the search of one entry: at its time limit, or when its results are no
// longer wanted.
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

class BatchRunner {
 public:
  using Listener = std::function<void(const ReportedTree&)>;

  BatchRunner(const Options& options, const std::vector<BatchEntry>& entries,
              KeptResults& kept, Listener listener)
      : options_(options),
        entries_(entries),
        kept_(kept),
        listener_(std::move(listener)),
        progress_(progress_style(options), entries.size()),
        last_(entries.size()),
        done_(entries.size()) {}

  BatchRun run() {
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
    return {std::move(told_), resumed_, progress_.seconds()};
  }

 private:
  void work(std::size_t entry) {
    if (is_cancelled(entry)) return;
    progress_.begin(entry, entries_[entry].name);
    std::optional<ReportedTree> tree = result_of(entry);
    progress_.end(entry);
    if (tree) finish(entry, std::move(*tree));
  }

  // Nothing for an entry that was broken off.
  std::optional<ReportedTree> result_of(std::size_t entry) {
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

  std::optional<ReportedTree> checked(std::size_t entry, const Inputs& inputs,
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

  void finish(std::size_t entry, ReportedTree tree) {
    const std::lock_guard lock(mutex_);
    if (options_.batch.stops_early && fails(tree)) {
      last_ = std::min(last_.load(), entry);
    }
    done_[entry] = std::move(tree);
    for (std::size_t i = told_.size();
         i < done_.size() && done_[i] && i <= last_; ++i) {
      tell(std::move(*done_[i]));
    }
  }

  void tell(ReportedTree tree) {
    progress_.print([&] { listener_(tree); });
    told_.push_back(std::move(tree));
  }
  bool is_cancelled(std::size_t entry) const {
    return entry > last_ || InterruptWatch::is_interrupted();
  }

  const Options& options_;
  const std::vector<BatchEntry>& entries_;
  KeptResults& kept_;
  Listener listener_;
  BatchProgress progress_;
  std::atomic<std::size_t> resumed_ = 0;
  std::atomic<std::size_t> last_;  // no entry behind this one is run
  std::mutex mutex_;               // of what follows
  std::vector<std::optional<ReportedTree>> done_;
  std::vector<ReportedTree> told_;
};

}  // namespace

BatchRun run_entries(const Options& options,
                     const std::vector<BatchEntry>& entries, KeptResults& kept,
                     std::function<void(const ReportedTree&)> listener) {
  return BatchRunner(options, entries, kept, std::move(listener)).run();
}

}  // namespace btcheck
