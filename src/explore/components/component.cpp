// SPDX-License-Identifier: MIT
#include "explore/components/component.hpp"

#include <algorithm>
#include <utility>

#include "explore/components/cut_part.hpp"
#include "explore/components/open_part.hpp"
#include "text/budget.hpp"

namespace btcheck {

ComponentTable::ComponentTable(const Network& network,
                               const std::vector<bool>& shared, Limits limits,
                               ComponentStore* store)
    : network_(network),
      limits_(limits),
      protocol_(network),
      accesses_(network),
      entries_(called_with(network, protocol_, accesses_)),
      store_(store == nullptr ? own_store_ : *store),
      timers_(network.automata.size()),
      users_(network.variables.size()) {
  for (auto& known : known_) known.resize(network.automata.size());
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    if (automaton.kind == AutomatonKind::Timer) {
      timers_[index(network.node_automaton[index(automaton.node)])].push_back(
          AutomatonId{a});
    }
    const bool is_called = protocol_.parent(AutomatonId{a}).has_value();
    if (!is_called && automaton.kind == AutomatonKind::Node) {
      roots_.push_back(AutomatonId{a});
    }
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    // Post-order: what lies below has been looked at.
    std::uint32_t first = a;
    for (const AutomatonId child : protocol_.children(AutomatonId{a})) {
      if (index(child) < a) {
        first = std::min(first, first_inside_[index(child)]);
      }
    }
    first_inside_.push_back(first);
  }
  for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
    // A fault is everybody's: it ends the run.
    if (shared[v] || network.fault == VariableId{v}) continue;
    std::vector<std::uint32_t>& users = users_[v];
    bool is_alone = true;
    for (const auto* all : {&accesses_.readers[v], &accesses_.writers[v]}) {
      for (const AutomatonId user : *all) {
        // A timer belongs to its node.
        const Automaton& who = network.automaton(user);
        is_alone = is_alone && who.kind != AutomatonKind::StateVariable;
        users.push_back(who.kind == AutomatonKind::Timer
                            ? index(network.node_automaton[index(who.node)])
                            : index(user));
      }
    }
    if (!is_alone) users.clear();
    std::ranges::sort(users);
    users.erase(std::unique(users.begin(), users.end()), users.end());
  }
}

bool ComponentTable::is_only_in(AutomatonId root, PartSide side,
                                VariableId variable) const {
  const auto& users = users_[index(variable)];
  if (users.empty()) return false;
  const std::uint32_t first = first_inside_[index(root)];
  if (side == PartSide::Inside) {
    return users.front() >= first && users.back() <= index(root);
  }
  const AutomatonId tree = root_of(root);
  if (!is_below(AutomatonId{users.front()}, tree) ||
      !is_below(AutomatonId{users.back()}, tree)) {
    return false;
  }
  const auto user = std::ranges::lower_bound(users, first);
  return user == users.end() || *user > index(root);
}

AutomatonId ComponentTable::root_of(AutomatonId node) const {
  return *std::ranges::find_if(
      roots_, [&](AutomatonId root) { return is_below(node, root); });
}

namespace {

// Each of its edges is taken after a fixed time, and says nothing but that.
bool only_counts(const Automaton& timer) {
  return std::ranges::all_of(timer.edges, [](const Edge& edge) {
    return edge.when.lower == edge.when.upper && edge.when.upper > 0 &&
           edge.guard.is_true() && edge.updates.empty();
  });
}

}  // namespace

// Its own location is its own business, and so are those of its timers and the
// calls of its children.
bool ComponentTable::may_be_component(AutomatonId root) const {
  const Automaton& automaton = network_.automaton(root);
  const auto is_own = [&](VariableId variable) {
    return users_[index(variable)] == std::vector<std::uint32_t>{index(root)};
  };
  const bool is_plain =
      automaton.kind == AutomatonKind::Node && is_own(automaton.location) &&
      std::ranges::all_of(timers_[index(root)], [&](AutomatonId timer) {
        const Automaton& own = network_.automaton(timer);
        return only_counts(own) && is_own(own.location);
      });
  if (!is_plain) return false;
  std::size_t inside = 1;
  for (const AutomatonId child : protocol_.children(root)) {
    const VariableId gate = *network_.automaton(child).gate;
    if (index(child) > index(root) || users_[index(gate)].empty()) return false;
    inside += index(child) - first_inside_[index(child)] + 1;
  }
  return inside == index(root) - first_inside_[index(root)] + 1;
}

