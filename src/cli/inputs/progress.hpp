// SPDX-License-Identifier: MIT
//
// Clocks, signals and the progress line: what a search knows of the outside.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>

#include "check/bind/verdict.hpp"
#include "cli/inputs/process_limits.hpp"

namespace btcheck {

enum class ProgressStyle : std::uint8_t {
  Silent,
  Lines,     // a line at 1, 2, 5, 10, 30, 60 s and then each minute
  Rewritten  // one line, rewritten five times a second
};

// From construction to destruction the first SIGINT is remembered, the second
// ends the program. There is one at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  // May be asked by any thread.
  static bool is_interrupted();
};

// When, after `now`, the next line of progress is written to a pipe; in
// seconds.
double next_line_after(double now);

// Watches one or more searches, and SIGINT, which ends them.
class Monitor : public SearchMonitor {
 public:
  Monitor(ProgressStyle style, double timeout_seconds, std::uint64_t max_bytes);
  ~Monitor() override;
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  StopReason observe(const SearchProgress& progress) override;
  bool may_tell() override;

  // Who is told how the search goes on, after a tenth of a second and then each
  // second, whatever the style.
  using Listener = std::function<void(const SearchProgress&, double seconds)>;
  void tell(Listener listener) { listener_ = std::move(listener); }

  double seconds() const { return limits_.seconds(); }
  // Takes the progress line off the terminal.
  void clear();

 private:
  struct Sample {
    double at;
    std::uint64_t expanded;
  };

  bool is_due(double now);
  std::string line(const SearchProgress& progress, double now);

  InterruptWatch interrupt_;
  ProgressStyle style_;
  std::uint64_t max_bytes_;
  ProcessLimits limits_;
  std::deque<Sample> samples_;  // of the last ten seconds
  double next_line_ = 0.1;
  Listener listener_;
  double next_told_ = 0.1;
  std::uint64_t last_frontier_ = 0;
  bool has_line_ = false;
};

}  // namespace btcheck
