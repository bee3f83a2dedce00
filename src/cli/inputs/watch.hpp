// SPDX-License-Identifier: MIT
//
// What a search is given to work with: limits, a monitor that watches them and
// tells its progress, and a folder for what does not fit into memory.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>

#include "check/bind/verdict.hpp"
#include "check/check.hpp"
#include "cli/inputs/process_limits.hpp"
#include "cli/options/options.hpp"
#include "explore/state/limits.hpp"

namespace btcheck {

enum class ProgressStyle : std::uint8_t {
  Silent,
  Lines,     // a line at 1, 2, 5, 10, 30, 60 s and then each minute
  Rewritten  // one line, rewritten five times a second
};

// The line on stderr that tells how far things are. It is gone from a terminal
// when this is.
class ProgressLine {
 public:
  static constexpr double kRewriteInterval = 0.2;

  // The first is due after so many seconds.
  ProgressLine(ProgressStyle style, double first)
      : style_(style), next_(first) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool is_silent() const { return style_ == ProgressStyle::Silent; }
  bool is_due(double now) const { return !is_silent() && now >= next_; }
  void write(const std::string& text, double now);
  // Takes it off the terminal.
  void clear();

 private:
  ProgressStyle style_;
  double next_;
  bool is_there_ = false;
};

// When, after `now`, the next line of progress is written to a pipe; in
// seconds.
double next_line_after(double now);

// Watches one or more searches, and SIGINT, which ends them.
class CommandMonitor : public SearchMonitor {
 public:
  CommandMonitor(ProgressStyle style, ProcessLimits& limits,
                 std::uint64_t max_bytes);

  StopReason observe(const SearchProgress& progress) override;
  bool may_tell() override;
  bool has_spare() override;
  void found(const std::string& lines) override;

  // Called with the state of the search after a tenth of a second and then each
  // second, whatever the style.
  using Listener = std::function<void(const SearchProgress&, double seconds)>;
  void tell(Listener listener) { listener_ = std::move(listener); }

  double seconds() const { return limits_.seconds(); }
  void clear() { shown_.clear(); }

 private:
  struct Sample {
    double at;
    std::uint64_t expanded;
  };

  std::string line(const SearchProgress& progress, double now);

  ProgressLine shown_;
  std::uint64_t max_bytes_;
  ProcessLimits& limits_;
  std::deque<Sample> samples_;  // of the last ten seconds
  Listener listener_;
  double next_told_ = 0.1;
  std::uint64_t last_frontier_ = 0;
};

// Limits with a monitor behind them, and behind that the limits of the command,
// which are those of these options from now on. It stays where it is made.
struct Watch {
  explicit Watch(const Options& options);

  CommandMonitor monitor;
  Limits limits;
};

// Gives the command the limits of these options, by the clock that runs
// already.
void allow(const Options& options);

// The limit of --memory in bytes, else three quarters of what there is.
std::uint64_t memory_limit(const Options& options);

// How many of the threads that are asked for the system allows now; at least
// one.
unsigned threads_to_use(const Options& options);

// How progress is shown on stderr.
ProgressStyle progress_style(const Options& options);

CheckOptions check_options(const Options& options, const Limits& limits);

// Whether the folder of --on-disk can be written to, if there is one. Complains
// when it cannot.
bool can_use_disk(const Options& options);

// Tells why a search with --on-disk was stopped by --memory all the same.
void tell_of_disk(const Options& options, StopReason stopped);

}  // namespace btcheck
