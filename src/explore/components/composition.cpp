// SPDX-License-Identifier: MIT
#include "explore/components/composition.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace btcheck {
namespace {

// All of a network but what its automata do, and what its values are called.
Network frame_of(const Network& whole) {
  Network frame;
  frame.profile = whole.profile;
  frame.ticks = whole.ticks;
  frame.variables.reserve(whole.variables.size());
  for (const Variable& each : whole.variables) {
    frame.variables.push_back({each.role,
                               {},
                               each.min,
                               each.max,
                               each.initial,
                               {},
                               each.owner,
                               each.scale,
                               each.local});
  }
  frame.fault = whole.fault;
  frame.arguments = whole.arguments;
  frame.past = whole.past;
  frame.node_automaton = whole.node_automaton;
  frame.node_status = whole.node_status;
  frame.node_caller = whole.node_caller;
  frame.state_variable = whole.state_variable;
  frame.state_automaton = whole.state_automaton;
  for (const Automaton& automaton : whole.automata) {
    Automaton& empty = frame.automata.emplace_back();
    empty.kind = automaton.kind;
    empty.name = automaton.name;
    empty.node = automaton.node;
    empty.state_variable = automaton.state_variable;
    empty.location = automaton.location;
    empty.gate = automaton.gate;
    empty.locations = {{"start_", LocationRole::Start, {}}};
  }
  return frame;
}

}  // namespace

Composition::Composition(ComponentTable& components, std::vector<bool> kept,
                         bool keeps_root)
    : components_(&components),
      network_(frame_of(components.network())),
      is_component_(network_.automata.size(), false),
      stands_in_(network_.automata.size()),
      hidden_(network_.variables.size(), false) {
  const Network& whole = components.network();
  const CallProtocol& protocol = components.protocol();
  const auto count = static_cast<std::uint32_t>(whole.automata.size());
  const auto lowest = lowest_above(kept);
  for (std::uint32_t a = 0; a < count; ++a) {
    if (!kept[a]) continue;
    for (auto above = protocol.parent(AutomatonId{a});
         above && !kept[index(*above)]; above = protocol.parent(*above)) {
      kept[index(*above)] = true;
    }
  }
  const Variable unused{VariableRole::Local, "memory", 0, 0, 0, {}, {}};
  network_.variables.resize(components.variable_count(), unused);
  if (keeps_root || !lowest || !place_outside_of(*lowest)) {
    for (const AutomatonId root : components.roots()) place_below(root, kept);
  } else {
    place_below(*lowest, kept);
    const AutomatonId own = components.root_of(*lowest);
    for (const AutomatonId root : components.roots()) {
      if (root != own) place_below(root, kept);
    }
  }
  for (std::uint32_t a = 0; a < count; ++a) {
    const Automaton& timer = whole.automata[a];
    if (timer.kind != AutomatonKind::Timer) continue;
    const AutomatonId node = network_.node_automaton[index(timer.node)];
    // The parent of an outside is not in its place any more.
    if (index(node) < count && !stands_in_[index(node)]) continue;
    leave_out(AutomatonId{a},
              index(node) < count ? *stands_in_[index(node)] : *inner_);
    for (std::uint32_t e = 0; e < timer.edges.size(); ++e) {
      hidden_timers_.push_back(timer.first_edge + e);
    }
  }
  for (std::uint32_t a = 0; a < count; ++a) {
    if (!stands_in_[a]) network_.automata[a] = whole.automata[a];
  }
  hide();
  network_.number_edges();
}

// The lowest automaton with all that is kept in its subtree.
std::optional<AutomatonId> Composition::lowest_above(
    const std::vector<bool>& kept) const {
  std::optional<AutomatonId> lowest;
  for (std::uint32_t a = 0; a < kept.size(); ++a) {
    if (!kept[a]) continue;
    if (!lowest) lowest = AutomatonId{a};
    while (lowest && !components_->is_below(AutomatonId{a}, *lowest)) {
      lowest = components_->protocol().parent(*lowest);
    }
    if (!lowest) return std::nullopt;
  }
  return lowest;
}

void Composition::leave_out(AutomatonId automaton, AutomatonId root) {
  stands_in_[index(automaton)] = root;
  ++left_out_;
}

// What is inside a component, and nobody else touches, keeps its first value;
// the calls and answers of the subtree's root are seen.
void Composition::hide() {
  const Network& whole = components_->network();
  for (std::uint32_t v = 0; v < whole.variables.size(); ++v) {
    const VariableId id{v};
    const auto& users = components_->users_of(id);
    if (users.empty() || !stands_in_[users.front()]) continue;
    const AutomatonId in = *stands_in_[users.front()];
    const Automaton& root = whole.automaton(in);
    const bool is_seen =
        root.gate &&
        (id == root.gate || id == whole.node_status[index(root.node)]);
    const bool is_hidden =
        !is_seen && std::ranges::all_of(users, [&](std::uint32_t user) {
          return stands_in_[user] == in;
        });
    if (!is_hidden) continue;
    hidden_[v] = true;
    // There the component itself stands.
    if (id == root.location) continue;
    Variable& variable = network_.variables[v];
    variable.min = variable.max = variable.initial;
  }
}

