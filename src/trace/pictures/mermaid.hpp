// SPDX-License-Identifier: MIT
//
// A state of a run as a picture in Mermaid's language, which GitHub draws.
#pragma once

#include <cstddef>
#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// A flowchart from left to right with a class for each phase, and for each that
// is left over from an earlier tick. Put it in a ```mermaid block.
std::string mermaid_text(const RecordedRun& run, std::size_t state);

}  // namespace btcheck
