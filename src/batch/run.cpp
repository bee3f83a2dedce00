// SPDX-License-Identifier: MIT
#include "batch/run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
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
    return shortened(text, kWidth);
  }

  ProgressLine line_;
  std::size_t entries_;
  std::chrono::steady_clock::time_point start_;
  std::size_t done_ = 0;
  std::map<std::size_t, Running> running_;
};

// Ends the search of one entry: at its limits, or when the batch asks for that.
class EntryMonitor : public SearchMonitor {
 public:
  EntryMonitor(double timeout, std::uint64_t max_bytes)
      : limits_(timeout, max_bytes) {}

  StopReason observe(const SearchProgress&) override {
    return limits_.reached(InterruptWatch::is_interrupted());
  }
  bool may_tell() override {
    return limits_.may_tell(InterruptWatch::is_interrupted());
  }
  bool has_spare() override {
    return limits_.has_spare(InterruptWatch::is_interrupted());
  }

  double seconds() const { return limits_.seconds(); }

 private:
  ProcessLimits limits_;
};

bool fails(const ReportedTree& tree) {
  return tree.not_run.empty() && tree.code != ExitCode::Met &&
         tree.code != ExitCode::Undecided;
}

// The result of an entry, and whether it is of this run.
struct EntryResult {
  enum class Origin : char { Kept = 'k', ToKeep = 'n', NotToKeep = 'o' };
  Origin origin = Origin::NotToKeep;
  std::string key;  // for KeptResults
  ReportedTree tree;
};

// What a worker writes and the batch reads: the origin, the key, a line feed,
// the tree.
std::string sent_text(const EntryResult& result) {
  return static_cast<char>(result.origin) + result.key + '\n' +
         kept_text(result.tree);
}

std::optional<EntryResult> received(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == text.npos || end == 0) return std::nullopt;
  auto tree = tree_from(text.substr(end + 1));
  if (!tree) return std::nullopt;
  return EntryResult{static_cast<EntryResult::Origin>(text[0]),
                     std::string(text.substr(1, end - 1)), std::move(*tree)};
}

// The result of an entry that memory or a mistake of ours has ended.
ReportedTree failed_tree(const BatchEntry& entry, ExitCode code,
                         std::string_view why) {
  const bool is_ours = code == ExitCode::Internal;
  ReportedTree tree = broken_tree(
      entry, {is_ours ? file_error("BT9002", "",
                                   fmt::format("internal error: {}", why))
                      : file_error("BT9001", "", std::string(why),
                                   "--memory sets a limit that is kept")});
  tree.code = code;
  return tree;
}

// Reads an entry and checks it, or takes what is kept of it. Nothing for one
// that was broken off.
std::optional<EntryResult> found_result(const BatchEntry& entry,
                                        const Options& all, KeptResults& kept) {
  using enum EntryResult::Origin;
  if (has_error(entry.diagnostics)) {
    return EntryResult{NotToKeep, {}, broken_tree(entry, entry.diagnostics)};
  }
  std::vector<Diagnostic> found = entry.diagnostics;
  Options own = applied(all, entry.choices);
  own.project = entry.project;
  const auto inputs = gather_inputs(entry.input, entry.properties, own, found);
  if (!inputs) {
    return EntryResult{NotToKeep, {}, broken_tree(entry, std::move(found))};
  }
  const Options& options = inputs->options;
  EntryResult result{NotToKeep, key_of(entry, *inputs, options), {}};
  if (options.batch.resumes) {
    auto known = kept.find(result.key);
    if (known && has_all_pages(*known)) {
      return EntryResult{Kept, std::move(result.key), std::move(*known)};
    }
  }
  EntryMonitor monitor(options.timeout, options.max_bytes);
  const Limits limits{options.max_states, options.max_bytes, &monitor};
  result.tree = checked_tree(entry, *inputs, options, limits);
  if (InterruptWatch::is_interrupted()) return std::nullopt;
  result.tree.seconds = monitor.seconds();
  result.tree.peak_bytes = peak_bytes();
  if (may_be_kept(result.tree)) result.origin = ToKeep;
  return result;
}

// The same, whatever is thrown.
std::optional<EntryResult> result_of(const BatchEntry& entry,
                                     const Options& all, KeptResults& kept) {
  EntryResult failed;
  try {
    return found_result(entry, all, kept);
  } catch (const std::bad_alloc&) {
    failed.tree = failed_tree(entry, ExitCode::Undecided, "out of memory");
  } catch (const std::exception& fault) {
    failed.tree = failed_tree(entry, ExitCode::Internal, fault.what());
  }
  return failed;
}

