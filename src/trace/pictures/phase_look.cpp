// SPDX-License-Identifier: MIT
//
// Text has a contrast of 4.5 or more on every fill, faded or not.
#include "trace/pictures/phase_look.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr std::array<PhaseLook, kPhaseNames.size()> kLooks = {{
    {"#ffffff", "#5b6470", "○", "M6 3.4a2.6 2.6 0 1 0 .01 0z", ""},
    {"#1d4f9f", "#ffffff", "◉", "M6 1.3a4.7 4.7 0 1 0 .01 0z",
     "M6 4.3a1.7 1.7 0 1 0 .01 0z"},
    {"#a6cdfa", "#14181f", "…", "",
     "M.65 6a1.35 1.35 0 1 0 2.7 0a1.35 1.35 0 1 0-2.7 0zm4 0a1.35 1.35 0 1 0 "
     "2.7 0a1.35 1.35 0 1 0-2.7 0zm4 0a1.35 1.35 0 1 0 2.7 0a1.35 1.35 0 1 "
     "0-2.7 0z"},
    {"#ffd24a", "#14181f", "↻", "M10.3 6.2a4.3 4.3 0 1 1-1.3-3.3M9.6.7v2.7H6.9",
     ""},
    {"#58bd7c", "#14181f", "✓", "M1.8 6.5l2.9 2.9 5.5-6.6", ""},
    {"#ec5b5b", "#14181f", "✗", "M2.4 2.4l7.2 7.2m0-7.2l-7.2 7.2", ""},
    {"#9d6bd3", "#14181f", "■", "", "M2.2 2.2h7.6v7.6h-7.6z"},
    {"#f7b1dc", "#14181f", "□", "M2.2 2.2h7.6v7.6h-7.6zM6 4.5v3", ""},
}};

}  // namespace

const PhaseLook& look_of(Phase phase) {
  return kLooks[static_cast<std::size_t>(phase)];
}

std::string faded(std::string_view color) {
  std::string result = "#";
  for (std::size_t at = 1; at + 1 < color.size(); at += 2) {
    unsigned part = 0;
    std::from_chars(color.data() + at, color.data() + at + 2, part, 16);
    result += fmt::format("{:02x}", 255 - (255 - part) * 3 / 10);
  }
  return result;
}

std::string node_label(const RecordedNode& node, bool has_children) {
  std::string name = one_line(node.name);
  const std::string type = one_line(node.type);
  if (!has_children || name.starts_with(type)) return name;
  return fmt::format("{} ({})", name, type);
}

}  // namespace btcheck
