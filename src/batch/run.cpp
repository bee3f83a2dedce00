// SPDX-License-Identifier: MIT
#include "batch/run.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "batch/entry_result.hpp"
#include "batch/worker.hpp"
#include "cli/inputs/build.hpp"
#include "cli/inputs/watch.hpp"
#include "report/text/report.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// How far the batch is, on stderr: one line that is rewritten on a terminal, a
// line now and then on a pipe.
class BatchProgress {
 public:
  BatchProgress(ProgressStyle style, std::size_t entries)
      : line_(style, style == ProgressStyle::Lines ? 1 : 0.1),
        entries_(entries),
        start_(std::chrono::steady_clock::now()) {}

  void begin(std::size_t entry, const std::string& name) {
    running_[entry] = {one_line(name), seconds()};
    tell();
  }

  void end(std::size_t entry) {
    running_.erase(entry);
    ++done_;
    tell();
  }

  double begun(std::size_t entry) const { return running_.at(entry).since; }

  // Others work on it.
  void put_back(std::size_t entry) { running_.erase(entry); }
  void wait_for(std::size_t entries) { awaited_ = entries; }

  // Writes a line if the last one is long ago.
  void tell() {
    const double now = seconds();
    if (line_.is_due(now)) line_.write(text(now), now);
  }

  // Prints something else, with no line of progress in its way.
  template <class Print>
  void print(const Print& what) {
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
    if (running_.empty() && awaited_ > 0) {
      text += fmt::format("; waiting for {} that others check",
                          counted(awaited_, "entry", "entries"));
    }
    return shortened(text, kWidth);
  }

  ProgressLine line_;
  std::size_t entries_;
  std::chrono::steady_clock::time_point start_;
  std::size_t done_ = 0;
  std::size_t awaited_ = 0;
  std::map<std::size_t, Running> running_;
};

bool fails(const ReportedTree& tree) {
  return tree.not_run.empty() && tree.code != ExitCode::Met &&
         tree.code != ExitCode::Undecided;
}

// The entries, those first that took longest the last time, and those first of
// all that nobody has seen; in their own order where it counts which fails
// first.
std::deque<std::size_t> order_of_work(const std::vector<BatchEntry>& entries,
                                      const KeptResults& kept,
                                      bool stops_early) {
  std::deque<std::size_t> order(entries.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (stops_early) return order;
  std::vector<double> seconds;
  for (const BatchEntry& entry : entries) {
    seconds.push_back(kept.seconds_of(entry.name));
  }
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t entry) { return seconds[entry]; });
  return order;
}

class BatchRunner {
 public:
  using Listener = std::function<void(const ReportedTree&)>;

  BatchRunner(const Options& options, const std::vector<BatchEntry>& entries,
              KeptResults& kept, Listener listener, BreakOff* break_off)
      : options_(options),
        entries_(entries),
        kept_(kept),
        listener_(std::move(listener)),
        break_off_(break_off),
        progress_(progress_style(options), entries.size()),
        last_(entries.size()),
        queue_(order_of_work(entries, kept, options.batch.stops_early)),
        done_(entries.size()) {}

  BatchRun run() {
    build_identity();  // found once here, not by each worker
    for (;;) {
      while (begin_next()) {
      }
      // One more look, where nobody waits.
      if (workers_.empty() && !waits_for_others() && !take_back()) break;
      await_workers();
      kept_.keep_alive();
      look_at_others();
      for (const auto& worker : workers_) {
        if (is_cancelled(worker->entry())) worker->cancel();
      }
    }
    // What an interrupt or a failure left out, and what is behind it.
    for (std::size_t i = all_.trees.size(); i < entries_.size(); ++i) {
      if (done_[i] && i <= last_) {
        tell(std::move(*done_[i]));
      } else {
        tell(unrun_tree(entries_[i], why_not_run(i)));
      }
    }
    all_.seconds = progress_.seconds();
    return std::move(all_);
  }

