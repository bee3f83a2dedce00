// SPDX-License-Identifier: MIT
//
// A run, asked what happened in it: the facts that explanations rest on.
// Nothing here concludes: each question is answered by the edges that fired
// and by the values that variables have in the states between.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
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
  std::optional<StepRange> loop() const {
    if (run.loop == kNoLoop) return std::nullopt;
    return StepRange{run.loop, run.steps.size()};
  }

  // Not a step of time.
  bool is_edge(std::size_t step) const {
    return run.steps[step].step.edge != kTimeStep;
  }
  // The automaton that moves, where it is an edge.
  const Automaton* mover(std::size_t step) const {
    if (!is_edge(step)) return nullptr;
    return &network.owner_of_edge(run.steps[step].step.edge);
  }
  bool moves(std::size_t step, NodeId node) const {
    const Automaton* automaton = mover(step);
    return automaton && automaton->kind == AutomatonKind::Node &&
           automaton->node == node;
  }
  // The last step before `before` in which it does.
  std::optional<std::size_t> last_move(NodeId node, std::size_t before) const {
    while (before-- > 0) {
      if (moves(before, node)) return before;
    }
    return std::nullopt;
  }
  // The node that the step brings into a location of the role, if any.
  std::optional<NodeId> entering(std::size_t step, LocationRole role) const {
    if (!is_edge(step)) return std::nullopt;
    return node_entering(network, run.steps[step].step.edge, role);
  }
  bool enters(std::size_t step, NodeId node, LocationRole role) const {
    return entering(step, role) == node;
  }
  // An edge, and the locations that its mover leaves and reaches.
  const Edge& edge(std::size_t step) const {
    return network.edge(run.steps[step].step.edge);
  }
  const Location& source(std::size_t step) const {
    return mover(step)->source(edge(step));
  }
  const Location& target(std::size_t step) const {
    return mover(step)->target(edge(step));
  }

  // In some of these steps; and the last of them.
  bool enters(StepRange steps, NodeId node, LocationRole role) const {
    return last_entering(steps, node, role).has_value();
  }
  std::optional<std::size_t> last_entering(StepRange steps, NodeId node,
                                           LocationRole role) const {
    for (std::size_t i = steps.end; i > steps.begin; --i) {
      if (enters(i - 1, node, role)) return i - 1;
    }
    return std::nullopt;
  }

  NodeStatus status(std::size_t state, NodeId node) const {
    const VariableId status = network.node_status[index(node)];
    return static_cast<NodeStatus>(run.state(state).variables[index(status)]);
  }
  int value(std::size_t state, StateVariableId variable) const {
    const VariableId read = network.state_variable[index(variable)];
    return run.state(state).variables[index(read)];
  }

  // Of a state, from the start of the run.
  int time(std::size_t state) const {
    int time = 0;
    for (std::size_t i = 0; i < state; ++i) time += run.steps[i].step.elapsed;
    return time;
  }
  // "in tick 2", "at time 3" of a step; "" where no time passes.
  std::string when(std::size_t step) const;
  // The short names of nodes: "a, b and c".
  std::string name(NodeId node) const { return short_name(tree, node); }
  std::string names(const std::vector<NodeId>& nodes) const;
};

template <class Id>
bool contains(const std::vector<Id>& ids, Id id) {
  return std::ranges::find(ids, id) != ids.end();
}

// What an explanation may look at.
struct Case : Story {
  const Subjects& subjects;
  // The part of the run in which something is missing: its loop, else what
  // follows the trigger, else the last unit of time.
  StepRange part;
};

// The rules that explain a run by what the control nodes do, each a sentence
// or "".
namespace reasons {

std::string runs_for_ever(const Case& about);
std::string passes_over(const Case& about);
std::string halts_sibling(const Case& about);
std::string is_skipped(const Case& about);
std::string has_ended(const Case& about);
std::string nobody_moves(const Case& about);

}  // namespace reasons

}  // namespace btcheck
