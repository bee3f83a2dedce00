// SPDX-License-Identifier: MIT
//
// A run as pictures that papers and pages can hold. The nodes have the paper's
// colours, each with a glyph for its phase; what is left over from an earlier
// tick is pale and dashed.
#pragma once

#include <cstddef>
#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// One state: the tree, the variables, a legend.
std::string svg_text(const RecordedRun& run, std::size_t state);

// The whole run as a film strip: a frame for each tick, showing how it ended,
// with what the world outside chose in it. The loop is shaded; the frame in
// which the property is lost has a red border, the one that shows a witness a
// green one. Of a long run, frames in its middle are left out, which is said.
std::string svg_strip(const RecordedRun& run);

// One state in Graphviz's language. Render it with `dot -Tsvg`.
std::string dot_text(const RecordedRun& run, std::size_t state);

// One state in Mermaid's language, which GitHub draws: put it in a ```mermaid
// block.
std::string mermaid_text(const RecordedRun& run, std::size_t state);

}  // namespace btcheck
