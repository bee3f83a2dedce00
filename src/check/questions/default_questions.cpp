// SPDX-License-Identifier: MIT
#include "check/questions/default_questions.hpp"

#include <algorithm>
#include <utility>

namespace btcheck {

Observed seen_by_default(const BehaviorTree& tree, const Network& network,
                         const QuestionsAsked& asked) {
  Observed seen(network);
  if (!asked.of_tree) return seen;
  for (const NodeId root : tree.roots) {
    const Automaton& automaton = network.automaton(root);
    for (std::size_t i = 0; i < automaton.locations.size(); ++i) {
      if (!is_end(automaton.locations[i].role)) continue;
      seen.add(equals(automaton.location, static_cast<int>(i)));
    }
  }
  for (const Automaton& automaton : network.automata) {
    for (const Edge& edge : automaton.edges) {
      if (!edge.is_like_time) continue;
      seen.add(equals(automaton.location, static_cast<int>(edge.source)));
    }
  }
  return seen;
}

Observed kept_for_default(const BehaviorTree& tree, const Network& network,
                          const std::vector<Sighting>& sightings,
                          const QuestionsAsked& asked) {
  Observed kept = seen_by_default(tree, network, asked);
  const auto keep = [&](NodeId node) {
    kept.add(equals(network.node_status[index(node)], NodeStatus::Running));
  };
  for (const NodeId node : may_be_left_running(tree, network)) keep(node);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!asked.has_sighting(i)) continue;
    const Sighting& sighting = sightings[i];
    for (const auto& [node, status] : sighting.with) {
      kept.add(equals(network.node_status[index(node)], status));
    }
    if (!sighting.retried) continue;
    for (const VariableId local : network.automaton(*sighting.retried).locals) {
      kept.add(equals(local, 0));
    }
  }
  return kept;
}

DefaultQuestions::DefaultQuestions(const BehaviorTree& tree,
                                   const CompiledNetwork& system,
                                   const std::vector<Sighting>& watched,
                                   QuestionsAsked what)
    : asked(std::move(what)),
      nodes(tree.nodes.size()),
      left_running(tree, system),
      sightings(watched, system, asked.sightings),
      system_(system),
      question_of_edge_(system.network().edge_count(), nullptr),
      is_like_time_(system.network().edge_count(), false) {
  const Network& network = system.network();
  for (const Automaton& automaton : network.automata) {
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      is_like_time_[automaton.first_edge + e] = automaton.edges[e].is_like_time;
    }
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) watch_node(NodeId{n});
  for (const NodeId root : tree.roots) {
    roots_.push_back(&network.automaton(root));
  }
}

std::vector<StateId> DefaultQuestions::found_from() const {
  std::vector<StateId> states;
  const auto add = [&](const FirstStep& step) {
    if (step) states.push_back(step->from);
  };
  for (const FirstState& state : {success, failure, fault, stuck}) {
    if (state) states.push_back(*state);
  }
  for (const auto& questions : nodes) {
    for (const FirstStep& step : questions) add(step);
  }
  for (const FirstStep& step : sightings.found()) add(step);
  for (const LeftRunningStep& each : left_running.found()) add(each.step);
  return states;
}

void DefaultQuestions::watch_node(NodeId node) {
  const Automaton& automaton = system_.network().automaton(node);
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    if (!asked.has(node, q)) continue;
    ++open_;
    const auto location = automaton.find_location(kNodeQuestionRoles[q]);
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      if (automaton.edges[e].target != location) continue;
      question_of_edge_[automaton.first_edge + e] = &nodes[index(node)][q];
    }
  }
}

}  // namespace btcheck
