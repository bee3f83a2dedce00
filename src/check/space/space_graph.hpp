// SPDX-License-Identifier: MIT
//
// Small state spaces as graphs for other programs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

enum class GraphFormat : std::uint8_t {
  Aldebaran,  // `des (0, transitions, states)` and a line for each (CADP)
  Dot         // Graphviz
};

// Larger spaces are refused: 100,000 states, and 2,000 to be drawn.
std::uint64_t most_states(GraphFormat format);

// Every reachable state, numbered as a breadth-first search finds it, 0 being
// the initial one, and every step with the edge that is taken as its label
// (`land_btn12.tick_node -> success`) or `time`. Idle steps are left out: a
// state from which nothing leads is dead. An error (BT0007) when the space has
// more states than the format takes, or a limit stops the search. The
// diagnostic names `file`.
Result<std::string> space_graph(const Network& network, GraphFormat format,
                                const Limits& limits, std::string_view file);

}  // namespace btcheck
