// SPDX-License-Identifier: MIT
//
// A reactive or parallel node with neither :halt nor :wait decides over the
// heads of children that still run; on the robot they go on, without a parent
// that cares (docs/semantics.md, section 4). The statuses in the state in
// which such a node gives control back tell who they are.
#include "check/questions/left_running.hpp"
#include "model/tree/node_types.hpp"

#include <algorithm>

namespace btcheck {
namespace {

bool may_leave_behind(const Node& node) {
  const bool decides_early = node.type == NodeType::ReactiveSequence ||
                             node.type == NodeType::ReactiveFallback ||
                             node.type == NodeType::Parallel ||
                             node.type == NodeType::ParallelAll;
  return decides_early && !node.halt && !node.wait;
}

// Calls found(leaf, way) for each leaf that may run and each node above it that
// may leave it behind, with the nodes from the leaf up to below that one.
template <class Found>
void for_each_way(const BehaviorTree& tree, const Network& network,
                  Found&& found) {
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Automaton& leaf = network.automaton(network.node_automaton[n]);
    if (!is_leaf(tree.nodes[n].type) ||
        !leaf.find_location(LocationRole::Running)) {
      continue;
    }
    std::vector<NodeId> way;
    for (NodeId at{n}; !tree.node(at).is_root(); at = tree.node(at).parent) {
      way.push_back(at);
      const NodeId above = tree.node(at).parent;
      if (may_leave_behind(tree.node(above))) found(above, way);
    }
  }
}

}  // namespace

std::vector<NodeId> may_be_left_running(const BehaviorTree& tree,
                                        const Network& network) {
  std::vector<NodeId> nodes;
  for_each_way(tree, network, [&](NodeId, const std::vector<NodeId>& way) {
    nodes.insert(nodes.end(), way.begin(), way.end());
  });
  return nodes;
}

LeftRunningWatch::LeftRunningWatch(const BehaviorTree& tree,
                                   const CompiledNetwork& system)
    : system_(system), watched_(system.network().edge_count()) {
  const Network& network = system.network();
  const auto watch = [&](const Pair& pair) {
    const Automaton& automaton =
        network.automaton(network.node_automaton[index(pair.above)]);
    const auto done = automaton.find_location(LocationRole::Done);
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      if (automaton.edges[e].source != done) continue;
      watched_[automaton.first_edge + e].push_back(pair);
    }
  };
  for_each_way(tree, network,
               [&](NodeId above, const std::vector<NodeId>& way) {
                 Pair pair{way.front(), above, {}};
                 for (const NodeId node : way) {
                   pair.statuses.push_back(network.node_status[index(node)]);
                 }
                 watch(pair);
               });
}

void LeftRunningWatch::look_at(StateView state, FoundStep step) {
  std::erase_if(watched_[step.edge], [&](const Pair& pair) {
    const NodeStatus decision =
        status(state, system_.network().node_status[index(pair.above)]);
    const bool is_left =
        (decision == NodeStatus::Success || decision == NodeStatus::Failure) &&
        std::all_of(pair.statuses.begin(), pair.statuses.end(),
                    [&](VariableId each) {
                      return status(state, each) == NodeStatus::Running;
                    });
    if (is_left) found_.push_back({pair.leaf, pair.above, decision, step});
    return is_left;
  });
}

}  // namespace btcheck
