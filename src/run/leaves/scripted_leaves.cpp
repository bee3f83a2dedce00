// SPDX-License-Identifier: MIT
#include "run/leaves/scripted_leaves.hpp"

#include <algorithm>
#include <vector>

#include "model/tree/node_types.hpp"

namespace btcheck {

Reply ScriptedLeaves::ask(const LeafQuestion& question) {
  ScriptCursor& cursor = cursors_.of_leaf(tree_, question.node);
  if (cursor.sequence == nullptr) return {};
  const int value = cursor.next().value;
  cursor.advance();
  return Reply::answer(value);
}

// Each free variable takes one result before each tick of the first tree.
std::optional<VariableMove> ScriptedLeaves::next_move(int tick, StateView) {
  if (moved_in_tick_ != tick) next_variable_ = 0;
  moved_in_tick_ = tick;
  while (next_variable_ < cursors_.of_variable.size()) {
    const StateVariableId variable{
        static_cast<std::uint32_t>(next_variable_++)};
    ScriptCursor& cursor = cursors_.of_variable[index(variable)];
    if (cursor.sequence == nullptr || !moves_freely(tree_, variable)) continue;
    const int value = cursor.next().value;
    cursor.advance();
    return VariableMove{variable, value};
  }
  return std::nullopt;
}

// Also what the model allows when the time of the action is up, if it may be,
// and what is a fault.
Reply RandomLeaves::ask(const LeafQuestion& question) {
  const Node& leaf = tree_.node(question.node);
  std::vector<int> results;
  bool is_open = question.may_be_due;
  for (const PossibleAnswer& possible : question.possible) {
    is_open |= possible.result == kFaultResult;
    if (possible.result != kFaultResult) results.push_back(possible.result);
  }
  const auto add = [&](bool is_allowed, NodeStatus answer) {
    const int result = static_cast<int>(answer);
    if (is_open && is_allowed &&
        std::ranges::find(results, result) == results.end()) {
      results.push_back(result);
    }
  };
  if (leaf.type != NodeType::SetSV) {
    add(leaf.contract.may_succeed, NodeStatus::Success);
    add(leaf.contract.may_fail, NodeStatus::Failure);
  }
  if (results.empty()) return {};
  return Reply::answer(results[random_.below(results.size())]);
}

// In one tick of four, one of the moves that are possible.
std::optional<VariableMove> RandomLeaves::next_move(int tick, StateView now) {
  if (moved_in_tick_ == tick) return std::nullopt;
  moved_in_tick_ = tick;
  if (random_.below(4) != 0) return std::nullopt;
  std::vector<VariableMove> moves;
  for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
    const StateVariableId id{v};
    const Network& network = system_.network();
    if (!moves_freely(tree_, id) || !tree_.variable(id).is_enumeration()) {
      continue;
    }
    const AutomatonId mover = *network.state_automaton[v];
    for (const Edge& edge : network.automaton(mover).edges) {
      if (edge.source == system_.location(now, mover) &&
          edge.when.lower <= system_.clock(now, mover)) {
        moves.push_back({id, static_cast<int>(index(edge.target))});
      }
    }
  }
  if (moves.empty()) return std::nullopt;
  return moves[random_.below(moves.size())];
}

}  // namespace btcheck
