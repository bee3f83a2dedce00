// SPDX-License-Identifier: MIT
//
// Leaves are rounded boxes, nodes with children plain ones. The order of
// children is the order in which they are ticked, so Graphviz is told to keep
// it. Labels are HTML to Mermaid, and a few more characters have a meaning in
// them; each of those is written by its number.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "model/tree/node_types.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/pictures/written.hpp"
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
    {"#d3d7dc", "#14181f", "»",
     "M2.2 2.2l3.8 3.8-3.8 3.8M6 2.2l3.8 3.8-3.8 3.8", ""},
}};

std::string tip_of(const RecordedNode& node) {
  return fmt::format("{} {}, line {}", one_line(node.type), one_line(node.name),
                     node.line);
}

// The label of a node, and below it what is written there.
std::vector<std::string> label_lines(const WrittenNodes& written,
                                     std::size_t node,
                                     const std::string& label) {
  constexpr std::size_t kLongest = 60;
  std::vector<std::string> lines = {label};
  const std::string more = one_line(written.at(node));
  if (!more.empty()) lines.push_back(shortened(more, kLongest));
  return lines;
}

std::string dot_begin(std::string_view title) {
  return fmt::format(
      "digraph run {{\n"
      "  rankdir=LR;\n  ordering=out;\n  label={};\n  labelloc=t;\n"
      "  fontname=\"Helvetica\";\n"
      "  node [shape=box, fontname=\"Helvetica\", fontsize=10, height=0.3, "
      "color=\"{}\"];\n"
      "  edge [color=\"{}\", arrowsize=0.5];\n",
      quoted(title), kLineColor, kLineColor);
}

std::string edge_lines(const Children& children, std::string_view arrow,
                       std::string_view end) {
  std::string text;
  for (std::size_t n = 0; n < children.size(); ++n) {
    for (const std::uint32_t child : children[n]) {
      text += fmt::format("  n{} {} n{}{}\n", n, arrow, child, end);
    }
  }
  return text;
}

std::string node_line(const RecordedRun& run, const RecordedState& state,
                      std::size_t node, const std::string& label,
                      bool has_children) {
  const PhaseLook& look = look_of(state.phases[node]);
  const bool is_stale = state.is_stale[node];
  const RecordedNode& recorded = run.nodes[node];
  return fmt::format(
      "  n{} [label={}, tooltip={}, style=\"filled{}{}\", fillcolor=\"{}\", "
      "fontcolor=\"{}\"];\n",
      node, quoted(fmt::format("{} {}", look.glyph, label)),
      quoted(tip_of(recorded)), has_children ? "" : ",rounded",
      is_stale ? ",dashed" : "", is_stale ? faded(look.fill) : look.fill,
      is_stale ? kFadedInk : look.ink);
}

std::string mermaid_escaped(std::string_view text) {
  constexpr std::string_view kMeaningful = "\"#%&<>`\\";
  std::string result;
  for (const char c : text) {
    const bool is_plain = kMeaningful.find(c) == std::string_view::npos;
    result +=
        is_plain ? std::string(1, c) : fmt::format("#{};", static_cast<int>(c));
  }
  return result;
}

std::string mermaid_node(std::size_t number, bool is_leaf,
                         std::string_view label) {
  return fmt::format("  n{}{}\"{}\"{}", number, is_leaf ? "(" : "[", label,
                     is_leaf ? ")" : "]");
}

std::string class_name(Phase phase, bool is_stale) {
  return std::string(phase_name(phase)) + (is_stale ? "_before" : "");
}

std::string class_lines() {
  std::string text;
  for (std::size_t p = 0; p < kPhaseNames.size(); ++p) {
    const auto phase = static_cast<Phase>(p);
    const PhaseLook& look = look_of(phase);
    text +=
        fmt::format("  classDef {} fill:{},color:{},stroke:{}\n",
                    class_name(phase, false), look.fill, look.ink, kLineColor);
    text += fmt::format(
        "  classDef {} fill:{},color:{},stroke:{},stroke-dasharray:3 3\n",
        class_name(phase, true), faded(look.fill), kFadedInk, kLineColor);
  }
  return text;
}

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

std::vector<std::string> node_labels(const RecordedRun& run) {
  const Children children = children_of(run);
  std::map<std::string_view, std::size_t> bearers;
  for (const RecordedNode& node : run.nodes) ++bearers[node.name];
  std::vector<std::string> labels;
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const RecordedNode& node = run.nodes[n];
    const std::string type = one_line(node.type);
    std::string label = one_line(node.name);
    const bool says_type = label.starts_with(type);
    if (bearers[node.name] > 1) label += fmt::format("@{}", node.line);
    if (!children[n].empty()) {
      const auto known =
          std::ranges::find(kNodeTypes, node.type, &NodeTypeInfo::name);
      if (!says_type) label += fmt::format(" ({})", type);
      if (known != kNodeTypes.end() && !known->sign.empty()) {
        label = fmt::format("{} {}", known->sign, label);
      }
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

std::string dot_tree(const RecordedRun& run) {
  const Children children = children_of(run);
  const WrittenNodes written(run);
  const std::vector<std::string> labels = node_labels(run);
  std::string text = dot_begin(run.tree);
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    std::string label;
    for (const std::string& line : label_lines(written, n, labels[n])) {
      const std::string part = btcheck::quoted(line);
      label += (label.empty() ? "" : "\\n") + part.substr(1, part.size() - 2);
    }
    text += fmt::format("  n{} [label=\"{}\", tooltip={}{}];\n", n, label,
                        quoted(tip_of(run.nodes[n])),
                        children[n].empty() ? ", style=rounded" : "");
  }
  return text + edge_lines(children, "->", ";") + "}\n";
}

std::string dot_text(const RecordedRun& run, std::size_t state) {
  assert(state < run.states.size());
  const Children children = children_of(run);
  std::string text = dot_begin(
      fmt::format("{} {}, tick {}, step {}", one_line(run.verdict),
                  one_line(run.property), run.states[state].tick, state));
  const std::vector<std::string> labels = node_labels(run);
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    text +=
        node_line(run, run.states[state], n, labels[n], !children[n].empty());
  }
  return text + edge_lines(children, "->", ";") + "}\n";
}

std::string mermaid_tree(const RecordedRun& run) {
  const Children children = children_of(run);
  const WrittenNodes written(run);
  const std::vector<std::string> labels = node_labels(run);
  std::string text = "flowchart LR\n";
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    std::string label;
    for (const std::string& line : label_lines(written, n, labels[n])) {
      label += (label.empty() ? "" : "<br>") + mermaid_escaped(line);
    }
    text += mermaid_node(n, children[n].empty(), label) + "\n";
  }
  return text + edge_lines(children, "-->", "");
}

std::string mermaid_text(const RecordedRun& run, std::size_t state) {
  assert(state < run.states.size());
  const RecordedState& shown = run.states[state];
  const Children children = children_of(run);
  const std::vector<std::string> labels = node_labels(run);
  std::string text = "flowchart LR\n";
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const bool is_leaf = children[n].empty();
    const std::string label = mermaid_escaped(
        fmt::format("{} {}", look_of(shown.phases[n]).glyph, labels[n]));
    text += fmt::format("{}:::{}\n", mermaid_node(n, is_leaf, label),
                        class_name(shown.phases[n], shown.is_stale[n]));
  }
  return text + edge_lines(children, "-->", "") + class_lines();
}

}  // namespace btcheck
