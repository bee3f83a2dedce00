// SPDX-License-Identifier: MIT
//
// Who calls whom: the tree, read off the automata; and where an automaton may
// go round by itself.
#pragma once

#include <optional>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck {

// Whether a called automaton gives control back with the edge: it returns to
// its first location. The turn of a root never ends.
bool ends_turn(const Automaton& automaton, const Edge& edge);

// A node's automaton moves only while its gate, the field `caller`, is 1. The
// protocol holds when each gate is raised by one other automaton only, the
// parent; when the parent, having raised it, stands in a location that no edge
// leaves before the gate is 0 again; and when only the automaton itself lowers
// it, on returning to its first location. Then, while an automaton is called,
// all above it are blocked; and one that can move has no child that is called.
// Every mapping keeps the protocol; reductions rest on it and check it here.
class CallProtocol {
 public:
  explicit CallProtocol(const Network& network);

  bool holds() const { return holds_; }
  // The automaton whose gate the variable is.
  std::optional<AutomatonId> gated(VariableId variable) const {
    return gated_[index(variable)];
  }
  std::optional<AutomatonId> parent(AutomatonId automaton) const {
    return parents_[index(automaton)];
  }
  // Ascending.
  const std::vector<AutomatonId>& children(AutomatonId automaton) const {
    return children_[index(automaton)];
  }
  // Whether one of the two stands above the other, or they are the same.
  bool is_line(AutomatonId one, AutomatonId other) const {
    return is_above(one, other) || is_above(other, one);
  }
  // The locations in which a parent waits for an automaton it has called.
  const std::vector<LocationId>& waits_for(AutomatonId called) const {
    return waits_[index(called)];
  }

 private:
  bool is_above(AutomatonId upper, AutomatonId lower) const {
    for (std::optional<AutomatonId> at = lower; at; at = parent(*at)) {
      if (*at == upper) return true;
    }
    return false;
  }
  // `waits`: no edge leaves the target of `edge` before the variable is 0.
  bool accept(const Automaton& writer, AutomatonId self, const Edge& edge,
              const Assignment& update, AutomatonId gated, bool waits);

  std::vector<std::optional<AutomatonId>> gated_;    // by VariableId
  std::vector<std::optional<AutomatonId>> parents_;  // by AutomatonId
  std::vector<std::vector<AutomatonId>> children_;   // by AutomatonId
  std::vector<std::vector<LocationId>> waits_;       // by AutomatonId
  bool holds_ = true;
};

// Locations such that an automaton that moves for ever within one turn, and no
// time passes, comes to one of them again and again. The protocol must hold.
std::vector<LocationId> cycle_heads(const Network& network,
                                    const CallProtocol& protocol,
                                    AutomatonId automaton);

}  // namespace btcheck