 private:
  // False where none can be begun before something has ended.
  bool begin_next() {
    while (!queue_.empty() && is_cancelled(queue_.front())) queue_.pop_front();
    if (queue_.empty() || workers_.size() >= options_.batch.jobs ||
        !begin(queue_.front())) {
      return false;
    }
    queue_.pop_front();
    return true;
  }

  // False where another worker has to end before there can be one more.
  bool begin(std::size_t entry) {
    const auto work = [this, entry](const OpenFile& to) {
      std::atomic<bool> has_key = false;
      const auto send = [&](const EntryResult& result) {
        to.write((has_key ? "" : sent_head("", result.looked_at)) +
                 sent_text(result));
      };
      limits_of_command().restart();
      const Guard guard(limits_of_command(), [&](const BudgetSpent& spent) {
        if (InterruptWatch::is_interrupted()) return;
        send({EntryResult::Origin::New, spent_tree(entries_[entry], spent)});
      });
      const auto result =
          result_of(entries_[entry], options_, kept_,
                    [&](const std::string& key, const LookedAt& looked_at) {
                      has_key = to.write(sent_head(key, looked_at));
                    });
      if (result) send(*result);
    };
    try {
      workers_.push_back(std::make_unique<Worker>(entry, work));
      progress_.begin(entry, entries_[entry].name);
    } catch (const std::system_error&) {
      if (!workers_.empty()) return false;
      // No process at all is to be had: here, then.
      Received here;
      here.result = result_of(
          entries_[entry], options_, kept_,
          [&](const std::string& key, const LookedAt&) { here.key = key; });
      settle(entry, std::move(here), 0);
    }
    return true;
  }

  // Takes what workers write, until one of them ends or some time is over.
  void await_workers() {
    constexpr int kMilliseconds = 100;
    std::vector<pollfd> files;
    for (const auto& worker : workers_) {
      files.push_back({worker->output(), POLLIN, 0});
    }
    if (break_off_ != nullptr && !is_broken_off_) {
      files.push_back({break_off_->number(), POLLIN, 0});
    }
    progress_.tell();
    tell_of_slow();
    if (::poll(files.data(), files.size(), kMilliseconds) <= 0) return;
    if (files.size() > workers_.size()) {
      is_broken_off_ = files.back().revents != 0 && break_off_->is_wanted();
      files.pop_back();
    }
    for (std::size_t i = files.size(); i-- > 0;) {
      if (files[i].revents == 0 || workers_[i]->read()) continue;
      const auto worker = std::move(workers_[i]);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
      const int signal = worker->end();
      settle(worker->entry(), received(worker->text()), signal);
    }
  }

  // What is looked at for longer than a moment may change meanwhile.
  void tell_of_slow() {
    constexpr double kMoment = 0.25;
    if (break_off_ == nullptr) return;
    for (const auto& worker : workers_) {
      const std::size_t entry = worker->entry();
      if (told_of_.contains(entry) ||
          worker->text().find("\n\n") == std::string::npos ||
          progress_.seconds() - progress_.begun(entry) < kMoment) {
        continue;
      }
      told_of_.insert(entry);
      break_off_->looks_at(entries_[entry].name,
                           received(worker->text()).looked_at);
    }
  }

  // Without a result: the signal that has ended the worker, or 0.
  void settle(std::size_t entry, Received found, int signal) {
    using enum EntryResult::Origin;
    if (!found.result && is_cancelled(entry)) {
      kept_.leave(found.key);
      return progress_.end(entry);
    }
    if (!found.result) {
      found.result = EntryResult{New, ended_tree(entries_[entry], signal)};
      // Perhaps somebody ends this batch, too, and others go on.
      if (signal == 0 || signal == SIGTERM) {
        kept_.leave(std::exchange(found.key, {}));
      }
    }
    if (found.result->origin == Held) {
      held_[entry] = {std::move(found.key)};
      return progress_.put_back(entry);
    }
    progress_.end(entry);
    if (found.result->origin == Missing) missing_.insert(entry);
    all_.looked_at[entries_[entry].name] = std::move(found.result->looked_at);
    take_over(found.key, *found.result);
    finish(entry, std::move(found.result->tree));
  }

