// SPDX-License-Identifier: MIT
//
// A run, asked what happened in it: the facts that explanations rest on.
#pragma once

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

// Looks at one run, which must outlive it as tree and network must.
class Story {
 public:
  Story(const BehaviorTree& tree, const Network& network, const Run& run)
      : tree_(tree), network_(network), run_(run) {}

  const BehaviorTree& tree() const { return tree_; }
  const Network& network() const { return network_; }
  const Run& run() const { return run_; }
  StepRange all() const { return {0, run_.steps.size()}; }
  // The loop; nothing when the run is finite.
  std::optional<StepRange> loop() const;

  // Not a step of time.
  bool is_edge(std::size_t step) const;
  // The automaton that moves, where it is an edge.
  const Automaton* mover(std::size_t step) const;
  bool moves(std::size_t step, NodeId node) const;
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

  // Whether, and where last, the node enters a location of the role.
  bool enters(StepRange steps, NodeId node, LocationRole role) const;
  std::optional<std::size_t> last_entering(StepRange steps, NodeId node,
                                           LocationRole role) const;

  NodeStatus status(std::size_t state, NodeId node) const;
  int value(std::size_t state, StateVariableId variable) const;
  std::string value_name(std::size_t state, StateVariableId variable) const;

  // "in tick 2", "at time 3" of a step; "" where no time passes.
  std::string when(std::size_t step) const;

 private:
  const BehaviorTree& tree_;
  const Network& network_;
  const Run& run_;
};

// "a", "a and b", "a, b and c".
std::string enumerated(const std::vector<std::string>& names);
// The short names of nodes, enumerated.
std::string names_text(const BehaviorTree& tree,
                       const std::vector<NodeId>& nodes);

}  // namespace btcheck
