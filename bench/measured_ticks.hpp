// SPDX-License-Identifier: MIT
//
// What ticks cost: they are measured, and allocations counted, from the second
// of a mission on. One source of a program includes it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <vector>

#include "counted_allocations.hpp"

// begin() gives a mission, a function that ticks and says whether it goes on.
template <class Begin>
void measure_ticks(std::string_view engine, const Begin& begin) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kTicks = 200'000;
  std::vector<double> times;  // microseconds
  times.reserve(kTicks);
  std::size_t allocated = 0;
  std::size_t longest = 0;  // ticks of a mission
  while (times.size() < kTicks) {
    auto mission = begin();
    bool goes_on = mission();
    std::size_t count = 1;
    for (; goes_on && times.size() < kTicks; ++count) {
      const std::size_t before = allocations;
      const auto start = Clock::now();
      goes_on = mission();
      const std::chrono::duration<double, std::micro> took =
          Clock::now() - start;
      times.push_back(took.count());
      allocated += allocations - before;
    }
    longest = std::max(longest, count);
  }
  std::ranges::sort(times);
  const auto at = [&](double part) {
    return times[static_cast<std::size_t>(part * double{kTicks - 1})];
  };
  fmt::print(
      "{}: {} ticks, {} a mission: median {:.2f} us, mean {:.2f} us, 99 % "
      "{:.2f} us; {} allocations\n",
      engine, kTicks, longest, at(0.5),
      std::accumulate(times.begin(), times.end(), 0.0) / double{kTicks},
      at(0.99), allocated);
}
