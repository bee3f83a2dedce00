// SPDX-License-Identifier: MIT
//
// Two watches of the search behind the default report: for what sightings
// describe; and for leaves that still run when a node above them has given
// control back.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/findings/suspicion.hpp"
#include "explore/state/step.hpp"
#include "explore/state/transition_system.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// All that is needed to tell a run that ends with an edge: the way on which the
// search came to `from`, and the single steps from there up to this edge.
struct FoundStep {
  StateId from{};
  std::uint32_t edge = 0;
  // The state in which it is taken; empty where that makes no difference.
  StateVector before = {};
};

// Looks for the first step that each sighting describes. To be told of single
// steps as a ReachabilityVisitor is.
class SightingWatch {
 public:
  // Of those that are asked for, by number; with none said, for all.
  SightingWatch(const std::vector<Sighting>& sightings,
                const CompiledNetwork& system, const std::vector<bool>& asked);

  bool is_heard(Step step) const {
    return step.edge != kTimeStep && !watched_[step.edge].empty();
  }
  void passed(StateId from, StateView before, Step step) {
    if (is_heard(step)) look_at(from, before, step.edge);
  }

  // By the number of the sighting.
  const std::vector<std::optional<FoundStep>>& found() const { return found_; }
  bool has_all() const { return open_ == 0; }

 private:
  // What has to be so: variable, value, and whether it has to be another one.
  struct Needed {
    VariableId variable{};
    int value = 0;
    bool differs = false;
  };
  struct Watched {
    std::size_t number = 0;
    std::vector<Needed> needed;
  };

  void look_at(StateId from, StateView state, std::uint32_t edge);

  const CompiledNetwork& system_;
  std::vector<std::vector<Watched>> watched_;  // by edge: those not yet found
  std::vector<std::optional<FoundStep>> found_;
  std::size_t open_ = 0;  // that are asked for and have not been found
};

// A leaf that runs, as do all nodes between it and `above`, when that one has
// given control back with success or failure.
struct LeftRunningStep {
  NodeId leaf{};
  NodeId above{};
  NodeStatus decision{};
  FoundStep step;  // with which `above` gives control back
};

// A reactive or parallel node with neither :halt nor :wait decides over the
// heads of children that still run; on the robot they go on, without a parent
// that cares (docs/semantics.md, section 4). The statuses in the state in which
// such a node gives control back tell who they are.
bool may_leave_behind(const Node& node);
// Whether the node can be running at all.
bool may_run(const Network& network, NodeId node);

// The nodes that such a step is about, whether there is one or not: they run,
// and may be left running.
std::vector<NodeId> may_be_left_running(const BehaviorTree& tree,
                                        const Network& network);
// By pair of nodes: the leaf and all that stand above it, up to the upper node.
std::vector<std::vector<NodeId>> ways_left_running(const BehaviorTree& tree,
                                                   const Network& network);

// Looks for the first such step for each pair of nodes. To be told of single
// steps as a ReachabilityVisitor is.
class LeftRunningWatch {
 public:
  LeftRunningWatch(const BehaviorTree& tree, const CompiledNetwork& system);

  bool is_heard(Step step) const {
    return step.edge != kTimeStep && !watched_[step.edge].empty();
  }
  void passed(StateId from, StateView before, Step step) {
    if (is_heard(step)) look_at(from, before, step.edge);
  }

  const std::vector<LeftRunningStep>& found() const { return found_; }

 private:
  struct Pair {
    NodeId leaf{};
    NodeId above{};
    std::vector<VariableId> statuses;  // of the leaf, and up to below `above`
  };

  void look_at(StateId from, StateView state, std::uint32_t edge);
  NodeStatus status(StateView state, VariableId variable) const {
    return static_cast<NodeStatus>(system_.value(state, variable));
  }

  const CompiledNetwork& system_;
  // By edge: the pairs not yet found whose upper node takes it last.
  std::vector<std::vector<Pair>> watched_;
  std::vector<LeftRunningStep> found_;
};

}  // namespace btcheck
