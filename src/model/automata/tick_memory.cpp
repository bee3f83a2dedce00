// SPDX-License-Identifier: MIT
#include "model/automata/tick_memory.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace btcheck {
namespace {

Assignment remembered(VariableId answer, LocationRole role) {
  const auto at = std::ranges::find(
      kAnswers, role, &std::pair<LocationRole, std::string_view>::first);
  return {answer, Expression::constant(
                      1 + static_cast<std::int32_t>(at - kAnswers.begin()))};
}

class Memory {
 public:
  explicit Memory(Network& network) : network_(network) {}

  void add(NodeId node) {
    const AutomatonId id = network_.node_automaton[index(node)];
    const VariableId answer{
        static_cast<std::uint32_t>(network_.variables.size())};
    std::vector<std::string> words = {"none"};
    for (const auto& [role, word] : kAnswers) {
      const bool occurs =
          role != LocationRole::Skipped || is_engine(network_.profile);
      if (occurs) words.emplace_back(word);
    }
    const int greatest = static_cast<int>(words.size()) - 1;
    network_.variables.push_back({VariableRole::Local, std::string(kAnswerName),
                                  kNoAnswer, greatest, kNoAnswer,
                                  std::move(words), id});
    Automaton& automaton = network_.automata[index(id)];
    automaton.locals.push_back(answer);
    for (Edge& edge : automaton.edges) {
      const LocationRole role = automaton.target(edge).role;
      const bool answers = is_answer(role) && edge.source != edge.target;
      if (answers) edge.updates.push_back(remembered(answer, role));
    }
  }

  // Wherever the root has answered: nothing is remembered any more.
  void forget_after(NodeId root, const std::vector<VariableId>& answers) {
    Automaton& automaton =
        network_.automata[index(network_.node_automaton[index(root)])];
    const VariableId own = *answer_of(network_, root);
    for (std::uint32_t l = 0; l < automaton.locations.size(); ++l) {
      if (!is_answer(automaton.locations[l].role)) continue;
      const bool is_left = std::ranges::any_of(
          automaton.edges,
          [&](const Edge& edge) { return edge.source == LocationId{l}; });
      if (!is_left) automaton.edges.push_back(last_step(LocationId{l}, own));
    }
    for (Edge& edge : automaton.edges) {
      if (!is_answer(automaton.source(edge).role)) continue;
      for (const VariableId answer : answers) {
        edge.updates.push_back({answer, Expression::constant(kNoAnswer)});
      }
    }
  }

 private:
  Edge last_step(LocationId end, VariableId own) const {
    Edge edge;
    edge.source = edge.target = end;
    edge.guard = differs(own, kNoAnswer);
    edge.when = network_.ticks == TickSemantics::None ? kAnyTime : kAtOnce;
    edge.label = "its last tick is over";
    return edge;
  }

  Network& network_;
};

}  // namespace

void remember_answers(const BehaviorTree& tree, std::span<const NodeId> nodes,
                      Network& network) {
  Memory memory(network);
  for (const NodeId root : tree.roots) {
    std::vector<NodeId> asked;
    for (const NodeId node : nodes) {
      if (root_of(tree, node) == root) asked.push_back(node);
    }
    if (!asked.empty()) asked.push_back(root);
    std::vector<VariableId> made;
    for (const NodeId node : asked) {
      if (answer_of(network, node)) continue;
      memory.add(node);
      made.push_back(*answer_of(network, node));
    }
    if (!made.empty()) memory.forget_after(root, made);
  }
  network.number_edges();
}

std::optional<VariableId> answer_of(const Network& network, NodeId node) {
  for (const VariableId local : network.automaton(node).locals) {
    if (network.variable(local).name == kAnswerName) return local;
  }
  return std::nullopt;
}

}  // namespace btcheck
