// SPDX-License-Identifier: MIT
//
// Locals that count rounds up to their greatest value, and the network in which
// it is left open how many rounds there are. What that network says of all
// numbers at once is argued in docs/reductions.md, "For every count".
#pragma once

#include <optional>
#include <string_view>

#include "model/automata/network.hpp"

namespace btcheck {

struct RoundCounter {
  AutomatonId automaton{};  // of the node that counts
  VariableId variable{};    // from 0 to its greatest value, which is not 0
};

// The counter of a node: nobody else reads or writes it, it is set to 0 or to
// one more, never beyond its greatest value, and all that guards ask of it is
// whether it has that value. Nothing where the node has none, or asks more.
std::optional<RoundCounter> round_counter(const Network& network, NodeId node);

// The local made by leave_rounds_open: 0 since the counter was last set to 0,
// else 1 and 2 in turn, with each round that was not counted. Rules cannot name
// it.
inline constexpr std::string_view kUncounted = "uncounted rounds";

// Makes 0 stand for "at least as many rounds are left as the counter counts":
// there a round may be counted, or not.
void leave_rounds_open(const RoundCounter& counter, Network& network);

}  // namespace btcheck
