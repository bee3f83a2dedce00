// SPDX-License-Identifier: MIT
//
// Ways to go along a recorded run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// True while the tick, or the order to halt, is in the node or below it.
constexpr bool is_active(Phase phase) {
  return phase == Phase::Here || phase == Phase::Waiting ||
         phase == Phase::Halting;
}

// True when the last tick of the node ended in success or failure.
constexpr bool is_completed(Phase phase) {
  return phase == Phase::Success || phase == Phase::Failure;
}

// The children of each node, in order, by its number.
using Children = std::vector<std::vector<std::uint32_t>>;
Children children_of(const RecordedRun& run);

// A state as it passes by; those of the loop come again, in later ticks.
struct Passing {
  std::size_t state = 0;
  int tick = 0;
};

// The run with its loop gone through so many times, at least once.
std::vector<Passing> unrolled(const RecordedRun& run, int passes);

// For each tick that began, and for the time before the first one if nothing
// else is there, its last state. Ascending, never empty.
std::vector<std::size_t> tick_ends(const RecordedRun& run);

// The state a single picture shows: where the property is lost, else the last.
std::size_t shown_state(const RecordedRun& run);

}  // namespace btcheck
