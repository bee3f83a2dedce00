// SPDX-License-Identifier: MIT
#include "explore/components/composition.hpp"

#include <utility>

namespace btcheck {

Composition::Composition(Components& components, std::vector<bool> kept)
    : components_(&components),
      network_(components.network()),
      is_component_(network_.automata.size(), false),
      is_inside_(network_.automata.size(), false),
      hidden_(network_.variables.size(), false) {
  const CallProtocol& protocol = components.protocol();
  for (std::uint32_t a = 0; a < kept.size(); ++a) {
    if (!kept[a]) continue;
    for (auto above = protocol.parent(AutomatonId{a});
         above && !kept[index(*above)]; above = protocol.parent(*above)) {
      kept[index(*above)] = true;
    }
  }
  for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
    Variable unused{VariableRole::Local, "memory", 0, 0, 0, {}, AutomatonId{a}};
    network_.variables.push_back(std::move(unused));
  }
  // From above: what stands above a component does not.
  for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
    if (!protocol.parent(AutomatonId{a})) place(AutomatonId{a}, kept);
  }
  network_.number_edges();
}

bool Composition::place(AutomatonId root, const std::vector<bool>& kept) {
  const Component* component =
      kept[index(root)] ? nullptr : components_->of(root);
  if (component == nullptr) {
    for (const AutomatonId child : components_->children(root)) {
      place(child, kept);
    }
    return false;
  }
  const Network& whole = components_->network();
  std::vector<AutomatonId> inside = {root};
  for (std::size_t next = 0; next < inside.size(); ++next) {
    for (const AutomatonId child : components_->children(inside[next])) {
      inside.push_back(child);
    }
    const auto number = index(inside[next]);
    is_inside_[number] = true;
    network_.automata[number].edges.clear();
  }
  left_out_ += inside.size();
  const NodeId node = whole.automaton(root).node;
  for (std::uint32_t v = 0; v < whole.variables.size(); ++v) {
    const VariableId id{v};
    const bool is_seen = id == whole.node_status[index(node)] ||
                         id == whole.automaton(root).gate;
    if (is_seen || !components_->is_inside(root, id)) continue;
    Variable& variable = network_.variables[v];
    variable.min = variable.max = variable.initial;
    hidden_[v] = true;
  }
  is_component_[index(root)] = true;
  network_.automata[index(root)] = component->automaton;
  network_.variables[index(component->automaton.location)] =
      component->location;
  network_.variables[index(component->memory_id)] = component->memory;
  return true;
}

bool Composition::take(Values& values, std::uint32_t edge,
                       std::vector<std::uint32_t>& taken) const {
  const Automaton& owner = network_.owner_of_edge(edge);
  const auto number =
      static_cast<std::uint32_t>(&owner - network_.automata.data());
  const std::uint32_t place = edge - owner.first_edge;
  if (is_component_[number]) {
    return components_->take(values, AutomatonId{number}, place, taken);
  }
  const std::uint32_t whole =
      components_->network().automata[number].first_edge + place;
  components_->fire(values, whole);
  taken.push_back(whole);
  return true;
}

std::optional<std::uint32_t> Composition::edge_here(std::uint32_t whole) const {
  const Automaton& owner = components_->network().owner_of_edge(whole);
  const auto number = static_cast<std::size_t>(
      &owner - components_->network().automata.data());
  if (is_inside_[number]) return std::nullopt;
  return network_.automata[number].first_edge + (whole - owner.first_edge);
}

}  // namespace btcheck