std::optional<std::vector<PartMember>> ComponentTable::members(AutomatonId root,
                                                               PartSide side) {
  const auto parent = protocol_.parent(root);
  const bool is_outside = side == PartSide::Outside;
  if (network_.automata.size() > limits_.automata) return std::nullopt;
  if (!protocol_.holds() || (is_outside && !parent)) return std::nullopt;
  const AutomatonId middle = is_outside ? *parent : root;
  if (!may_be_component(middle)) return std::nullopt;
  std::vector<PartMember> all = {{middle, nullptr, PartSide::Inside}};
  const auto add = [&](AutomatonId id, PartSide of_it) {
    const PlacedComponent* component = of(id, of_it);
    if (component != nullptr) all.push_back({id, component, of_it});
    return component != nullptr;
  };
  if (is_outside) {
    const bool is_root = !protocol_.parent(middle);
    if (!is_root && !add(middle, PartSide::Outside)) return std::nullopt;
    // What is inside is let do what it may.
    if (of(root) == nullptr) return std::nullopt;
  }
  for (const AutomatonId child : protocol_.children(middle)) {
    if (child == root && is_outside) continue;
    if (!add(child, PartSide::Inside)) return std::nullopt;
  }
  return all;
}

bool ComponentTable::fits(const Component& shape, const CutPart& part,
                          const std::vector<PartMember>& members) const {
  const auto edges_of = [&](const PartMember& member) {
    return member.component == nullptr
               ? network_.automaton(member.automaton).edges.size()
               : member.component->shape->automaton.edges.size();
  };
  const auto& gate = shape.automaton.gate;
  const bool has_its_gate =
      part.is_called() ? gate == part.gate() : !gate.has_value();
  return shape.location_id == part.location() &&
         shape.memory_id == part.memory() && has_its_gate &&
         shape.own_ == part.own() &&
         std::ranges::all_of(shape.spoken_of,
                             [&](VariableId each) {
                               return index(each) < part.names().size();
                             }) &&
         std::ranges::none_of(shape.automaton.edges,
                              [&](const Edge& edge) {
                                return part.ticks() != TickSemantics::None &&
                                       edge.when.needs_clock();
                              }) &&
         std::ranges::all_of(shape.arcs_, [&](const Component::Arc& arc) {
           const auto [number, edge] = arc.member;
           return number < members.size() && edge < edges_of(members[number]);
         });
}

std::optional<PlacedComponent> ComponentTable::made(
    AutomatonId root, PartSide side, std::vector<PartMember> members) {
  const CutPart part(*this, root, side, members);
  const ContentHash made_of = part.hash();
  std::optional<ComponentStore::Known> shape = store_.find(
      made_of,
      [&](const Component& other) { return fits(other, part, members); });
  if (!shape) {
    shape = nullptr;
    if (auto drawn = OpenPart(part, limits_).take()) {
      shape = std::make_shared<const Component>(std::move(*drawn));
    }
    store_.share(made_of, *shape);
  }
  if (*shape == nullptr) return std::nullopt;
  return PlacedComponent{
      std::move(*shape), part.names(), std::move(members), {}};
}

const PlacedComponent* ComponentTable::of(AutomatonId root, PartSide side) {
  auto& known = known_[static_cast<std::size_t>(side)][index(root)];
  if (!known) {
    // Its members come first; they are not among each other's.
    auto all = members(root, side);
    std::optional<PlacedComponent> placed;
    if (all && states_ < limits_.all_states) {
      placed = made(root, side, std::move(*all));
    }
    if (placed) states_ += placed->shape->size();
    known = std::move(placed);
  }
  return known->has_value() ? &**known : nullptr;
}

const PlacedComponent* ComponentTable::placeable(AutomatonId root,
                                                 PartSide side) {
  const PlacedComponent* component = of(root, side);
  const bool may_stand =
      component != nullptr &&
      component->shape->automaton.edges.size() <= limits_.edges;
  return may_stand ? component : nullptr;
}

