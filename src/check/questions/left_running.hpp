// SPDX-License-Identifier: MIT
//
// Nodes that still run although the one above them has decided.
#pragma once

#include <optional>
#include <vector>

#include "check/questions/found_step.hpp"
#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// A leaf that runs, as do all nodes between it and `above`, when that one has
// given control back with success or failure.
struct LeftRunningStep {
  NodeId leaf{};
  NodeId above{};
  NodeStatus decision{};
  FoundStep step;  // with which `above` gives control back
};

// The nodes that such a step is about, whether there is one or not: they run,
// and may be left running.
std::vector<NodeId> may_be_left_running(const BehaviorTree& tree,
                                        const Network& network);

// Looks for the first such step for each pair of nodes. To be told of single
// steps as a ReachabilityVisitor is.
class LeftRunningWatch {
 public:
  LeftRunningWatch(const BehaviorTree& tree, const CompiledNetwork& system);

  void passed(StateId from, StateView before, Step step) {
    if (step.edge == kTimeStep || watched_[step.edge].empty()) return;
    look_at(before, {from, step.edge});
  }

  const std::vector<LeftRunningStep>& found() const { return found_; }

 private:
  struct Pair {
    NodeId leaf{};
    NodeId above{};
    std::vector<VariableId> statuses;  // of the leaf, and up to below `above`
  };

  void look_at(StateView state, FoundStep step);
  NodeStatus status(StateView state, VariableId variable) const {
    return static_cast<NodeStatus>(system_.value(state, variable));
  }

  const CompiledNetwork& system_;
  // By edge: the pairs not yet found whose upper node takes it last.
  std::vector<std::vector<Pair>> watched_;
  std::vector<LeftRunningStep> found_;
};

}  // namespace btcheck
