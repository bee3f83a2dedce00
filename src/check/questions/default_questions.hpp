// SPDX-License-Identifier: MIT
//
// What the default report has to notice during its search: the first step into
// a node's location `success`, say, answers "can it succeed?"; what was never
// seen when the search is done cannot happen.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "check/questions/defaults.hpp"
#include "check/questions/watches.hpp"
#include "explore/reduce/observed.hpp"
#include "explore/search/reachability.hpp"
#include "explore/search/stored_graph.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// A question of the search that is answered by the first state found.
using FirstState = std::optional<StateId>;
// Or by the first edge taken.
using FirstStep = std::optional<FoundStep>;

// Whether the roots have ended, and how. (A fault is never missed: it is dead.)
inline Observed seen_by_default(const BehaviorTree& tree,
                                const Network& network) {
  Observed seen(network);
  for (const NodeId root : tree.roots) {
    const Automaton& automaton = network.automaton(root);
    for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
      if (!is_end(automaton.locations[i].role)) continue;
      seen.add(equals(automaton.location, static_cast<int>(i)));
    }
  }
  return seen;
}

// Beyond that, which nodes run when some other gives control back or is ticked.
// All of them stand below that node, and what they do is done by then in
// whatever order the rest of the tree moves; so it need not be seen at once.
inline Observed kept_for_default(const BehaviorTree& tree,
                                 const Network& network) {
  Observed kept = seen_by_default(tree, network);
  const auto keep = [&](NodeId node) {
    kept.add(equals(network.node_status[index(node)], NodeStatus::Running));
  };
  for (const NodeId node : may_be_left_running(tree, network)) keep(node);
  for (const GuardedAction& guarded : guarded_actions(tree, network)) {
    keep(guarded.action);
  }
  return kept;
}

// Watches the edges that fire for the questions of single nodes, the states for
// those of the tree, and keeps every step for those that need steps twice.
struct DefaultQuestions : public ReachabilityVisitor {
  DefaultQuestions(const BehaviorTree& tree, const CompiledNetwork& system)
      : nodes(tree.nodes.size()),
        second_ticks(tree, system),
        left_running(tree, system),
        system_(system),
        question_of_edge_(system.network().edge_count(), nullptr) {
    const Network& network = system.network();
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
      watch_node(network.automaton(NodeId{n}), nodes[n]);
    }
    for (const NodeId root : tree.roots) {
      roots_.push_back(&network.automaton(root));
    }
  }

  void passed(StateId from, StateView before, Step step, StateView /*after*/) {
    second_ticks.passed(from, before, step);
    left_running.passed(from, before, step);
    if (step.edge == kTimeStep) return;
    FirstStep* first = question_of_edge_[step.edge];
    if (first != nullptr && !*first) *first = FoundStep{from, step.edge};
  }

  void stepped(StateId from, Step step, StateId to) {
    graph.add(from, step, to);
  }

  GoOn expanded(StateId id, StateView state, bool is_dead) {
    const auto role = [&](const Automaton* root) {
      return root->locations[system_.value(state, root->location)].role;
    };
    const bool has_ended = std::ranges::all_of(roots_, is_end, role);
    const bool has_succeeded =
        has_ended && std::ranges::count(roots_, LocationRole::Success, role) ==
                         std::ssize(roots_);
    if (!success && has_succeeded) success = id;
    if (!failure &&
        std::ranges::count(roots_, LocationRole::Failure, role) > 0) {
      failure = id;
    }
    const std::optional<VariableId> fault_bit = system_.network().fault;
    const bool is_faulty = fault_bit && system_.value(state, *fault_bit) != 0;
    if (is_faulty && !fault) fault = id;
    // A fault ends the run as well; it is reported as such.
    ended.push_back(has_ended || is_faulty);
    succeeded.push_back(has_succeeded);
    if (is_dead && !has_ended && !is_faulty && !stuck) stuck = id;
    return GoOn::Yes;
  }

  std::size_t bytes() const {
    return graph.bytes() + (ended.size() + succeeded.size()) / 8;
  }

  std::vector<std::array<FirstStep, kNodeQuestionCount>> nodes;
  SecondTickWatch second_ticks;
  LeftRunningWatch left_running;
  std::vector<bool> ended;      // by state
  std::vector<bool> succeeded;  // by state: all roots have
  FirstState success;
  FirstState failure;
  FirstState fault;
  FirstState stuck;
  StoredGraph graph;

 private:
  void watch_node(const Automaton& automaton,
                  std::array<FirstStep, kNodeQuestionCount>& questions) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      const auto location = automaton.find_location(kNodeQuestionRoles[q]);
      for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
        if (automaton.edges[e].target != location) continue;
        question_of_edge_[automaton.first_edge + e] = &questions[q];
      }
    }
  }

  const CompiledNetwork& system_;
  std::vector<FirstStep*> question_of_edge_;  // null: none
  std::vector<const Automaton*> roots_;
};

}  // namespace btcheck