const Automaton& ComponentTable::automaton_of(AutomatonId root, PartSide side) {
  PlacedComponent& placed =
      known_[static_cast<std::size_t>(side)][index(root)]->value();
  if (placed.automaton.locations.empty()) {
    placed.automaton = with_names(placed.shape->automaton, [&](VariableId own) {
      return placed.name(own);
    });
    const Automaton& middle = network_.automaton(placed.members[0].automaton);
    for (const VariableId local : placed.shape->automaton.locals) {
      placed.automaton.locals.push_back(placed.name(local));
    }
    placed.automaton.name = middle.name;
    placed.automaton.node = middle.node;
  }
  return placed.automaton;
}

void Standing::forget() {
  for (const Part& part : known_) {
    states_[static_cast<std::size_t>(part.side)][index(part.root)].reset();
  }
  known_.clear();
}

void ComponentTable::forget_around(AutomatonId moved,
                                   Standing& standing) const {
  std::erase_if(standing.known_, [&](const Standing::Part& part) {
    const bool is_inside = is_below(moved, part.root);
    if (is_inside != (part.side == PartSide::Inside)) return false;
    standing.states_[static_cast<std::size_t>(part.side)][index(part.root)]
        .reset();
    return true;
  });
}

std::optional<std::uint32_t> ComponentTable::state_of(
    const Valuation& state, AutomatonId root, PartSide side,
    Standing& standing) const {
  auto& all = standing.states_[static_cast<std::size_t>(side)];
  if (all.empty()) all.resize(network_.automata.size());
  auto& number = all[index(root)];
  if (!number) {
    number = found_state(state, known(root, side), standing);
    standing.known_.push_back({root, side});
  }
  return *number;
}

std::optional<std::uint32_t> ComponentTable::found_state(
    const Valuation& state, const PlacedComponent& component,
    Standing& standing) const {
  Component::Values own;
  for (const PartMember& member : component.members) {
    if (member.component == nullptr) continue;
    const auto at = place(state, member.automaton, member.side, standing);
    if (!at) return std::nullopt;
    own.push_back(at->location);
    if (member.side == PartSide::Inside) own.push_back(at->memory);
  }
  const Component& shape = *component.shape;
  for (std::size_t i = own.size(); i < shape.own_.size(); ++i) {
    const std::size_t id = index(component.name(shape.own_[i]));
    own.push_back(id < network_.variables.size()
                      ? state.variables[id]
                      : state.clocks[id - variable_count()]);
  }
  const auto known = shape.states_.find(own);
  if (known == shape.states_.end()) return std::nullopt;
  return known->second;
}

std::optional<Component::Place> ComponentTable::place(
    const Valuation& state, AutomatonId root, PartSide side,
    Standing& standing) const {
  const auto number = state_of(state, root, side, standing);
  if (!number) return std::nullopt;
  const Component& shape = *known(root, side).shape;
  const std::uint32_t place = shape.place_of_[*number];
  if (place == Component::kPassing) return std::nullopt;
  return shape.places_[place];
}

std::size_t Component::bytes() const {
  constexpr std::size_t kBytesOfState = 64;  // with its place in the table
  constexpr std::size_t kBytesOfEdge = 256;
  return states_.size() * (kBytesOfState + own_.size() * sizeof(int)) +
         arcs_.size() * sizeof(Arc) + first_.size() * sizeof(first_[0]) +
         automaton.edges.size() * kBytesOfEdge + sizeof(*this);
}

void Component::tell_content() {
  std::vector<std::int32_t> told;
  for (const Variable* each : {&location, &memory}) {
    told.insert(told.end(), {each->min, each->max, each->initial});
  }
  told.push_back(is_instant);
  told.push_back(static_cast<std::int32_t>(later.size()));
  told.insert(told.end(), later.begin(), later.end());
  spoken_of = {location_id, memory_id};
  append(
      automaton,
      [&](VariableId each) {
        const auto known = std::ranges::find(spoken_of, each);
        const auto number = known - spoken_of.begin();
        if (known == spoken_of.end()) spoken_of.push_back(each);
        return VariableId{static_cast<std::uint32_t>(number)};
      },
      told);
  content = hash_of(told);
}

