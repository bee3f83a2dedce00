// SPDX-License-Identifier: MIT
//
// A state of a run as a picture in Graphviz's language.
#pragma once

#include <cstddef>
#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// The tree in the paper's colours, each node with the glyph of its phase; what
// is left over from an earlier tick is pale and dashed. Render with `dot
// -Tsvg`.
std::string dot_text(const RecordedRun& run, std::size_t state);

}  // namespace btcheck
