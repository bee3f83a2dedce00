// SPDX-License-Identifier: MIT
//
// Where a command's budget comes from: the clock, the memory of the process,
// and signals.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "explore/state/limits.hpp"
#include "text/budget.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// From construction to destruction the first SIGINT, SIGTERM, SIGHUP or SIGXCPU
// is remembered, the second ends the program. One within another is the same.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  // May be asked by any thread.
  static bool is_interrupted();
  // The first one ends the program from now on: whatever waits for a person or
  // for another program has nothing to tell.
  static void stand_down();
};

// The limits of --timeout and --memory, and interrupts. A search counts what it
// stores itself; here all time and all memory of the process count.
class ProcessLimits : public Budget {
 public:
  // No limits but interrupts; the clock starts now.
  ProcessLimits();

  // These limits from now on, by the clock that runs already. No limit of time
  // where `timeout` is 0. Of less than 64 MiB the program itself takes too
  // large a part: there only what searches count is kept to the limit. A tenth
  // is kept back for what is held between two looks: a store that grows is
  // there twice for a moment.
  void allow(double timeout_seconds, std::uint64_t max_bytes);
  // The clock starts again: another tree has all of its time.
  void restart();

  double seconds() const;
  // The limit that is reached now.
  StopReason reached();
  // For a moment after that, what has been found may still be told.
  bool may_tell();
  // Whether half of either limit is left.
  bool has_spare() const;
  // For the same moment after a search was stopped, nothing is spent.
  Spent look() override;

  // For those who look on from another thread: what is used up, and whether
  // the work has been told.
  Spent overdrawn() const;
  bool is_heard() const { return is_heard_; }

 private:
  // What is used up now; the first time it is noted when.
  Spent spent_now();
  bool is_time_to_look();

  std::atomic<double> timeout_ = 0;
  std::atomic<std::uint64_t> max_bytes_ = UINT64_MAX;  // but for the tenth
  std::atomic<std::uint64_t> all_bytes_ = UINT64_MAX;
  std::atomic<std::chrono::steady_clock::time_point> start_;
  double next_look_ = 0;  // at the memory of the process
  std::optional<double> stopped_at_;
  std::atomic<bool> is_heard_ = false;
};

// Those of the command that this process was started for.
ProcessLimits& limits_of_command();

// The last resort for work that asks too rarely: looks on from a thread of its
// own. Where the work has not heard for a while that it is to end, the process
// ends with exit code 3 and a line that says so, never in the middle of an
// output.
class Guard {
 public:
  // Instead of the line on standard error, `last_words` may be called.
  using LastWords = std::function<void(const BudgetSpent&)>;
  explicit Guard(const ProcessLimits& limits, LastWords last_words = {});
  ~Guard() { dismiss(); }
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

  // Whoever hears signals in a way of its own from now on, or waits for others,
  // needs none. There is one at a time.
  static void dismiss();
};

// How a stop is told (BT9003), of the file that was worked on.
Diagnostic spent_diagnostic(const BudgetSpent& spent, const std::string& file);

// The most memory the process has held so far.
std::uint64_t peak_bytes();

}  // namespace btcheck