// A shortest way from a state to one that stands there, silent but for one step
// with the label; where that is silent as well, of one step at least.
std::vector<const Component::Arc*> Component::way(
    std::uint32_t from, std::uint32_t label,
    const std::function<bool(std::uint32_t)>& ends) const {
  struct Entry {
    std::uint32_t state = 0;
    bool has_stepped = false;  // with the label
    std::size_t from = 0;
    const Arc* by = nullptr;
  };
  constexpr std::uint32_t kSilent = LabelledGraph::kSilent;
  std::vector<Entry> queue = {{from}};
  std::vector<bool> seen(2 * size(), false);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    ask_budget();
    const Entry at = queue[next];
    for (const Arc& arc : arcs(at.state)) {
      const bool is_step = arc.label == label && !at.has_stepped;
      if (!is_step && arc.label != kSilent) continue;
      const bool has_stepped = at.has_stepped || is_step;
      const std::size_t place = 2 * std::size_t{arc.target} + has_stepped;
      if (seen[place]) continue;
      seen[place] = true;
      queue.push_back({arc.target, has_stepped, next, &arc});
      if (!has_stepped || !ends(arc.target)) continue;
      std::vector<const Arc*> steps;
      for (std::size_t i = queue.size() - 1; queue[i].by != nullptr;
           i = queue[i].from) {
        steps.push_back(queue[i].by);
      }
      std::ranges::reverse(steps);
      return steps;
    }
  }
  return {};
}

bool ComponentTable::take(const Valuation& state, AutomatonId root,
                          PartSide side, std::uint32_t edge, const Fire& fire,
                          Standing& standing) const {
  const PlacedComponent& placed = known(root, side);
  const Component& component = *placed.shape;
  const Component::Drawn& drawn = component.drawn_[edge];
  const auto start = state_of(state, root, side, standing);
  if (!start) return false;
  const auto back_to = [&](std::uint32_t to) {
    return component.way(to, LabelledGraph::kSilent,
                         [to](std::uint32_t end) { return end == to; });
  };
  std::vector<const Component::Arc*> steps;
  if (!drawn.is_loop) {
    steps = component.way(*start, drawn.label, [&](std::uint32_t end) {
      return component.place_of_[end] == drawn.to;
    });
  } else if (steps = back_to(*start); steps.empty()) {
    // To where such a loop begins, and round it.
    steps = component.way(*start, drawn.label, [&](std::uint32_t end) {
      return !back_to(end).empty();
    });
    if (steps.empty()) return false;
    const auto round = back_to(steps.back()->target);
    steps.insert(steps.end(), round.begin(), round.end());
  }
  return !steps.empty() && follow(state, placed, steps, fire, standing);
}

bool ComponentTable::follow(const Valuation& state,
                            const PlacedComponent& component,
                            const std::vector<const Component::Arc*>& steps,
                            const Fire& fire, Standing& standing) const {
  for (const Component::Arc* step : steps) {
    const PartMember& member = component.members[step->member.number];
    const std::uint32_t place = step->member.edge;
    if (member.component != nullptr) {
      if (!take(state, member.automaton, member.side, place, fire, standing)) {
        return false;
      }
      continue;
    }
    const Automaton& automaton = network_.automaton(member.automaton);
    if (!fire(automaton.first_edge + place)) return false;
    forget_around(member.automaton, standing);
  }
  return true;
}

bool Component::is_silent(std::uint32_t state) const {
  return std::ranges::any_of(arcs(state), [](const Arc& arc) {
    return arc.label == LabelledGraph::kSilent;
  });
}

// First where no member has anything to do that the part does not see; then
// what each does by itself.
bool ComponentTable::settle(const Valuation& state, AutomatonId root,
                            PartSide side, const Fire& fire,
                            Standing& standing) const {
  const PlacedComponent& placed = known(root, side);
  const Component& component = *placed.shape;
  const auto start = state_of(state, root, side, standing);
  if (!start) return false;
  if (component.is_silent(*start)) {
    const auto steps =
        component.way(*start, LabelledGraph::kSilent, [&](std::uint32_t end) {
          return component.place_of_[end] == component.place_of_[*start] &&
                 !component.is_silent(end);
        });
    if (steps.empty() || !follow(state, placed, steps, fire, standing))
      return false;
  }
  return std::ranges::all_of(placed.members, [&](const PartMember& member) {
    return member.component == nullptr ||
           settle(state, member.automaton, member.side, fire, standing);
  });
}

}  // namespace btcheck
