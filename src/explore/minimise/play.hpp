// SPDX-License-Identifier: MIT
//
// Why two states with the same runs are not equivalent: a play in which one
// side moves, and the other cannot answer for ever.
#pragma once

#include <cstdint>
#include <vector>

#include "explore/minimise/labelled_graph.hpp"

namespace btcheck {

// One round. `first`: the side of the first state moves; else the other.
struct PlayRound {
  enum class Kind : std::uint8_t {
    Moves,    // it does what is seen as `label`, and the other answers so
    Settles,  // it makes a choice that is not seen, and the other stays
    Yields,   // it cannot answer the next move but by such a choice
    Wins,     // it can have `label`, and the other cannot
    Stays     // it can go on for ever unseen, and the other cannot
  };
  Kind kind = Kind::Wins;
  bool is_of_first = true;
  std::uint32_t label = LabelledGraph::kSilent;

  friend bool operator==(const PlayRound&, const PlayRound&) = default;
};

// Of two states that are not equivalent: a play with as few rounds as whoever
// answers as well as possible allows; it ends with Wins or Stays. The graph
// must be a quotient (partition.hpp, Branching).
std::vector<PlayRound> distinguishing_play(const LabelledGraph& graph,
                                           std::uint32_t first,
                                           std::uint32_t second);

}  // namespace btcheck