// A process that works on one entry: what takes too much memory, or meets a
// mistake of ours, ends alone. Its standard output is ours, so it writes to a
// pipe only.
class Worker {
 public:
  // Throws std::system_error where there is no process to be had. The batch has
  // no threads, so that everything is whole in the copy of it.
  template <class Work>
  Worker(std::size_t entry, const Work& work)
      : Worker(entry, work, new_pipe()) {}
  ~Worker() {
    if (process_ > 0) end();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  std::size_t entry() const { return entry_; }
  int output() const { return output_.number(); }
  const std::string& text() const { return text_; }

  // Asks it to end soon.
  void cancel() {
    if (!std::exchange(is_cancelled_, true)) ::kill(process_, SIGTERM);
  }

  // Takes what it has written; false at the end.
  bool read() {
    char block[1 << 16];
    const ssize_t count = output_.read(block);
    if (count > 0) text_.append(block, static_cast<std::size_t>(count));
    return count > 0;
  }

  // Waits for it. The signal that has ended it, or 0.
  int end() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  [[noreturn]] static void fail() {
    throw std::system_error(errno, std::generic_category());
  }

  // Its end to read from, and that to write to.
  static std::array<int, 2> new_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail();
    return ends;
  }

  template <class Work>
  Worker(std::size_t entry, const Work& work, std::array<int, 2> ends)
      : entry_(entry), output_(ends[0]) {
    const OpenFile input(ends[1]);
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ < 0) fail();
    if (process_ > 0) return;
    ::setpgid(0, 0);  // Ctrl-C is for the batch, which tells its workers
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    const bool is_wanted = ::getppid() == parent;  // not killed already
    // What is thrown must not get into the batch's own code, of which this is a
    // copy: it ends the process.
    const auto run = [&]() noexcept { input.write(work()); };
    if (is_wanted) run();
    ::_exit(0);
  }

  std::size_t entry_;
  pid_t process_ = -1;
  OpenFile output_;
  bool is_cancelled_ = false;
  std::string text_;
};

// The result of an entry whose worker has ended without one, by a signal if it
// is not 0.
ReportedTree ended_tree(const BatchEntry& entry, int signal) {
  // SIGKILL is what the kernel does when there is no memory left.
  if (signal == SIGKILL || signal == SIGTERM) {
    return failed_tree(
        entry, ExitCode::Undecided,
        "killed, by the system for want of memory or by somebody");
  }
  return failed_tree(
      entry, ExitCode::Internal,
      signal == 0 ? "the check has ended without a result"
                  : fmt::format("the check was ended by signal {}", signal));
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
    build_identity();  // found once here, not by each worker
    for (std::size_t next = 0;;) {
      while (next < entries_.size() && workers_.size() < options_.batch.jobs &&
             !is_cancelled(next) && begin(next)) {
        ++next;
      }
      if (workers_.empty()) break;
      await_workers();
      for (const auto& worker : workers_) {
        if (is_cancelled(worker->entry())) worker->cancel();
      }
    }
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
  // False where another worker has to end before there can be one more.
  bool begin(std::size_t entry) {
    const auto work = [this, entry] {
      const auto result = result_of(entries_[entry], options_, kept_);
      return result ? sent_text(*result) : std::string();
    };
    try {
      workers_.push_back(std::make_unique<Worker>(entry, work));
      progress_.begin(entry, entries_[entry].name);
    } catch (const std::system_error&) {
      if (!workers_.empty()) return false;
      // No process at all is to be had: here, then.
      settle(entry, result_of(entries_[entry], options_, kept_), 0);
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
    progress_.tell();
    if (::poll(files.data(), files.size(), kMilliseconds) <= 0) return;
    for (std::size_t i = files.size(); i-- > 0;) {
      if (files[i].revents == 0 || workers_[i]->read()) continue;
      const auto worker = std::move(workers_[i]);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
      const int signal = worker->end();
      settle(worker->entry(), received(worker->text()), signal);
    }
  }

  // Without a result: the signal that has ended the worker, or 0.
  void settle(std::size_t entry, std::optional<EntryResult> result,
              int signal) {
    progress_.end(entry);
    if (!result) {
      if (is_cancelled(entry)) return;
      return finish(entry, ended_tree(entries_[entry], signal));
    }
    if (result->origin == EntryResult::Origin::Kept) {
      kept_.use(result->key);
      ++resumed_;
    } else if (result->origin == EntryResult::Origin::ToKeep) {
      kept_.add(result->key, result->tree);
    }
    finish(entry, std::move(result->tree));
  }

  void finish(std::size_t entry, ReportedTree tree) {
    if (options_.batch.stops_early && fails(tree)) {
      last_ = std::min(last_, entry);
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
  std::size_t resumed_ = 0;
  std::size_t last_;  // no entry behind this one is run
  std::vector<std::unique_ptr<Worker>> workers_;
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
