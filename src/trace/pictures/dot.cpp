// SPDX-License-Identifier: MIT
//
// Leaves are rounded boxes, nodes with children plain ones. The order of
// children is the order in which they are ticked, so Graphviz is told to keep
// it.
#include "trace/pictures/dot.hpp"

#include <fmt/format.h>

#include <cassert>

#include "trace/pictures/phase_look.hpp"
#include "trace/run/run_walk.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// Text within double quotes.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string node_line(const RecordedRun& run, const RecordedState& state,
                      std::size_t node, bool has_children) {
  const PhaseLook& look = look_of(state.phases[node]);
  const bool is_stale = state.is_stale[node];
  const RecordedNode& recorded = run.nodes[node];
  const std::string label = node_label(recorded, has_children);
  const std::string tip = fmt::format("{} {}, line {}", one_line(recorded.type),
                                      one_line(recorded.name), recorded.line);
  return fmt::format(
      "  n{} [label={}, tooltip={}, style=\"filled{}{}\", fillcolor=\"{}\", "
      "fontcolor=\"{}\"];\n",
      node, quoted(fmt::format("{} {}", look.glyph, label)), quoted(tip),
      has_children ? "" : ",rounded", is_stale ? ",dashed" : "",
      is_stale ? faded(look.fill) : look.fill, is_stale ? kFadedInk : look.ink);
}

}  // namespace

std::string dot_text(const RecordedRun& run, std::size_t state) {
  assert(state < run.states.size());
  const Children children = children_of(run);
  const std::string title =
      fmt::format("{} {}, tick {}, step {}", one_line(run.verdict),
                  one_line(run.property), run.states[state].tick, state);
  std::string text = fmt::format(
      "digraph run {{\n"
      "  rankdir=LR;\n  ordering=out;\n  label={};\n  labelloc=t;\n"
      "  fontname=\"Helvetica\";\n"
      "  node [shape=box, fontname=\"Helvetica\", fontsize=10, height=0.3, "
      "color=\"{}\"];\n"
      "  edge [color=\"{}\", arrowsize=0.5];\n",
      quoted(title), kLineColor, kLineColor);
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    text += node_line(run, run.states[state], n, !children[n].empty());
  }
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    for (const std::uint32_t child : children[n]) {
      text += fmt::format("  n{} -> n{};\n", n, child);
    }
  }
  return text + "}\n";
}

}  // namespace btcheck
