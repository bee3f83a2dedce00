// SPDX-License-Identifier: MIT
//
// A run as Trace Event JSON, for ui.perfetto.dev and chrome://tracing.
#pragma once

#include <cstdint>
#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

enum class ChromeForm : std::uint8_t {
  Tracks,  // a track for each node, a slice for each phase it goes through
  Stack    // who ticked whom: a slice from tick to return, one within another
};

// Each step takes one millisecond. Beside the nodes: a track with the ticks and
// one with the loop, a counter for each number and a track of values for each
// other variable, and an instant for each choice that the world outside makes.
std::string chrome_text(const RecordedRun& run, ChromeForm form);

}  // namespace btcheck
