// SPDX-License-Identifier: MIT
//
// A Sequence that resumes its running child does not come past the guards to
// the left again, however long that child runs ("control flow nodes with
// memory": Colledanchise and Ögren, Behavior Trees in Robotics and AI, 2018,
// section 1.3.2). The tree tells which guards are concerned, a run that it
// happens.
#include "check/questions/watches.hpp"

#include <algorithm>

#include "check/findings/facts.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

StateVector copied(StateView state) { return {state.begin(), state.end()}; }

// The nodes whose answer may be another one later, if anybody asked again.
class Guards {
 public:
  explicit Guards(const BehaviorTree& tree)
      : tree_(tree), writers_(tree.variables.size()) {
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      const Node& node = tree.nodes[n];
      const bool is_asked =
          node.type == NodeType::Condition || is_taken_for_condition(node) ||
          node.type == NodeType::SetSV ||
          (node.type == NodeType::Eval && !node.assignment) ||
          (node.type == NodeType::Script && node.answers_value);
      if (is_asked) guards_.push_back(NodeId{n});
    }
  }

  // Calls found(guard) for those left of an action under every node above it
  // that resumes, until it returns true. Returns whether it has.
  template <class Found>
  bool any_of(NodeId action, Found&& found) {
    for (NodeId node = action; !tree_.node(node).is_root();
         node = tree_.node(node).parent) {
      const Node& parent = tree_.node(tree_.node(node).parent);
      if (info_of(parent.type).beside != Beside::None) continue;
      // In pre-order the subtrees to the left are all that lies in between.
      for (auto at = std::ranges::lower_bound(guards_, parent.children[0]);
           at != guards_.end() && *at < node; ++at) {
        ask_budget();
        if (may_go_stale(*at, action) && found(*at)) return true;
      }
    }
    return false;
  }

 private:
  bool may_go_stale(NodeId guard, NodeId running) {
    const Node& node = tree_.node(guard);
    if (node.type == NodeType::Script) return is_written_while(guard, running);
    if (node.type != NodeType::Eval) return true;
    const auto terms = node.expression.terms();
    return std::ranges::any_of(terms, [&](const Term& term) {
      return can_change_while(term, running);
    });
  }

  bool can_change_while(const Term& term, NodeId running) {
    const auto number = static_cast<std::uint32_t>(term.operand);
    if (term.operation == Operation::Status) {
      return is_ticked_while(tree_, NodeId{number}, running);
    }
    if (term.operation != Operation::Variable) return false;
    const Writers& writers = writers_of(StateVariableId{number});
    return writers.moves_freely ||
           std::ranges::any_of(writers.nodes, [&](NodeId writer) {
             return is_ticked_while(tree_, writer, running);
           });
  }

  // An entry that a script asks for, while something else runs.
  bool is_written_while(NodeId script, NodeId running) {
    if (entry_writers_.empty()) {
      entry_writers_.resize(tree_.entries.size());
      for (const EntryUse& use : tree_.entry_uses) {
        if (use.writes) entry_writers_[use.entry].push_back(use.node);
      }
    }
    // By node, so those of one stand together.
    auto use =
        std::ranges::lower_bound(tree_.entry_uses, script, {}, &EntryUse::node);
    for (; use != tree_.entry_uses.end() && use->node == script; ++use) {
      if (!use->reads || use->when) continue;
      const auto& writers = entry_writers_[use->entry];
      const bool changes = std::ranges::any_of(writers, [&](NodeId writer) {
        ask_budget();
        return is_ticked_while(tree_, writer, running);
      });
      if (changes) return true;
    }
    return false;
  }

  struct Writers {
    bool moves_freely = false;
    std::vector<NodeId> nodes;
  };

  // Worked out for those that are read.
  const Writers& writers_of(StateVariableId variable) {
    std::optional<Writers>& known = writers_[index(variable)];
    if (known) return *known;
    known.emplace();
    known->moves_freely = moves_freely(tree_, variable);
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (writes(tree_.nodes[n], variable)) known->nodes.push_back(NodeId{n});
    }
    return *known;
  }

  const BehaviorTree& tree_;
  std::vector<NodeId> guards_;  // ascending
  std::vector<std::optional<Writers>> writers_;
  std::vector<std::vector<NodeId>> entry_writers_;  // once one is asked for
};

bool may_run(const Network& network, NodeId node) {
  return network.automaton(node)
      .find_location(LocationRole::Running)
      .has_value();
}

// When a run's nodes enter their locations.
class Entries {
 public:
  Entries(const BehaviorTree& tree, const Network& network,
          const std::vector<Step>& steps)
      : of_node_(tree.nodes.size()) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i].edge == kTimeStep) continue;
      const Automaton& owner = network.owner_of_edge(steps[i].edge);
      if (owner.kind != AutomatonKind::Node) continue;
      const Edge& taken = owner.edges[steps[i].edge - owner.first_edge];
      of_node_[index(owner.node)].push_back({owner.target(taken).role, i});
    }
  }

  // The last of the steps from `begin` up to `end` with which the node enters
  // the location.
  std::optional<std::size_t> last(NodeId node, LocationRole role,
                                  std::size_t begin, std::size_t end) const {
    const std::vector<Entry>& entries = of_node_[index(node)];
    for (auto at = entries.rbegin(); at != entries.rend(); ++at) {
      if (at->step < begin) break;
      if (at->step < end && at->role == role) return at->step;
    }
    return std::nullopt;
  }

  // The first step after the last one with which the node ends.
  std::size_t start_of_activation(NodeId node) const {
    const std::vector<Entry>& entries = of_node_[index(node)];
    for (auto at = entries.rbegin(); at != entries.rend(); ++at) {
      if (at->role == LocationRole::Success ||
          at->role == LocationRole::Failure ||
          at->role == LocationRole::Halted) {
        return at->step + 1;
      }
    }
    return 0;
  }

 private:
  struct Entry {
    LocationRole role{};
    std::size_t step = 0;
  };
  std::vector<std::vector<Entry>> of_node_;  // in the order of the steps
};

// A reactive or parallel node with neither :halt nor :wait decides over the
// heads of children that still run; on the robot they go on, without a parent
// that cares (docs/semantics.md, section 4). The statuses in the state in
// which such a node gives control back tell who they are.
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

std::vector<NodeId> guarded_actions(const BehaviorTree& tree,
                                    const Network& network) {
  std::vector<NodeId> actions;
  Guards guards(tree);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (tree.nodes[n].type == NodeType::Action && may_run(network, NodeId{n}) &&
        guards.any_of(NodeId{n}, [](NodeId) { return true; })) {
      actions.push_back(NodeId{n});
    }
  }
  return actions;
}

std::vector<NodeId> stale_guards(const BehaviorTree& tree,
                                 const Network& network, NodeId action,
                                 const std::vector<Step>& run) {
  std::vector<NodeId> stale;
  const std::size_t end = run.size();
  const Entries entries(tree, network, run);
  const auto ran = entries.last(action, LocationRole::Running, 0, end);
  const auto ticked = entries.last(action, LocationRole::Tick, 0, end);
  if (!ran || !ticked || *ticked < *ran) return stale;
  Guards(tree).any_of(action, [&](NodeId guard) {
    const NodeId above = fork_of(tree, guard, action)->node;
    const std::size_t start = entries.start_of_activation(above);
    if (start <= *ran && entries.last(guard, LocationRole::Tick, start, *ran) &&
        !entries.last(guard, LocationRole::Tick, *ran, end)) {
      stale.push_back(guard);
    }
    return false;
  });
  std::ranges::sort(stale);
  return stale;
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
