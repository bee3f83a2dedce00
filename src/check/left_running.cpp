// SPDX-License-Identifier: MIT
//
// A reactive or parallel node with neither :halt nor :wait decides over the
// heads of children that still run; on the robot they go on, without a parent
// that cares (docs/semantics.md, section 4). The statuses in the state in
// which such a node gives control back tell who they are.
#include "check/left_running.hpp"

#include <algorithm>

namespace btcheck {
namespace {

bool may_leave_behind(const Node& node) {
  switch (node.type) {
    case NodeType::ReactiveSequence:
    case NodeType::ReactiveFallback:
    case NodeType::Parallel:
    case NodeType::ParallelAll:
      return !node.halt && !node.wait;
    default:
      return false;
  }
}

}  // namespace

LeftRunningWatch::LeftRunningWatch(const BehaviorTree& tree,
                                   const CompiledNetwork& system)
    : system_(system), watched_(system.network().edge_count()) {
  const Network& network = system.network();
  const auto watch = [&](const Pair& pair) {
    const Automaton& automaton =
        network.automaton(network.node_automaton[index(pair.above)]);
    const auto done = automaton.find_location("done");
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      if (automaton.edges[e].source != done) continue;
      watched_[automaton.first_edge + e].push_back(pair);
    }
  };
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Automaton& leaf = network.automaton(network.node_automaton[n]);
    if (!is_leaf(tree.nodes[n].type) || !leaf.find_location("running")) {
      continue;
    }
    Pair pair{NodeId{n}, NodeId{n}, {}};
    while (!tree.node(pair.above).is_root()) {
      pair.statuses.push_back(network.node_status[index(pair.above)]);
      pair.above = tree.node(pair.above).parent;
      if (may_leave_behind(tree.node(pair.above))) watch(pair);
    }
  }
}

void LeftRunningWatch::look_at(StateView state) {
  for (const FoundStep& step : noted_) {
    std::erase_if(watched_[step.step.edge], [&](const Pair& pair) {
      const NodeStatus decision =
          status(state, system_.network().node_status[index(pair.above)]);
      const bool is_left =
          (decision == NodeStatus::Success ||
           decision == NodeStatus::Failure) &&
          std::all_of(pair.statuses.begin(), pair.statuses.end(),
                      [&](VariableId each) {
                        return status(state, each) == NodeStatus::Running;
                      });
      if (is_left) found_.push_back({pair.leaf, pair.above, decision, step});
      return is_left;
    });
  }
  noted_.clear();
}

}  // namespace btcheck
