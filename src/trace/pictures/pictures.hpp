// SPDX-License-Identifier: MIT
//
// A run as pictures that papers and pages can hold. The nodes have the paper's
// colours, each with a glyph for its phase; what is left over from an earlier
// tick is pale and dashed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// The tree alone, before any run; what is written at each node stands below its
// name. They need no states.
std::string svg_tree(const RecordedRun& run);
std::string dot_tree(const RecordedRun& run);
std::string mermaid_tree(const RecordedRun& run);

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

// What all pictures share. Some of the colours look alike to many
// people, so each comes with a glyph of its own.
struct PhaseLook {
  std::string_view fill;   // "#rrggbb"
  std::string_view ink;    // of the text on it
  std::string_view glyph;  // one character
  // The glyph of the trace viewer as SVG path data in a square of 12 by 12:
  // what is drawn with a line, and what is filled.
  std::string_view lines;
  std::string_view spots;
};
const PhaseLook& look_of(Phase phase);

// Of the letters on boxes, a monospaced font of 11 px.
inline constexpr double kLetterWidth = 6.7;

inline constexpr std::string_view kLineColor = "#5b6470";
inline constexpr std::string_view kFadedInk = "#414a55";

// A colour on its way to white: of a phase left over from an earlier tick. What
// is written on it has kFadedInk.
std::string faded(std::string_view color);

// "goto_waypoint", "→ fail@19 (Sequence)", by number: the name as rules and
// reports have it, with the line where several nodes bear it; of a node with
// children its type where the name does not say it, and that type's sign.
std::vector<std::string> node_labels(const RecordedRun& run);

}  // namespace btcheck
