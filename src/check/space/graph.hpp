// SPDX-License-Identifier: MIT
//
// The states and steps of a space as a text for other programs, which is
// written piece by piece and never held as a whole.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "check/space/quotient.hpp"
#include "check/space/step_labels.hpp"
#include "explore/reduce/observed.hpp"
#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

enum class GraphFormat : std::uint8_t {
  Aldebaran,  // `des (0, transitions, states)` and a line for each (CADP)
  Dot         // Graphviz
};

struct GraphOptions {
  GraphFormat format = GraphFormat::Aldebaran;
  Reduction reduce = Reduction::None;
  // Only without a reduction: what is not seen has the label `i`.
  std::optional<SeenAnswers> seen = std::nullopt;
};

// Takes the next piece; false: it cannot be written, and there is no use in
// going on.
using GraphSink = std::function<bool(std::string_view)>;

// More states are not drawn.
inline constexpr std::uint64_t kMostDrawn = 2'000;

// Every reachable state, numbered as a breadth-first search finds it, from 0,
// and every step with its label (StepLabels). A step of a reduced graph has the
// labels of the steps that it stands for. Idle steps are left out: a state from
// which nothing leads is dead.
//
// All states are found first, then all steps once more, one state after the
// other. So what is held is what a search holds, and nothing is written where a
// limit stops the search. Returns an error, which names `file`, where that is
// so, or there are more than kMostDrawn states to be drawn; and where the time
// is up while steps are written.
std::vector<Diagnostic> write_space_graph(const Network& network,
                                          const GraphOptions& options,
                                          const Limits& limits,
                                          std::string_view file,
                                          const GraphSink& sink);

// The same of a quotient.
std::vector<Diagnostic> write_quotient(const SpaceQuotient& quotient,
                                       GraphFormat format,
                                       std::string_view file,
                                       const GraphSink& sink);

}  // namespace btcheck
