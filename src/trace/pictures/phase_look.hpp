// SPDX-License-Identifier: MIT
//
// What the phases of a node look like in every picture.
#pragma once

#include <string>
#include <string_view>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// The paper's eight colours. Some of them look alike to many people, so each
// comes with a glyph of its own.
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

// "goto_waypoint", "fail (Fallback)": the name, and of a node with children its
// type where the name does not say it.
std::string node_label(const RecordedNode& node, bool has_children);

}  // namespace btcheck
