// SPDX-License-Identifier: MIT
//
// A run as pictures that papers and pages can hold.
#pragma once

#include <cstddef>
#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// One state: the tree in the paper's colours with a glyph for each phase, what
// is left over from an earlier tick pale and dashed; the variables; a legend.
std::string svg_text(const RecordedRun& run, std::size_t state);

// The whole run as a film strip: a frame for each tick, showing how it ended,
// with what the world outside chose in it. The loop is shaded; the frame in
// which the property is lost has a red border, the one that shows a witness a
// green one. Of a long run, frames in its middle are left out, which is said.
std::string svg_strip(const RecordedRun& run);

}  // namespace btcheck
