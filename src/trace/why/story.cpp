// SPDX-License-Identifier: MIT
//
// Nothing here concludes: each question is answered by the edges that fired
// and by the values that variables have in the states between.
#include "trace/why/story.hpp"

#include <fmt/format.h>

#include "trace/why/why.hpp"

namespace btcheck {

std::optional<StepRange> Story::loop() const {
  if (run.loop == kNoLoop) return std::nullopt;
  return StepRange{run.loop, run.steps.size()};
}

bool Story::is_edge(std::size_t step) const {
  return run.steps[step].step.edge != kTimeStep;
}

const Automaton* Story::mover(std::size_t step) const {
  if (!is_edge(step)) return nullptr;
  return &network.owner_of_edge(run.steps[step].step.edge);
}

bool Story::moves(std::size_t step, NodeId node) const {
  const Automaton* automaton = mover(step);
  return automaton && automaton->kind == AutomatonKind::Node &&
         automaton->node == node;
}

std::optional<std::size_t> Story::last_move(NodeId node,
                                            std::size_t before) const {
  while (before-- > 0) {
    if (moves(before, node)) return before;
  }
  return std::nullopt;
}

std::optional<NodeId> Story::entering(std::size_t step,
                                      LocationRole role) const {
  if (!is_edge(step)) return std::nullopt;
  return node_entering(network, run.steps[step].step.edge, role);
}

bool Story::answers(std::size_t step, NodeId node) const {
  return moves(step, node) && is_answer(target(step).role);
}

const Edge& Story::edge(std::size_t step) const {
  return network.edge(run.steps[step].step.edge);
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
  const VariableId status = network.node_status[index(node)];
  return static_cast<NodeStatus>(run.state(state).variables[index(status)]);
}

int Story::value(std::size_t state, StateVariableId variable) const {
  const VariableId read = network.state_variable[index(variable)];
  return run.state(state).variables[index(read)];
}

std::string Story::value_name(std::size_t state,
                              StateVariableId variable) const {
  return tree.variable(variable).value_name(value(state, variable));
}

std::string Story::when(std::size_t step) const {
  if (network.ticks == TickSemantics::None) return "";
  int time = 0;
  for (std::size_t i = 0; i <= step; ++i) time += run.steps[i].step.elapsed;
  const bool is_tick = network.ticks == TickSemantics::Root;
  if (time == 0) return "at the start";
  return fmt::format("{} {}", is_tick ? "in tick" : "at time", time);
}

bool reads(const Expression& expression, StateVariableId variable) {
  return std::ranges::any_of(expression.terms(), [&](const Term& term) {
    return term.operation == Operation::Variable &&
           static_cast<std::uint32_t>(term.operand) == index(variable);
  });
}

std::string enumerated(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  return text;
}

std::string Story::names(const std::vector<NodeId>& nodes) const {
  std::vector<std::string> all;
  for (const NodeId node : nodes) all.push_back(name(node));
  return enumerated(all);
}

}  // namespace btcheck
