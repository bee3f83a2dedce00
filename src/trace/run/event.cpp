// SPDX-License-Identifier: MIT
//
// Most steps of a run are the frame at work: a node is called, a child gives
// control back. What a reader wants to know is what the leaves answered, what
// became of the variables, who was halted and how the tree ended; that is read
// off the edge's target and off the variables that differ.
#include "trace/run/event.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace btcheck {
namespace {

// ": battery := Low" for each state variable that a step changed; a SetSV or
// := that leaves its variable as it was is told as well.
std::string changes(const BehaviorTree& tree, const Network& network,
                    const Valuation& before, const RunStep& step) {
  std::string text;
  for (std::size_t v = 0; v < tree.variables.size(); ++v) {
    const std::size_t variable = index(network.state_variable[v]);
    const int value = step.after.variables[variable];
    bool is_assigned = value != before.variables[variable];
    for (const Assignment& update : network.edge(step.step.edge).updates) {
      is_assigned |= update.variable == network.state_variable[v];
    }
    if (!is_assigned) continue;
    text += fmt::format("{} {} := {}", text.empty() ? ":" : ",",
                        tree.variables[v].name,
                        tree.variables[v].value_name(value));
  }
  return text;
}

// Whether something else could have happened instead: the node had another
// step to take in the state `before`.
bool is_choice(const Network& network, const Valuation& before,
               std::uint32_t number) {
  const Automaton& automaton = network.owner_of_edge(number);
  const auto may_be_taken = [&](const Edge& edge) {
    return edge.source == network.edge(number).source &&
           (edge.guard.is_true() || edge.guard.evaluate([&](const Term& term) {
             return before.variables[static_cast<std::size_t>(term.operand)];
           }) != 0);
  };
  return std::count_if(automaton.edges.begin(), automaton.edges.end(),
                       may_be_taken) > 1;
}

std::optional<Event> leaf_event(const BehaviorTree& tree,
                                const Network& network, NodeId node,
                                const Location& location,
                                const Valuation& before, const RunStep& step) {
  const std::string name = short_name(tree, node);
  const NodeType type = tree.node(node).type;
  if (location.role == LocationRole::Halted)
    return Event{name + " is halted", false};
  if (location.role == LocationRole::Error) {
    return Event{name + ": " + network.edge(step.step.edge).label, false};
  }
  if (!is_answer(location.role)) return std::nullopt;
  const std::string assigned = changes(tree, network, before, step);
  const bool is_open = is_choice(network, before, step.step.edge);
  if (type == NodeType::SetSV ||
      (type == NodeType::Eval && !assigned.empty())) {
    return Event{name + assigned, is_open};
  }
  return Event{fmt::format("{} -> {}{}", name, location.name, assigned),
               is_open};
}

// What a node does, but for the effects of postconditions.
std::optional<Event> own_event(const BehaviorTree& tree, const Network& network,
                               const Valuation& before, const RunStep& step) {
  const Automaton& automaton = network.owner_of_edge(step.step.edge);
  const Edge& edge = network.edge(step.step.edge);
  if (automaton.kind == AutomatonKind::StateVariable) {
    return Event{edge.label, true};
  }
  if (automaton.kind == AutomatonKind::Timer) {
    return Event{"the time of " + short_name(tree, automaton.node) + " is up",
                 edge.when.lower != edge.when.upper};
  }
  const Node& node = tree.node(automaton.node);
  const Location& location = automaton.target(edge);
  if (edge.asks_world && is_choice(network, before, step.step.edge)) {
    const bool answers = is_leaf(node.type) && is_answer(location.role);
    return Event{fmt::format("{}{}{}: {}", short_name(tree, automaton.node),
                             answers ? " -> " : "",
                             answers ? location.name : "", edge.label),
                 true};
  }
  if (is_leaf(node.type)) {
    return leaf_event(tree, network, automaton.node, location, before, step);
  }
  if (node.is_root() && is_end(location.role)) {
    return Event{fmt::format("{} -> {}", node.name, location.name), false};
  }
  if (location.role == LocationRole::Error) {
    return Event{
        fmt::format("{}: {}", short_name(tree, automaton.node), edge.label),
        false};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Event> event_of(const BehaviorTree& tree, const Network& network,
                              const Valuation& before, const RunStep& step) {
  if (step.step.edge == kTimeStep) return std::nullopt;
  if (auto event = own_event(tree, network, before, step)) return event;
  const std::string effects = changes(tree, network, before, step);
  if (effects.empty()) return std::nullopt;
  const Automaton& mover = network.owner_of_edge(step.step.edge);
  return Event{short_name(tree, mover.node) + effects, false};
}

std::string step_text(const Network& network, const RunStep& step) {
  if (step.step.edge == kTimeStep) return std::string(kTimePasses);
  const Automaton& automaton = network.owner_of_edge(step.step.edge);
  const Edge& edge = network.edge(step.step.edge);
  std::string text =
      fmt::format("{}: {} -> {}", automaton.name, automaton.source(edge).name,
                  automaton.target(edge).name);
  for (const Assignment& update : edge.updates) {
    text += fmt::format(
        ", {} := {}", qualified_name(network, update.variable),
        network.variable(update.variable)
            .value_name(step.after.variables[index(update.variable)]));
  }
  return text;
}

}  // namespace btcheck
