// SPDX-License-Identifier: MIT
#include "explore/components/component.hpp"

#include <algorithm>
#include <utility>

#include "explore/components/open_part.hpp"
#include "explore/state/accesses.hpp"
#include "text/budget.hpp"

namespace btcheck {

ComponentTable::ComponentTable(const Network& network,
                               const std::vector<bool>& shared, Limits limits)
    : network_(network),
      limits_(limits),
      protocol_(network),
      children_(network.automata.size()),
      timers_(network.automata.size()),
      users_(network.variables.size()) {
  for (auto& known : known_) known.resize(network.automata.size());
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    if (automaton.kind == AutomatonKind::Timer) {
      timers_[index(network.node_automaton[index(automaton.node)])].push_back(
          AutomatonId{a});
    }
    if (const auto parent = protocol_.parent(AutomatonId{a})) {
      children_[index(*parent)].push_back(AutomatonId{a});
    } else if (automaton.kind == AutomatonKind::Node) {
      roots_.push_back(AutomatonId{a});
    }
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    // Post-order: what lies below has been looked at.
    std::uint32_t first = a;
    for (const AutomatonId child : children_[a]) {
      if (index(child) < a) {
        first = std::min(first, first_inside_[index(child)]);
      }
    }
    first_inside_.push_back(first);
  }
  const Accesses accesses(network);
  for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
    // A fault is everybody's: it ends the run.
    if (shared[v] || network.fault == VariableId{v}) continue;
    std::vector<std::uint32_t>& users = users_[v];
    bool is_alone = true;
    for (const auto* all : {&accesses.readers[v], &accesses.writers[v]}) {
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
  for (const AutomatonId child : children_[index(root)]) {
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
    const Component* component = of(id, of_it);
    if (component != nullptr) all.push_back({id, component, of_it});
    return component != nullptr;
  };
  if (is_outside) {
    const bool is_root = !protocol_.parent(middle);
    if (!is_root && !add(middle, PartSide::Outside)) return std::nullopt;
    // What is inside is let do what it may.
    if (of(root) == nullptr) return std::nullopt;
  }
  for (const AutomatonId child : children_[index(middle)]) {
    if (child == root && is_outside) continue;
    if (!add(child, PartSide::Inside)) return std::nullopt;
  }
  return all;
}

const Component* ComponentTable::of(AutomatonId root, PartSide side) {
  auto& known = known_[static_cast<std::size_t>(side)][index(root)];
  if (!known) {
    // Its members come first; they are not among each other's.
    auto all = members(root, side);
    std::optional<Component> made;
    if (all && states_ < limits_.all_states) {
      made = OpenPart(*this, root, side, std::move(*all)).take();
    }
    if (made) states_ += made->size();
    known = std::move(made);
  }
  return known->has_value() ? &**known : nullptr;
}

std::optional<std::uint32_t> ComponentTable::state_of(
    const Valuation& state, const Component& component) const {
  Component::Values own;
  for (const PartMember& member : component.members_) {
    if (member.component == nullptr) continue;
    const auto at = place(state, member.automaton, member.side);
    if (!at) return std::nullopt;
    own.push_back(at->location);
    if (member.side == PartSide::Inside) own.push_back(at->memory);
  }
  for (std::size_t i = own.size(); i < component.own_.size(); ++i) {
    const std::size_t id = index(component.own_[i]);
    own.push_back(id < network_.variables.size()
                      ? state.variables[id]
                      : state.clocks[id - variable_count()]);
  }
  const auto known = component.states_.find(own);
  if (known == component.states_.end()) return std::nullopt;
  return known->second;
}

std::optional<Component::Place> ComponentTable::place(const Valuation& state,
                                                      AutomatonId root,
                                                      PartSide side) const {
  const Component& component = known(root, side);
  const auto number = state_of(state, component);
  if (!number) return std::nullopt;
  const std::uint32_t place = component.place_of_[*number];
  if (place == Component::kPassing) return std::nullopt;
  return component.places_[place];
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
                          PartSide side, std::uint32_t edge,
                          const Fire& fire) const {
  const Component& component = known(root, side);
  const Component::Drawn& drawn = component.drawn_[edge];
  const auto start = state_of(state, component);
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
  return !steps.empty() && follow(state, component, steps, fire);
}

bool ComponentTable::follow(const Valuation& state, const Component& component,
                            const std::vector<const Component::Arc*>& steps,
                            const Fire& fire) const {
  for (const Component::Arc* step : steps) {
    const PartMember& member = component.members_[step->member.number];
    const std::uint32_t place = step->member.edge;
    const bool is_done =
        member.component == nullptr
            ? fire(network_.automaton(member.automaton).first_edge + place)
            : take(state, member.automaton, member.side, place, fire);
    if (!is_done) return false;
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
                            PartSide side, const Fire& fire) const {
  const Component& component = known(root, side);
  const auto start = state_of(state, component);
  if (!start) return false;
  if (component.is_silent(*start)) {
    const auto steps =
        component.way(*start, LabelledGraph::kSilent, [&](std::uint32_t end) {
          return component.place_of_[end] == component.place_of_[*start] &&
                 !component.is_silent(end);
        });
    if (steps.empty() || !follow(state, component, steps, fire)) return false;
  }
  return std::ranges::all_of(component.members_, [&](const PartMember& member) {
    return member.component == nullptr ||
           settle(state, member.automaton, member.side, fire);
  });
}

}  // namespace btcheck
