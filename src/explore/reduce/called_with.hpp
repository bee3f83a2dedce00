// SPDX-License-Identifier: MIT
//
// What a node may find in its own status when it is called.
//
// A Sequence resets its children before it calls one of them anew, and so none
// of them is ever called as one that has succeeded or failed. What a child does
// in that case, and what it keeps for it, makes no difference.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "explore/reduce/call_protocol.hpp"
#include "explore/state/accesses.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// Of an automaton that is called. Values are bits, the lowest value first.
struct CalledWith {
  VariableId status{};
  int lowest = 0;
  std::uint64_t entered = 0;  // the status may have when it is called
  std::uint64_t given = 0;    // of these, what the parent may have put there

  bool has(int value) const { return (entered >> (value - lowest) & 1) != 0; }
  // What it may be when it is called, if the automaton has left `value`.
  std::uint64_t after(std::uint64_t value) const {
    return entered & (value | given);
  }
};

// From the network's first state on, which may be in the midst of a run. By
// automaton; nothing of a root, and where it is not known.
std::vector<std::optional<CalledWith>> called_with(const Network& network,
                                                   const CallProtocol& protocol,
                                                   const Accesses& accesses);

}  // namespace btcheck
