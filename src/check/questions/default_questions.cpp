// SPDX-License-Identifier: MIT
//
// The first step into a node's location `success`, say, answers "can it
// succeed?"; what was never seen when the search is done cannot happen.
#include "check/questions/default_questions.hpp"

#include <algorithm>

namespace btcheck {

// Whether the roots have ended, and how. (A fault is never missed: it is dead.)
Observed seen_by_default(const BehaviorTree& tree, const Network& network) {
  Observed seen(network);
  for (const NodeId root : tree.roots) {
    const Automaton& automaton =
        network.automaton(network.node_automaton[index(root)]);
    for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
      if (!is_end(automaton.locations[i].role)) continue;
      seen.add(equals(automaton.location, static_cast<int>(i)));
    }
  }
  return seen;
}

// Which nodes run when some other gives control back or is ticked. All of them
// stand below that node, and what they do is done by then in whatever order the
// rest of the tree moves; so it need not be seen at once.
Observed kept_for_default(const BehaviorTree& tree, const Network& network) {
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

DefaultQuestions::DefaultQuestions(const BehaviorTree& tree,
                                   const CompiledNetwork& system)
    : system_(system),
      nodes_(tree.nodes.size()),
      question_of_edge_(system.network().edge_count(), kNone),
      second_ticks_(tree, system),
      left_running_(tree, system) {
  const Network& network = system.network();
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    watch_node(network.automaton(network.node_automaton[n]), n);
  }
  for (const NodeId root : tree.roots) {
    roots_.push_back(&network.automaton(network.node_automaton[index(root)]));
  }
}

void DefaultQuestions::passed(StateId from, StateView before, Step step,
                              StateView /*after*/) {
  second_ticks_.passed(from, before, step);
  left_running_.passed(from, before, step);
  if (step.edge == kTimeStep) return;
  const std::uint32_t question = question_of_edge_[step.edge];
  if (question == kNone) return;
  FirstStep& first =
      nodes_[question / kNodeQuestionCount][question % kNodeQuestionCount];
  if (!first) first = FoundStep{from, step.edge};
}

GoOn DefaultQuestions::expanded(StateId id, StateView state, bool is_dead) {
  const auto all_roots_in = [&](auto&& is) {
    return std::all_of(
        roots_.begin(), roots_.end(),
        [&](const Automaton* root) { return is(role_in(*root, state)); });
  };
  const auto is = [](LocationRole wanted) {
    return [wanted](LocationRole role) { return role == wanted; };
  };
  const bool ended = all_roots_in(is_end);
  const bool succeeded = ended && all_roots_in(is(LocationRole::Success));
  if (!success_ && succeeded) success_ = id;
  if (!failure_ && some_root_failed(state)) failure_ = id;
  const std::optional<VariableId> fault = system_.network().fault;
  const bool is_faulty = fault && system_.value(state, *fault) != 0;
  if (is_faulty && !fault_) fault_ = id;
  // A fault ends the run as well; it is reported as such.
  ended_.push_back(ended || is_faulty);
  succeeded_.push_back(succeeded);
  if (is_dead && !ended && !is_faulty && !stuck_) stuck_ = id;
  return GoOn::Yes;
}

void DefaultQuestions::watch_node(const Automaton& automaton,
                                  std::uint32_t node) {
  for (std::uint32_t q = 0; q < kNodeQuestionCount; ++q) {
    auto location = automaton.find_location(kNodeQuestionRoles[q]);
    if (!location) continue;
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      if (automaton.edges[e].target != *location) continue;
      question_of_edge_[automaton.first_edge + e] =
          node * static_cast<std::uint32_t>(kNodeQuestionCount) + q;
    }
  }
}

LocationRole DefaultQuestions::role_in(const Automaton& root,
                                       StateView state) const {
  return root.locations[system_.value(state, root.location)].role;
}

bool DefaultQuestions::some_root_failed(StateView state) const {
  return std::any_of(roots_.begin(), roots_.end(), [&](const Automaton* root) {
    return role_in(*root, state) == LocationRole::Failure;
  });
}

}  // namespace btcheck
