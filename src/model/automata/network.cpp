// SPDX-License-Identifier: MIT
#include "model/automata/network.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>

namespace btcheck {
namespace {

constexpr std::array<std::string_view, 4> kTickNames = {"root", "leaves",
                                                        "nodes", "none"};

template <class Is>
std::optional<LocationId> first_location(const Automaton& automaton, Is is) {
  const auto& all = automaton.locations;
  const auto found = std::ranges::find_if(all, is);
  if (found == all.end()) return std::nullopt;
  return LocationId{static_cast<std::uint32_t>(found - all.begin())};
}

}  // namespace

Expression read(VariableId variable) {
  return Expression::variable(static_cast<std::int32_t>(index(variable)));
}

Expression equals(VariableId variable, int value) {
  return Expression::binary(Operation::Equal, read(variable),
                            Expression::constant(value));
}

Expression equals(VariableId variable, NodeStatus status) {
  return equals(variable, static_cast<int>(status));
}

Expression differs(VariableId variable, int value) {
  return Expression::binary(Operation::NotEqual, read(variable),
                            Expression::constant(value));
}

bool is_answer(LocationRole role) {
  return is_end(role) || role == LocationRole::Running;
}

bool is_end(LocationRole role) {
  return role == LocationRole::Success || role == LocationRole::Failure ||
         role == LocationRole::Skipped;
}

std::optional<LocationId> Automaton::find_location(
    std::string_view word) const {
  return first_location(
      *this, [&](const Location& each) { return each.name == word; });
}

std::optional<LocationId> Automaton::find_location(LocationRole role) const {
  return first_location(
      *this, [&](const Location& each) { return each.role == role; });
}

std::vector<std::string> Automaton::location_names() const {
  std::vector<std::string> names;
  for (const Location& each : locations) names.push_back(each.name);
  return names;
}

std::string_view tick_name(TickSemantics ticks) {
  return kTickNames[static_cast<std::size_t>(ticks)];
}

std::optional<TickSemantics> tick_semantics(std::string_view name) {
  auto found = std::ranges::find(kTickNames, name);
  if (found == kTickNames.end()) return std::nullopt;
  return static_cast<TickSemantics>(found - kTickNames.begin());
}

std::string Variable::value_name(int value) const {
  const auto position =
      static_cast<std::size_t>(std::int64_t{value} - std::int64_t{min});
  return position < value_names.size() ? value_names[position]
                                       : scale.text(value);
}

std::uint32_t Network::edge_count() const {
  return automata.empty()
             ? 0
             : automata.back().first_edge +
                   static_cast<std::uint32_t>(automata.back().edges.size());
}

void Network::number_edges() {
  std::uint32_t edges = 0;
  for (Automaton& automaton : automata) {
    automaton.first_edge = edges;
    edges += static_cast<std::uint32_t>(automaton.edges.size());
  }
}

const Automaton& Network::owner_of_edge(std::uint32_t edge) const {
  assert(edge < edge_count());
  auto after =
      std::upper_bound(automata.begin(), automata.end(), edge,
                       [](std::uint32_t number, const Automaton& automaton) {
                         return number < automaton.first_edge;
                       });
  return *std::prev(after);
}

const Edge& Network::edge(std::uint32_t number) const {
  const Automaton& owner = owner_of_edge(number);
  return owner.edges[number - owner.first_edge];
}

Expression over_network(const Network& network, const Expression& expression) {
  return expression.replaced([&](const Term& term) {
    return read(term.operation == Operation::Status
                    ? network.node_status[term.operand]
                    : network.state_variable[term.operand]);
  });
}

std::optional<NodeId> node_entering(const Network& network, std::uint32_t edge,
                                    LocationRole role) {
  const Automaton& owner = network.owner_of_edge(edge);
  if (owner.kind != AutomatonKind::Node) return std::nullopt;
  const Edge& taken = owner.edges[edge - owner.first_edge];
  const bool enters = taken.source != taken.target;
  if (!enters || owner.target(taken).role != role) return std::nullopt;
  return owner.node;
}

bool is_choice(const Network& network, std::span<const int> values,
               std::uint32_t number) {
  const LocationId source = network.edge(number).source;
  const auto may_be_taken = [&](const Edge& edge) {
    if (edge.source != source) return false;
    return edge.guard.is_true() || edge.guard.evaluate([&](const Term& term) {
      return values[static_cast<std::size_t>(term.operand)];
    }) != 0;
  };
  return std::ranges::count_if(network.owner_of_edge(number).edges,
                               may_be_taken) > 1;
}

std::optional<VariableId> local_of(const Network& network, NodeId node,
                                   LocalRole role) {
  const auto& locals = network.automaton(node).locals;
  const auto found = std::ranges::find(locals, role, [&](VariableId local) {
    return network.variable(local).local;
  });
  return found == locals.end() ? std::nullopt : std::optional(*found);
}

std::optional<AutomatonId> automaton_at(const Network& network,
                                        VariableId variable) {
  const auto owner = network.variable(variable).owner;
  return owner && network.automaton(*owner).location == variable ? owner
                                                                 : std::nullopt;
}

std::string qualified_name(const Network& network, VariableId variable) {
  const Variable& named = network.variable(variable);
  return named.owner && named.role != VariableRole::State
             ? network.automaton(*named.owner).name + "." + named.name
             : named.name;
}

std::string expression_text(const Network& network,
                            const Expression& expression) {
  auto variable_of = [&](const Term& term) {
    return VariableId{static_cast<std::uint32_t>(term.operand)};
  };
  return expression.text(
      [&](const Term& term) {
        return qualified_name(network, variable_of(term));
      },
      [&](const Term& beside, std::int32_t value) {
        return network.variable(variable_of(beside)).value_name(value);
      });
}

std::string assigned_text(const Network& network, const Assignment& update) {
  const Variable& variable = network.variable(update.variable);
  const auto constant = update.value.only(Operation::Constant);
  if (constant) return variable.value_name(*constant);
  std::string text = expression_text(network, update.value);
  if (!variable.scale.is_one()) {
    text += " (steps of " + variable.scale.text(1) + ")";
  }
  return text;
}

}  // namespace btcheck
