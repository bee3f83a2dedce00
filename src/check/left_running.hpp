// SPDX-License-Identifier: MIT
//
// Nodes that still run although the one above them has decided.
#pragma once

#include <optional>
#include <vector>

#include "check/found_step.hpp"
#include "explore/step.hpp"
#include "model/network.hpp"
#include "model/tree.hpp"

namespace btcheck {

// A leaf that runs, as do all nodes between it and `above`, when that one has
// given control back with success or failure.
struct LeftRunningStep {
  NodeId leaf{};
  NodeId above{};
  NodeStatus decision{};
  FoundStep step;  // with which `above` gives control back
};

// Looks for the first such step for each pair of nodes. To be told of steps
// and states as a ReachabilityVisitor is.
class LeftRunningWatch {
 public:
  LeftRunningWatch(const BehaviorTree& tree, const CompiledNetwork& system);

  void stepped(StateId from, Step step, StateId to) {
    if (step.edge == kTimeStep || watched_[step.edge].empty()) return;
    noted_.push_back({from, step, to});
  }
  void expanded(StateView state) {
    if (!noted_.empty()) look_at(state);
  }

  const std::vector<LeftRunningStep>& found() const { return found_; }

 private:
  struct Pair {
    NodeId leaf{};
    NodeId above{};
    std::vector<VariableId> statuses;  // of the leaf, and up to below `above`
  };

  void look_at(StateView state);
  NodeStatus status(StateView state, VariableId variable) const {
    return static_cast<NodeStatus>(system_.value(state, variable));
  }

  const CompiledNetwork& system_;
  // By edge: the pairs not yet found whose upper node takes it last.
  std::vector<std::vector<Pair>> watched_;
  std::vector<FoundStep> noted_;  // from the state being expanded
  std::vector<LeftRunningStep> found_;
};

}  // namespace btcheck
