// SPDX-License-Identifier: MIT
//
// A run, asked what happened in it: the facts that explanations rest on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Steps begin to end - 1 of a run; step i leads from state i to state i + 1.
struct StepRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct Story {
  const BehaviorTree& tree;
  const Network& network;
  const Run& run;

  StepRange all() const { return {0, run.steps.size()}; }
  // The loop; nothing when the run is finite.
  std::optional<StepRange> loop() const;

  // Not a step of time.
  bool is_edge(std::size_t step) const;
  // The automaton that moves, where it is an edge.
  const Automaton* mover(std::size_t step) const;
  bool moves(std::size_t step, NodeId node) const;
  // The last step before `before` in which it does.
  std::optional<std::size_t> last_move(NodeId node, std::size_t before) const;
  // The node that the step brings into a location of the role, if any.
  std::optional<NodeId> entering(std::size_t step, LocationRole role) const;
  bool enters(std::size_t step, NodeId node, LocationRole role) const {
    return entering(step, role) == node;
  }
  // The node answers.
  bool answers(std::size_t step, NodeId node) const;
  // An edge, and the locations that its mover leaves and reaches.
  const Edge& edge(std::size_t step) const;
  const Location& source(std::size_t step) const;
  const Location& target(std::size_t step) const;

  // In some of these steps; and the last of them.
  bool enters(StepRange steps, NodeId node, LocationRole role) const;
  std::optional<std::size_t> last_entering(StepRange steps, NodeId node,
                                           LocationRole role) const;

  NodeStatus status(std::size_t state, NodeId node) const;
  int value(std::size_t state, StateVariableId variable) const;
  std::string value_name(std::size_t state, StateVariableId variable) const;

  // "in tick 2", "at time 3" of a step; "" where no time passes.
  std::string when(std::size_t step) const;
  // The short names of nodes: "a, b and c".
  std::string name(NodeId node) const { return short_name(tree, node); }
  std::string names(const std::vector<NodeId>& nodes) const;
};

template <class Id>
bool contains(const std::vector<Id>& ids, Id id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool reads(const Expression& expression, StateVariableId variable);

// What an explanation may look at.
struct Case : Story {
  const Subjects& subjects;
  // The part of the run in which something is missing: its loop, else what
  // follows the trigger, else the last unit of time.
  StepRange part;
};

// The rules that explain a run, each a sentence or "".
namespace reasons {

// What the control nodes do (control.cpp).
std::string runs_for_ever(const Case& about);
std::string passes_over(const Case& about);
std::string halts_sibling(const Case& about);
std::string has_ended(const Case& about);
std::string nobody_moves(const Case& about);

}  // namespace reasons

}  // namespace btcheck
