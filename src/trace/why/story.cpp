// SPDX-License-Identifier: MIT
//
// Nothing here concludes: each question is answered by the edges that fired
// and by the values that variables have in the states between.
#include "trace/why/story.hpp"

#include <fmt/format.h>

namespace btcheck {

std::optional<StepRange> Story::loop() const {
  if (run_.loop == kNoLoop) return std::nullopt;
  return StepRange{run_.loop, run_.steps.size()};
}

bool Story::is_edge(std::size_t step) const {
  return run_.steps[step].step.edge != kTimeStep;
}

const Automaton* Story::mover(std::size_t step) const {
  if (!is_edge(step)) return nullptr;
  return &network_.owner_of_edge(run_.steps[step].step.edge);
}

bool Story::moves(std::size_t step, NodeId node) const {
  const Automaton* automaton = mover(step);
  return automaton && automaton->kind == AutomatonKind::Node &&
         automaton->node == node;
}

std::optional<NodeId> Story::entering(std::size_t step,
                                      LocationRole role) const {
  if (!is_edge(step)) return std::nullopt;
  return node_entering(network_, run_.steps[step].step.edge, role);
}

bool Story::answers(std::size_t step, NodeId node) const {
  return moves(step, node) && is_answer(target(step).role);
}

const Edge& Story::edge(std::size_t step) const {
  return network_.edge(run_.steps[step].step.edge);
}

const Location& Story::source(std::size_t step) const {
  return mover(step)->source(edge(step));
}

const Location& Story::target(std::size_t step) const {
  return mover(step)->target(edge(step));
}

bool Story::enters(StepRange steps, NodeId node, LocationRole role) const {
  return last_entering(steps, node, role).has_value();
}

std::optional<std::size_t> Story::last_entering(StepRange steps, NodeId node,
                                                LocationRole role) const {
  for (std::size_t i = steps.end; i > steps.begin; --i) {
    if (enters(i - 1, node, role)) return i - 1;
  }
  return std::nullopt;
}

NodeStatus Story::status(std::size_t state, NodeId node) const {
  const VariableId status = network_.node_status[index(node)];
  return static_cast<NodeStatus>(run_.state(state).variables[index(status)]);
}

int Story::value(std::size_t state, StateVariableId variable) const {
  const VariableId read = network_.state_variable[index(variable)];
  return run_.state(state).variables[index(read)];
}

std::string Story::value_name(std::size_t state,
                              StateVariableId variable) const {
  return tree_.variable(variable).value_name(value(state, variable));
}

std::string Story::when(std::size_t step) const {
  if (network_.ticks == TickSemantics::None) return "";
  int time = 0;
  for (std::size_t i = 0; i <= step; ++i) time += run_.steps[i].step.elapsed;
  const bool is_tick = network_.ticks == TickSemantics::Root;
  if (time == 0) return "at the start";
  return fmt::format("{} {}", is_tick ? "in tick" : "at time", time);
}

std::string enumerated(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  return text;
}

std::string names_text(const BehaviorTree& tree,
                       const std::vector<NodeId>& nodes) {
  std::vector<std::string> names;
  for (const NodeId node : nodes) names.push_back(short_name(tree, node));
  return enumerated(names);
}

}  // namespace btcheck