  void take_over(const std::string& key, const EntryResult& result) {
    using enum EntryResult::Origin;
    if (key.empty() || result.origin == Missing) return;
    if (result.origin == Kept) {
      kept_.use(key);
      ++all_.resumed;
    } else {
      kept_.add(key, result.tree);
    }
    if (result.origin == Mended) kept_.count_damaged();
  }

  void finish(std::size_t entry, ReportedTree tree) {
    if (options_.batch.stops_early && fails(tree)) {
      last_ = std::min(last_, entry);
    }
    done_[entry] = std::move(tree);
    for (std::size_t i = all_.trees.size();
         i < done_.size() && done_[i] && i <= last_; ++i) {
      tell(std::move(*done_[i]));
    }
  }

  void tell(ReportedTree tree) {
    progress_.print([&] { listener_(tree); });
    if (missing_.contains(all_.trees.size())) {
      all_.missing[tree.not_run].push_back(tree.entry);
    }
    all_.trees.push_back(std::move(tree));
  }

  bool is_cancelled(std::size_t entry) const {
    return entry > last_ || is_broken_off_ || InterruptWatch::is_interrupted();
  }

  // For what others have in hand; where nobody is to wait, for what they may
  // have dropped.
  bool waits_for_others() const {
    return std::ranges::any_of(held_, [&](const auto& one) {
      return !is_cancelled(one.first) &&
             (options_.batch.waits ||
              one.second.holder == KeptResults::Holder::Unclear);
    });
  }

  // Looking takes a tenth of the time at most, however many there are.
  void look_at_others() {
    const double begun = progress_.seconds();
    if (begun < next_look_) return;
    take_back();
    progress_.wait_for(held_.size());
    next_look_ = begun + std::max(0.1, 10 * (progress_.seconds() - begun));
  }

  // What nobody holds any more is done, or on us. False where there is none.
  bool take_back() {
    const std::size_t before = queue_.size();
    for (auto at = held_.begin(); at != held_.end();) {
      Held& held = at->second;
      held.holder = kept_.holder_of(held.key);
      if (held.holder == KeptResults::Holder::Nobody) {
        queue_.push_back(at->first);
        at = held_.erase(at);
      } else {
        ++at;
      }
    }
    return queue_.size() > before;
  }

  std::string why_not_run(std::size_t entry) {
    if (entry > last_) return "an entry before it has failed";
    const auto held = held_.find(entry);
    if (held == held_.end() || is_cancelled(entry)) return "interrupted";
    missing_.insert(entry);
    return kept_.why_missing(entries_[entry].name, held->second.key);
  }

  // By others.
  struct Held {
    std::string key;
    KeptResults::Holder holder = KeptResults::Holder::Unclear;
  };

  const Options& options_;
  const std::vector<BatchEntry>& entries_;
  KeptResults& kept_;
  Listener listener_;
  BreakOff* break_off_;
  bool is_broken_off_ = false;
  std::set<std::size_t> told_of_;  // entries that take long
  BatchProgress progress_;
  std::size_t last_;               // no entry behind this one is run
  std::deque<std::size_t> queue_;  // to be begun
  std::vector<std::unique_ptr<Worker>> workers_;
  std::map<std::size_t, Held> held_;
  double next_look_ = 0;           // at these
  std::set<std::size_t> missing_;  // nobody has a result of them
  std::vector<std::optional<ReportedTree>> done_;
  BatchRun all_;
};

}  // namespace

BatchRun run_entries(const Options& options,
                     const std::vector<BatchEntry>& entries, KeptResults& kept,
                     std::function<void(const ReportedTree&)> listener,
                     BreakOff* break_off) {
  return BatchRunner(options, entries, kept, std::move(listener), break_off)
      .run();
}

}  // namespace btcheck
