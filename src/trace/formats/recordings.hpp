// SPDX-License-Identifier: MIT
//
// A run as a recording: MCAP for Foxglove, Lichtblick and PlotJuggler; Trace
// Event JSON for ui.perfetto.dev and chrome://tracing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// MCAP has times, a run has not: step i is this many nanoseconds times i
// after 2000-01-01 UTC, so that a player shows ten steps a second.
inline constexpr std::uint64_t kMcapBegin = 946'684'800'000'000'000;
inline constexpr std::uint64_t kMcapStep = 100'000'000;

// JSON messages, neither in chunks nor compressed, on these topics:
//   /bt/16_Action_goto_waypoint   {"status": "running", "stale": false,
//                                  "tick": 2}, the phase of a node
//   /variables/battery            {"value": "Low", "tick": 2}
//   /property/1                   {"text": …, "value": true, "tick": 2}
//   /step                         {"step": …, "event": …, "chosen": true,
//                                  "tick": 2, "state": 17}
// Each topic has a message at the beginning and where it changes, /step one for
// every step. The loop is gone through `passes` times. What the run is about
// stands in a Metadata record `btcheck`.
std::string mcap_bytes(const RecordedRun& run, int passes = 2);

// The checksum of the format, CRC-32 as in zlib.
std::uint32_t mcap_checksum(std::string_view bytes);

enum class ChromeForm : std::uint8_t {
  Tracks,  // a track for each node, a slice for each phase it goes through
  Stack    // who ticked whom: a slice from tick to return, one within another
};

// Each step takes one millisecond. Beside the nodes: a track with the ticks and
// one with the loop, a counter for each number and a track of values for each
// other variable, and an instant for each choice that the world outside makes.
std::string chrome_text(const RecordedRun& run, ChromeForm form);

}  // namespace btcheck
