// SPDX-License-Identifier: MIT
#include "run/engine/leaf_table.hpp"

#include <algorithm>

#include "check/simulate/simulation.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// What the edge gives the variable.
std::optional<int> given_by(const Edge& edge, VariableId variable) {
  for (const Assignment& update : edge.updates) {
    const auto value = update.value.only(Operation::Constant);
    if (update.variable == variable && value) return *value;
  }
  return std::nullopt;
}

int status_of(LocationRole role) {
  switch (role) {
    case LocationRole::Success:
      return static_cast<int>(NodeStatus::Success);
    case LocationRole::Failure:
      return static_cast<int>(NodeStatus::Failure);
    case LocationRole::Running:
      return static_cast<int>(NodeStatus::Running);
    case LocationRole::Inner:
    case LocationRole::Start:
    case LocationRole::Tick:
    case LocationRole::Evaluate:
    case LocationRole::Call:
    case LocationRole::Called:
    case LocationRole::Skipped:
    case LocationRole::Error:
    case LocationRole::Halt:
    case LocationRole::Halted:
    case LocationRole::Done:
      break;
  }
  return kFaultResult;
}

}  // namespace

LeafTable::LeafTable(const BehaviorTree& tree, const CompiledNetwork& system)
    : tree_(tree),
      system_(system),
      conditions_(system.network(), system.layout()),
      leaves_(tree.nodes.size()) {
  const Network& network = system.network();
  for (std::uint32_t place = 0; place < network.edge_count(); ++place) {
    edges_.push_back(facts_of(place));
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (network.automata[a].kind == AutomatonKind::Timer) {
      timers_.push_back(AutomatonId{a});
    }
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (is_scripted(tree.nodes[n].type)) leaves_[n] = facts_of(NodeId{n});
  }
}

EdgeFacts LeafTable::facts_of(std::uint32_t place) const {
  const Network& network = system_.network();
  EdgeFacts facts;
  facts.number = system_.edge_number(place);
  const Edge& edge = network.edge(facts.number);
  const Automaton& owner = network.owner_of_edge(facts.number);
  facts.owner =
      AutomatonId{static_cast<std::uint32_t>(&owner - network.automata.data())};
  facts.when = edge.when;
  facts.source = owner.source(edge).role;
  facts.target = owner.target(edge).role;
  if (owner.kind == AutomatonKind::StateVariable) {
    const VariableId moved =
        network.state_variable[index(owner.state_variable)];
    facts.result =
        given_by(edge, moved).value_or(static_cast<int>(index(edge.target)));
  }
  if (owner.kind != AutomatonKind::Node) return facts;
  const Node& node = tree_.node(owner.node);
  facts.is_root = node.is_root();
  // What the arguments divide by is no answer.
  facts.is_answer =
      is_scripted(node.type) && facts.source != LocationRole::Start &&
      (btcheck::is_answer(facts.target) || facts.target == LocationRole::Error);
  if (!facts.is_answer) return facts;
  facts.result =
      node.type == NodeType::SetSV
          ? given_by(edge, network.state_variable[index(node.variable)])
                .value_or(kFaultResult)
          : status_of(facts.target);
  return facts;
}

LeafFacts LeafTable::facts_of(NodeId id) {
  const Node& node = tree_.node(id);
  const Network& network = system_.network();
  LeafFacts facts;
  facts.requirement =
      conditions_.compile(over_network(network, node.contract.requirement));
  for (const Argument& argument : node.arguments) {
    facts.given.push_back({&argument, 0});
    if (!argument.known) continue;
    facts.arguments.push_back(conditions_.compile_value(
        over_network(network, argument.known->value)));
  }
  for (const AutomatonId timer : timers_) {
    if (network.automaton(timer).node == id) facts.timer = timer;
  }
  return facts;
}

void LeafTable::give_arguments(NodeId node, StateView state) {
  LeafFacts& facts = *leaves_[index(node)];
  auto program = facts.arguments.begin();
  for (GivenArgument& given : facts.given) {
    if (!given.argument->known) continue;
    given.value = conditions_.value(*program++, state.data());
  }
}

bool LeafTable::is_over(AutomatonId root, LocationId location) const {
  return std::ranges::none_of(
      system_.network().automaton(root).edges, [&](const Edge& edge) {
        return edge.source == location && edge.target != location;
      });
}

}  // namespace btcheck
