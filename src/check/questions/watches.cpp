// SPDX-License-Identifier: MIT
#include "check/questions/watches.hpp"

#include <algorithm>

#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

StateVector copied(StateView state) { return {state.begin(), state.end()}; }

// Calls found(leaf, way) for each leaf that may run and each node above it that
// may leave it behind, with the nodes from the leaf up to below that one.
template <class Found>
void for_each_way(const BehaviorTree& tree, const Network& network,
                  Found&& found) {
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!is_leaf(tree.nodes[n].type) || !may_run(network, NodeId{n})) continue;
    std::vector<NodeId> way;
    for (NodeId at{n}; !tree.node(at).is_root(); at = tree.node(at).parent) {
      way.push_back(at);
      const NodeId above = tree.node(at).parent;
      if (may_leave_behind(tree.node(above))) found(above, way);
    }
  }
}

}  // namespace

bool may_leave_behind(const Node& node) {
  const bool decides_early = node.type == NodeType::ReactiveSequence ||
                             node.type == NodeType::ReactiveFallback ||
                             node.type == NodeType::Parallel ||
                             node.type == NodeType::ParallelAll;
  return decides_early && !node.halt && !node.wait;
}

bool may_run(const Network& network, NodeId node) {
  return network.automaton(node)
      .find_location(LocationRole::Running)
      .has_value();
}

SightingWatch::SightingWatch(const std::vector<Sighting>& sightings,
                             const CompiledNetwork& system,
                             const std::vector<bool>& asked)
    : system_(system),
      watched_(system.network().edge_count()),
      found_(sightings.size()) {
  const Network& network = system.network();
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!asked.empty() && !asked[i]) continue;
    ++open_;
    const Sighting& sighting = sightings[i];
    Watched watched{i, {}};
    for (const auto& [node, status] : sighting.with) {
      watched.needed.push_back(
          {network.node_status[index(node)], static_cast<int>(status)});
    }
    if (sighting.retried) {
      const auto tries =
          local_of(network, *sighting.retried, LocalRole::Rounds);
      if (!tries) continue;  // not counted: it cannot be seen
      watched.needed.push_back({*tries, 0, true});
    }
    const Automaton& automaton = network.automaton(sighting.node);
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      if (automaton.target(automaton.edges[e]).role != sighting.role) continue;
      watched_[automaton.first_edge + e].push_back(watched);
    }
  }
}

void SightingWatch::look_at(StateId from, StateView state, std::uint32_t edge) {
  std::erase_if(watched_[edge], [&](const Watched& watched) {
    if (found_[watched.number]) return true;
    const bool is_so =
        std::ranges::all_of(watched.needed, [&](const Needed& needed) {
          const int value =
              static_cast<int>(system_.value(state, needed.variable));
          return (value == needed.value) != needed.differs;
        });
    if (is_so) {
      found_[watched.number] = {from, edge, copied(state)};
      --open_;
    }
    return is_so;
  });
}

std::vector<NodeId> may_be_left_running(const BehaviorTree& tree,
                                        const Network& network) {
  std::vector<NodeId> nodes;
  for_each_way(tree, network, [&](NodeId, const std::vector<NodeId>& way) {
    nodes.insert(nodes.end(), way.begin(), way.end());
  });
  return nodes;
}

std::vector<std::vector<NodeId>> ways_left_running(const BehaviorTree& tree,
                                                   const Network& network) {
  std::vector<std::vector<NodeId>> ways;
  for_each_way(tree, network,
               [&](NodeId above, const std::vector<NodeId>& way) {
                 ways.push_back(way);
                 ways.back().push_back(above);
               });
  return ways;
}

LeftRunningWatch::LeftRunningWatch(const BehaviorTree& tree,
                                   const CompiledNetwork& system)
    : system_(system), watched_(system.network().edge_count()) {
  const Network& network = system.network();
  const auto watch = [&](const Pair& pair) {
    const Automaton& automaton = network.automaton(pair.above);
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

void LeftRunningWatch::look_at(StateId from, StateView state,
                               std::uint32_t edge) {
  std::erase_if(watched_[edge], [&](const Pair& pair) {
    const NodeStatus decision =
        status(state, system_.network().node_status[index(pair.above)]);
    const bool is_left =
        (decision == NodeStatus::Success || decision == NodeStatus::Failure) &&
        std::ranges::all_of(pair.statuses, [&](VariableId each) {
          return status(state, each) == NodeStatus::Running;
        });
    if (is_left) {
      found_.push_back(
          {pair.leaf, pair.above, decision, {from, edge, copied(state)}});
    }
    return is_left;
  });
}

}  // namespace btcheck
