// SPDX-License-Identifier: MIT
//
// When ticks begin, and which took too long.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>

namespace btcheck {

enum class TickPace : std::uint8_t {
  RealTime,  // ticks begin a period apart
  AtOnce     // one after the other
};

// A tick that takes longer than the period is an overrun: the next one begins
// when it is over, and from there on they are a period apart again.
class TickClock {
 public:
  using Clock = std::chrono::steady_clock;

  TickClock(TickPace pace, std::chrono::milliseconds period)
      : pace_(pace), period_(period), next_(Clock::now()) {}

  // Waits for the beginning of the next tick; false when `is_stopped()`, which
  // is asked now and then.
  template <class Stopped>
  bool wait(const Stopped& is_stopped) const {
    constexpr std::chrono::milliseconds kPatience{10};
    while (!is_stopped()) {
      if (pace_ == TickPace::AtOnce) return true;
      const Clock::time_point now = Clock::now();
      if (now >= next_) return true;
      std::this_thread::sleep_until(std::min(next_, now + kPatience));
    }
    return false;
  }

  void begin_tick() { begun_ = Clock::now(); }
  void end_tick() {
    const Clock::time_point now = Clock::now();
    longest_ = std::max<std::chrono::nanoseconds>(longest_, now - begun_);
    if (pace_ == TickPace::AtOnce) return;
    const bool is_overrun = now - begun_ > period_;
    if (is_overrun) ++overruns_;
    next_ = is_overrun ? now : begun_ + period_;
  }

  std::uint64_t overruns() const { return overruns_; }
  std::chrono::nanoseconds longest() const { return longest_; }

 private:
  TickPace pace_;
  std::chrono::milliseconds period_;
  Clock::time_point next_;
  Clock::time_point begun_{};
  std::uint64_t overruns_ = 0;
  std::chrono::nanoseconds longest_{0};
};

}  // namespace btcheck
