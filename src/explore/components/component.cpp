// SPDX-License-Identifier: MIT
#include "explore/components/component.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "explore/components/open_subtree.hpp"
#include "explore/state/accesses.hpp"
#include "text/budget.hpp"

namespace btcheck {

std::size_t Component::HashOfValues::operator()(const Values& values) const {
  std::uint64_t hash = 0x9e3779b97f4a7c15ull;
  for (const int value : values) {
    hash = (hash ^ static_cast<std::uint32_t>(value)) * 0xd6e8feb86659fd93ull;
    hash ^= hash >> 32;
  }
  return hash;
}

Components::Components(const Network& network, std::vector<bool> shared,
                       std::vector<std::uint8_t> marks, Limits limits)
    : network_(network),
      marks_(std::move(marks)),
      limits_(limits),
      protocol_(network),
      children_(network.automata.size()),
      has_timer_(network.automata.size(), false),
      first_user_(network.variables.size(),
                  std::numeric_limits<std::uint32_t>::max()),
      last_user_(network.variables.size(), 0),
      known_(network.automata.size()) {
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    if (automaton.kind == AutomatonKind::Timer) {
      has_timer_[index(network.node_automaton[index(automaton.node)])] = true;
    }
    if (const auto parent = protocol_.parent(AutomatonId{a})) {
      children_[index(*parent)].push_back(AutomatonId{a});
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
    if (shared[v]) {
      first_user_[v] = 0;
      last_user_[v] = std::numeric_limits<std::uint32_t>::max();
      continue;
    }
    for (const auto* all : {&accesses.readers[v], &accesses.writers[v]}) {
      for (const AutomatonId user : *all) {
        first_user_[v] = std::min(first_user_[v], index(user));
        last_user_[v] = std::max(last_user_[v], index(user));
      }
    }
  }
}

bool Components::is_inside(AutomatonId root, VariableId variable) const {
  const std::uint32_t v = index(variable);
  return first_user_[v] <= last_user_[v] &&
         first_user_[v] >= first_inside_[index(root)] &&
         last_user_[v] <= index(root);
}

// Its own location is its own business; nothing in it takes time or is
// measured; and all below it are components.
bool Components::may_be_component(AutomatonId root) const {
  const Automaton& automaton = network_.automaton(root);
  const bool is_plain =
      automaton.kind == AutomatonKind::Node && automaton.gate &&
      protocol_.parent(root) && !has_timer_[index(root)] &&
      is_inside(root, automaton.location) &&
      std::ranges::none_of(automaton.edges, [](const Edge& edge) {
        return edge.when.needs_clock();
      });
  if (!is_plain) return false;
  std::size_t inside = 1;
  for (const AutomatonId child : children_[index(root)]) {
    const Automaton& below = network_.automaton(child);
    if (index(child) > index(root) || !is_inside(root, *below.gate)) {
      return false;
    }
    inside += index(child) - first_inside_[index(child)] + 1;
  }
  return inside == index(root) - first_inside_[index(root)] + 1;
}

const Component* Components::of(AutomatonId root) {
  auto& known = known_[index(root)];
  if (!known) {
    // Its children's come first.
    bool may_be = protocol_.holds() && may_be_component(root);
    for (const AutomatonId child : children_[index(root)]) {
      may_be = of(child) != nullptr && may_be;
    }
    std::optional<Component> made;
    if (may_be) made = OpenSubtree(*this, root).take();
    known_[index(root)] = std::move(made);
  }
  const std::optional<Component>& component = *known_[index(root)];
  return component ? &*component : nullptr;
}

std::optional<std::uint32_t> Components::state_of(const Values& values,
                                                  AutomatonId root) const {
  const Component& component = known_[index(root)]->value();
  Values own;
  for (std::size_t i = 0; i < children_[index(root)].size(); ++i) {
    const auto at = place(values, children_[index(root)][i]);
    if (!at) return std::nullopt;
    own.push_back(at->location);
    own.push_back(at->memory);
  }
  for (std::size_t i = own.size(); i < component.own_.size(); ++i) {
    own.push_back(values[index(component.own_[i])]);
  }
  const auto known = component.states_.find(own);
  if (known == component.states_.end()) return std::nullopt;
  return known->second;
}

std::optional<Component::Place> Components::place(const Values& values,
                                                  AutomatonId root) const {
  const auto state = state_of(values, root);
  if (!state) return std::nullopt;
  const Component& component = known_[index(root)]->value();
  return component.places_[component.partition_.block[*state]];
}

void Components::fire(Values& values, std::uint32_t number) const {
  const Automaton& owner = network_.owner_of_edge(number);
  const Edge& edge = network_.edge(number);
  for (const Assignment& update : edge.updates) {
    values[index(update.variable)] =
        static_cast<int>(update.value.evaluate([&](const Term& term) {
          return std::int64_t{values[static_cast<std::size_t>(term.operand)]};
        }));
  }
  values[index(owner.location)] = network_.variable(owner.location).min +
                                  static_cast<int>(index(edge.target));
}

// The nearest state of the block from which such a step leads there; of a
// silent one within the block, such a step that can be taken again.
bool Components::take(Values& values, AutomatonId root, std::uint32_t edge,
                      std::vector<std::uint32_t>& taken) const {
  const Component& component = known_[index(root)]->value();
  const Component::Drawn& drawn = component.drawn_[edge];
  const std::vector<std::uint32_t>& block = component.partition_.block;
  const auto start = state_of(values, root);
  if (!start || block[*start] != drawn.from) return false;
  struct Entry {
    std::uint32_t state = 0;
    std::size_t from = 0;
    const Component::Arc* by = nullptr;
  };
  constexpr std::uint32_t kSilent = LabelledGraph::kSilent;
  // Breadth first over silent steps within the block.
  const auto way = [&](std::uint32_t begin,
                       auto&& ends) -> std::vector<const Component::Arc*> {
    std::vector<Entry> queue = {{begin, 0, nullptr}};
    std::vector<bool> seen(component.size(), false);
    seen[begin] = true;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      ask_budget();
      for (const Component::Arc& arc : component.arcs(queue[next].state)) {
        if (ends(arc)) {
          std::vector<const Component::Arc*> steps = {&arc};
          for (std::size_t at = next; queue[at].by != nullptr;
               at = queue[at].from) {
            steps.push_back(queue[at].by);
          }
          std::ranges::reverse(steps);
          return steps;
        }
        const bool is_inert =
            arc.label == kSilent && block[arc.target] == drawn.from;
        if (!is_inert || seen[arc.target]) continue;
        seen[arc.target] = true;
        queue.push_back({arc.target, next, &arc});
      }
    }
    return {};
  };
  std::vector<const Component::Arc*> steps;
  if (drawn.label == kSilent && drawn.from == drawn.to) {
    const auto comes_back = [&](std::uint32_t to) {
      return way(to, [&, to](const Component::Arc& arc) {
        return arc.label == kSilent && arc.target == to;
      });
    };
    steps = comes_back(*start);
    if (steps.empty()) {
      steps = way(*start, [&](const Component::Arc& arc) {
        return arc.label == kSilent && block[arc.target] == drawn.from &&
               !comes_back(arc.target).empty();
      });
      if (steps.empty()) return false;
      const auto round = comes_back(steps.back()->target);
      steps.insert(steps.end(), round.begin(), round.end());
    }
  } else {
    steps = way(*start, [&](const Component::Arc& arc) {
      return arc.label == drawn.label && block[arc.target] == drawn.to;
    });
  }
  for (const Component::Arc* step : steps) {
    if (step->member.child == 0) {
      const std::uint32_t number =
          network_.automaton(root).first_edge + step->member.edge;
      fire(values, number);
      taken.push_back(number);
    } else if (!take(values, children_[index(root)][step->member.child - 1],
                     step->member.edge, taken)) {
      return false;
    }
  }
  return !steps.empty();
}

}  // namespace btcheck
