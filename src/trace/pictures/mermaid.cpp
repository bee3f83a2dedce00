// SPDX-License-Identifier: MIT
//
// Labels are HTML to Mermaid, and a few more characters have a meaning in them;
// each of those is written by its number.
#include "trace/pictures/mermaid.hpp"

#include <fmt/format.h>

#include <cassert>
#include <string_view>

#include "trace/pictures/phase_look.hpp"
#include "trace/run/run_walk.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// Text within double quotes.
std::string quoted(std::string_view text) {
  constexpr std::string_view kMeaningful = "\"#&<>`\\";
  std::string result = "\"";
  for (const char c : text) {
    if (kMeaningful.find(c) == std::string_view::npos) {
      result += c;
    } else {
      result += fmt::format("#{};", static_cast<int>(c));
    }
  }
  return result + '"';
}

std::string class_name(Phase phase, bool is_stale) {
  return fmt::format("{}{}", kPhaseNames[static_cast<std::size_t>(phase)],
                     is_stale ? "_before" : "");
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

std::string mermaid_text(const RecordedRun& run, std::size_t state) {
  assert(state < run.states.size());
  const RecordedState& shown = run.states[state];
  const Children children = children_of(run);
  std::string text = "flowchart LR\n";
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    const bool is_leaf = children[n].empty();
    const std::string label =
        quoted(fmt::format("{} {}", look_of(shown.phases[n]).glyph,
                           node_label(run.nodes[n], !is_leaf)));
    text += fmt::format("  n{}{}{}{}:::{}\n", n, is_leaf ? "(" : "[", label,
                        is_leaf ? ")" : "]",
                        class_name(shown.phases[n], shown.is_stale[n]));
  }
  for (std::size_t n = 0; n < run.nodes.size(); ++n) {
    for (const std::uint32_t child : children[n]) {
      text += fmt::format("  n{} --> n{}\n", n, child);
    }
  }
  return text + class_lines();
}

}  // namespace btcheck