// It changes with time: a timer's edges are taken when they are due, before
// everything else.
void Composition::add_clock(AutomatonId root, PartSide side,
                            VariableId location) {
  if (network_.ticks == TickSemantics::None) return;
  const Component& component = *components_->of(root, side)->shape;
  const Automaton& automaton = components_->automaton_of(root, side);
  Automaton clock;
  clock.kind = AutomatonKind::Timer;
  clock.name = automaton.name + "_time";
  clock.node = automaton.node;
  clock.location = location;
  for (std::size_t m = 0; m < component.later.size(); ++m) {
    clock.locations.push_back({"place_" + std::to_string(m)});
    const int later = component.later[m];
    if (later == static_cast<int>(m)) continue;
    Edge& edge = clock.edges.emplace_back();
    edge.source = LocationId{static_cast<std::uint32_t>(m)};
    edge.target = LocationId{static_cast<std::uint32_t>(later)};
    edge.when = {1, 1};
  }
  if (!clock.edges.empty()) network_.automata.push_back(std::move(clock));
}

bool Composition::place_outside_of(AutomatonId root) {
  const PlacedComponent* component =
      components_->placeable(root, PartSide::Outside);
  if (component == nullptr) return false;
  const Network& whole = components_->network();
  const AutomatonId tree = components_->root_of(root);
  for (std::uint32_t a = 0; a < whole.automata.size(); ++a) {
    const bool is_node = whole.automata[a].kind == AutomatonKind::Node;
    if (is_node && components_->is_below(AutomatonId{a}, tree) &&
        !components_->is_below(AutomatonId{a}, root)) {
      leave_out(AutomatonId{a}, root);
    }
  }
  inner_ = root;
  outside_ = static_cast<std::uint32_t>(network_.automata.size());
  const Automaton& automaton =
      components_->automaton_of(root, PartSide::Outside);
  network_.automata.push_back(automaton);
  // Its clock finds it by its node.
  network_.node_automaton[index(automaton.node)] = AutomatonId{outside_};
  network_.variables[index(automaton.location)] = component->shape->location;
  add_clock(root, PartSide::Outside, automaton.location);
  return true;
}

void Composition::place_below(AutomatonId root, const std::vector<bool>& kept) {
  const PlacedComponent* component =
      kept[index(root)] ? nullptr
                        : components_->placeable(root, PartSide::Inside);
  if (component == nullptr) {
    for (const AutomatonId child : components_->children(root)) {
      place_below(child, kept);
    }
    return;
  }
  std::vector<AutomatonId> inside = {root};
  for (std::size_t next = 0; next < inside.size(); ++next) {
    for (const AutomatonId child : components_->children(inside[next])) {
      inside.push_back(child);
    }
    leave_out(inside[next], root);
  }
  is_component_[index(root)] = true;
  const Automaton& automaton =
      components_->automaton_of(root, PartSide::Inside);
  const Component& shape = *component->shape;
  const VariableId memory = component->name(shape.memory_id);
  network_.automata[index(root)] = automaton;
  network_.variables[index(automaton.location)] = shape.location;
  network_.variables[index(memory)] = shape.memory;
  add_clock(root, PartSide::Inside,
            automaton.gate ? memory : automaton.location);
}

bool Composition::take(const Valuation& state, std::uint32_t edge,
                       const ComponentTable::Fire& fire,
                       Standing& standing) const {
  const Automaton& owner = network_.owner_of_edge(edge);
  const auto number =
      static_cast<std::uint32_t>(&owner - network_.automata.data());
  const Network& whole = components_->network();
  if (inner_ && number == outside_) {
    return components_->take(state, *inner_, PartSide::Outside,
                             edge - owner.first_edge, fire, standing);
  }
  if (number >= whole.automata.size()) return true;  // a clock
  const std::uint32_t place = edge - owner.first_edge;
  return is_component_[number]
             ? components_->take(state, AutomatonId{number}, PartSide::Inside,
                                 place, fire, standing)
             : fire(whole.automata[number].first_edge + place);
}

bool Composition::settle(const Valuation& state,
                         const ComponentTable::Fire& fire,
                         Standing& standing) const {
  const auto& fault = components_->network().fault;
  if (fault && state.variables[index(*fault)] != 0) return true;
  for (std::uint32_t a = 0; a < is_component_.size(); ++a) {
    const bool is_settled =
        !is_component_[a] ||
        components_->settle(state, AutomatonId{a}, PartSide::Inside, fire,
                            standing);
    if (!is_settled) return false;
  }
  return !inner_ ||
         components_->settle(state, *inner_, PartSide::Outside, fire, standing);
}

std::optional<std::uint32_t> Composition::edge_here(std::uint32_t whole) const {
  const Automaton& owner = components_->network().owner_of_edge(whole);
  const auto number =
      static_cast<std::size_t>(&owner - components_->network().automata.data());
  if (stands_in_[number]) return std::nullopt;
  return network_.automata[number].first_edge + (whole - owner.first_edge);
}

}  // namespace btcheck
