// SPDX-License-Identifier: MIT
//
// Variables that others touch as well have no values here: what an edge asks of
// them and assigns to them is put on its label, with the values of the
// subtree's own variables put in. So a state is one of the subtree alone, and
// the graph is right beside whatever else there is. Too many states would be
// found if any caller were let in: one that resets a node which still runs, say.
// The root's status is followed beside the states, and others change it only as
// the edges of the parent's automaton do.
#include "explore/components/open_subtree.hpp"

#include <algorithm>
#include <deque>
#include <set>

#include "explore/components/residual.hpp"
#include "explore/state/accesses.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

void append(std::vector<std::int32_t>& key, const Expression& expression) {
  for (const Term& term : expression.terms()) {
    key.push_back(static_cast<std::int32_t>(term.operation));
    key.push_back(term.operand);
  }
  key.push_back(-1);
}

}  // namespace

OpenSubtree::OpenSubtree(Components& all, AutomatonId root)
    : all_(all),
      root_(root),
      automaton_(all.network_.automaton(root)),
      status_(all.network_.node_status[index(automaton_.node)]),
      children_(all.children(root)),
      place_of_(all.variable_count(), -1) {
  collect_own();
  collect_changes();
}

const Automaton& OpenSubtree::member(std::uint32_t number) const {
  return number == 0 ? automaton_
                     : all_.known_[index(children_[number - 1])]
                           ->value()
                           .automaton;
}

std::optional<std::size_t> OpenSubtree::own(VariableId variable) const {
  const int place = place_of_[index(variable)];
  return place < 0 ? std::nullopt
                   : std::optional(static_cast<std::size_t>(place));
}

void OpenSubtree::collect_own() {
  const auto add = [&](VariableId id, const Variable& range) {
    place_of_[index(id)] = static_cast<int>(own_.size());
    own_.push_back(id);
    ranges_.push_back(range);
  };
  std::vector<bool> is_location(network().variables.size(), false);
  for (const AutomatonId child : children_) {
    const Component& component = all_.known_[index(child)]->value();
    const VariableId location = network().automaton(child).location;
    is_location[index(location)] = true;
    add(location, component.location);
    add(component.memory_id, component.memory);
  }
  for (std::uint32_t v = 0; v < network().variables.size(); ++v) {
    const VariableId id{v};
    if (id == status_ || id == automaton_.gate || is_location[v]) continue;
    if (!all_.is_inside(root_, id)) continue;
    const bool is_a_childs =
        std::ranges::any_of(children_, [&](AutomatonId child) {
          return all_.is_inside(child, id);
        });
    if (!is_a_childs) add(id, network().variables[v]);
  }
}

void OpenSubtree::collect_changes() {
  const Variable& range = network().variable(status_);
  std::set<std::pair<std::optional<int>, int>> known;
  for (std::uint32_t a = 0; a < network().automata.size(); ++a) {
    if (AutomatonId{a} == root_) continue;
    for (const Edge& edge : network().automata[a].edges) {
      for (const Assignment& update : edge.updates) {
        if (update.variable != status_) continue;
        const auto value = constant_value(update);
        for (int to = range.min; to <= range.max; ++to) {
          if (value && *value != to) continue;
          for (int from = range.min; from <= range.max; ++from) {
            if (excludes(edge.guard, status_, from)) continue;
            if (known.emplace(from, to).second) changes_.push_back({from, to});
          }
        }
      }
    }
  }
}

std::optional<std::uint32_t> OpenSubtree::state_number(Values values) {
  const auto [known, is_new] = numbers_.try_emplace(
      values, static_cast<std::uint32_t>(states_.size()));
  if (is_new) {
    if (states_.size() >= all_.limits_.states) return std::nullopt;
    states_.push_back({std::move(values), {}, false});
  }
  return known->second;
}

// Steps that nobody notices have label 0.
std::uint32_t OpenSubtree::label_number(Label label) {
  const bool is_untimed = network().ticks == TickSemantics::None;
  const bool is_silent = is_always(label.guard) && label.updates.empty() &&
                         label.mark == 0 &&
                         (is_untimed || label.when.is_urgent());
  if (is_silent) return LabelledGraph::kSilent;
  std::vector<std::int32_t> key = {label.when.lower, label.when.upper,
                                   label.mark};
  append(key, label.guard);
  for (const Assignment& update : label.updates) {
    key.push_back(static_cast<std::int32_t>(index(update.variable)));
    append(key, update.value);
  }
  const auto [known, is_new] = label_numbers_.try_emplace(
      std::move(key), static_cast<std::uint32_t>(labels_.size()) + kFirstLabel);
  if (is_new) labels_.push_back(std::move(label));
  return known->second;
}

bool OpenSubtree::expand(std::uint32_t state) {
  states_[state].is_expanded = true;
  for (std::uint32_t number = 0; number <= children_.size(); ++number) {
    const Automaton& moving = member(number);
    const auto value_of = [&](VariableId variable) {
      return states_[state].values[*own(variable)];
    };
    if (number > 0 && value_of(*moving.gate) == 0) continue;
    const Variable& location = ranges_[*own(moving.location)];
    const LocationId here{
        static_cast<std::uint32_t>(value_of(moving.location) - location.min)};
    for (std::uint32_t e = 0; e < moving.edges.size(); ++e) {
      if (moving.edges[e].source != here) continue;
      if (!expand(state, number, e)) return false;
    }
  }
  return true;
}

// A variable of others whose value the subtree keeps is told apart by it.
bool OpenSubtree::expand(std::uint32_t state, std::uint32_t number,
                         std::uint32_t place) {
  ask_budget();
  const Automaton& moving = member(number);
  const Edge& edge = moving.edges[place];
  const bool is_marked =
      number == 0 && !all_.marks_.empty() &&
      all_.marks_[automaton_.first_edge + place] != 0;
  const std::uint8_t mark = is_marked || edge.is_open_round ? 1 : 0;
  std::vector<VariableId> kept;
  std::vector<VariableId> assigned;
  for (const Assignment& update : edge.updates) {
    if (own(update.variable)) {
      for (const Term& term : update.value.terms()) {
        if (term.operation != Operation::Variable) continue;
        const VariableId read{static_cast<std::uint32_t>(term.operand)};
        if (own(read) || read == automaton_.gate) continue;
        if (std::ranges::find(assigned, read) != assigned.end()) return false;
        if (std::ranges::find(kept, read) == kept.end()) kept.push_back(read);
      }
    } else {
      assigned.push_back(update.variable);
    }
  }
  std::uint64_t count = 1;
  for (const VariableId each : kept) {
    if (index(each) >= network().variables.size()) return false;
    count *= static_cast<std::uint64_t>(network().variable(each).domain_size());
    if (count > kMostRead) return false;
  }
  for (std::uint64_t n = 0; n < count; ++n) {
    std::vector<std::pair<VariableId, int>> read;
    std::uint64_t rest = n;
    for (const VariableId each : kept) {
      const Variable& range = network().variable(each);
      const auto size = static_cast<std::uint64_t>(range.domain_size());
      read.emplace_back(each, range.min + static_cast<int>(rest % size));
      rest /= size;
    }
    if (!add_arc(state, {number, place}, edge, mark, read)) return false;
  }
  return true;
}

bool OpenSubtree::add_arc(
    std::uint32_t state, Component::Member which, const Edge& edge,
    std::uint8_t mark, const std::vector<std::pair<VariableId, int>>& read) {
  Values values = states_[state].values;
  const KnownValue known =
      [&](VariableId variable) -> std::optional<std::int64_t> {
    if (variable == automaton_.gate) return 1;
    if (const auto place = own(variable)) return values[*place];
    return std::nullopt;
  };
  Label label{edge.when, mark, residual(edge.guard, known), {}};
  if (is_never(label.guard)) return true;
  if (is_always(label.guard)) label.guard = {};
  const KnownValue told =
      [&](VariableId variable) -> std::optional<std::int64_t> {
    for (const auto& [each, value] : read) {
      if (each == variable) return value;
    }
    return known(variable);
  };
  for (const auto& [variable, value] : read) {
    label.guard = both(std::move(label.guard), equals(variable, value));
  }
  const auto put = [&](std::size_t place, std::int64_t value) {
    const Variable& range = ranges_[place];
    if (value < range.min || value > range.max) return false;
    values[place] = static_cast<int>(value);
    return true;
  };
  for (const Assignment& update : edge.updates) {
    Expression value =
        residual(update.value, own(update.variable) ? told : known);
    if (const auto place = own(update.variable)) {
      const auto constant = value.is_true()
                                ? std::optional<std::int32_t>(1)
                                : value.only(Operation::Constant);
      if (!constant || !put(*place, *constant)) return false;
    } else {
      label.updates.push_back({update.variable, std::move(value)});
    }
  }
  const VariableId location = member(which.child).location;
  const std::size_t place = *own(location);
  if (!put(place, ranges_[place].min + static_cast<int>(index(edge.target)))) {
    return false;
  }
  const auto target = state_number(std::move(values));
  if (!target) return false;
  const Arc arc{label_number(std::move(label)), *target, which, false};
  states_[state].arcs.push_back(arc);
  return true;
}

bool OpenSubtree::explore() {
  const Variable& range = network().variable(status_);
  const auto statuses = static_cast<std::size_t>(range.domain_size());
  std::vector<bool> seen;
  std::deque<std::pair<std::uint32_t, int>> open;
  const auto found = [&](std::uint32_t state, int status) {
    const std::size_t place =
        state * statuses + static_cast<std::size_t>(status - range.min);
    if (place >= seen.size()) seen.resize((place + 1) * 2, false);
    if (seen[place]) return;
    seen[place] = true;
    open.emplace_back(state, status);
  };
  Values initial;
  for (const Variable& each : ranges_) initial.push_back(each.initial);
  const auto first = state_number(std::move(initial));
  if (!first) return false;
  found(*first, range.initial);
  const std::size_t location = *own(automaton_.location);
  while (!open.empty()) {
    const auto [state, status] = open.front();
    open.pop_front();
    if (!states_[state].is_expanded && !expand(state)) return false;
    if (states_[state].values[location] == ranges_[location].min) {
      for (const Change& change : changes_) {
        if (change.from == status) found(state, change.to);
      }
    }
    const KnownValue known =
        [&, status = status](
            VariableId variable) -> std::optional<std::int64_t> {
      return variable == status_ ? std::optional<std::int64_t>(status)
                                 : std::nullopt;
    };
    for (Arc& arc : states_[state].arcs) {
      if (arc.label == LabelledGraph::kSilent) {
        arc.is_used = true;
        found(arc.target, status);
        continue;
      }
      const Label& label = labels_[arc.label - kFirstLabel];
      if (is_never(residual(label.guard, known))) continue;
      arc.is_used = true;
      std::optional<int> after = status;
      for (const Assignment& update : label.updates) {
        if (update.variable != status_) continue;
        const auto value = residual(update.value, known);
        after = value.only(Operation::Constant);
      }
      if (after) {
        found(arc.target, *after);
      } else {
        for (int each = range.min; each <= range.max; ++each) {
          found(arc.target, each);
        }
      }
    }
  }
  return true;
}

LabelledGraph OpenSubtree::graph() const {
  LabelledGraph graph;
  const std::size_t location = *own(automaton_.location);
  std::vector<LabelledGraph::Arc> arcs;
  for (std::uint32_t s = 0; s < states_.size(); ++s) {
    arcs.clear();
    bool is_quiet = true;
    for (const Arc& arc : states_[s].arcs) {
      if (!arc.is_used) continue;
      is_quiet = is_quiet && arc.label != LabelledGraph::kSilent;
      arcs.push_back({arc.label, arc.target});
    }
    if (is_quiet) arcs.push_back({kQuiet, s});
    if (states_[s].values[location] == ranges_[location].min) {
      arcs.push_back({kAtRest, s});
    }
    graph.add_state(arcs);
  }
  return graph;
}

std::optional<Component> OpenSubtree::drawn() {
  Component made;
  made.memory_id = all_.memory_of(root_);
  made.graph_ = graph();
  made.partition_ =
      coarsest_partition(made.graph_, Equivalence::Branching);
  const std::vector<std::uint32_t>& block = made.partition_.block;
  const std::size_t location = *own(automaton_.location);
  made.places_.resize(made.partition_.blocks);
  std::vector<bool> is_rest(made.partition_.blocks, false);
  for (std::uint32_t s = 0; s < states_.size(); ++s) {
    is_rest[block[s]] = states_[s].values[location] == ranges_[location].min;
  }
  Automaton& automaton = made.automaton;
  automaton.kind = AutomatonKind::Node;
  automaton.name = automaton_.name;
  automaton.node = automaton_.node;
  automaton.location = automaton_.location;
  automaton.gate = automaton_.gate;
  automaton.locals = {made.memory_id};
  automaton.locations.push_back({"start_", LocationRole::Start, {}});
  int memories = 0;
  for (std::uint32_t b = 0; b < made.partition_.blocks; ++b) {
    if (is_rest[b]) {
      made.places_[b] = {0, memories++};
    } else {
      made.places_[b] = {static_cast<int>(automaton.locations.size()), 0};
      automaton.locations.push_back({"block_" + std::to_string(b),
                                     LocationRole::Inner,
                                     {}});
    }
  }
  made.location = network().variable(automaton_.location);
  made.location.min = made.location.initial = 0;
  made.location.max = static_cast<int>(automaton.locations.size()) - 1;
  made.location.value_names.clear();
  made.memory = {VariableRole::Local, "memory", 0, std::max(0, memories - 1),
                 0, {}, root_};
  made.memory.initial = made.places_[block[0]].memory;

  const LabelledGraph small =
      quotient(made.graph_, made.partition_, Equivalence::Branching);
  for (std::uint32_t b = 0; b < small.size(); ++b) {
    for (const LabelledGraph::Arc& arc : small.arcs(b)) {
      if (arc.label == kQuiet || arc.label == kAtRest) continue;
      if (automaton.edges.size() >= all_.limits_.edges) return std::nullopt;
      const Component::Place from = made.places_[b];
      const Component::Place to = made.places_[arc.target];
      Edge edge;
      edge.source = LocationId{static_cast<std::uint32_t>(from.location)};
      edge.target = LocationId{static_cast<std::uint32_t>(to.location)};
      if (arc.label != LabelledGraph::kSilent) {
        const Label& label = labels_[arc.label - kFirstLabel];
        edge.when = label.when;
        edge.guard = label.guard;
        edge.updates = label.updates;
        edge.is_open_round = label.mark != 0;
      }
      if (from.location == 0 && memories > 1) {
        edge.guard =
            both(equals(made.memory_id, from.memory), std::move(edge.guard));
      }
      if (memories > 1 && (from.location == 0 || to.location == 0)) {
        edge.updates.push_back(
            {made.memory_id, Expression::constant(to.memory)});
      }
      automaton.edges.push_back(std::move(edge));
      made.drawn_.push_back({arc.label, b, arc.target});
    }
  }
  made.own_ = own_;
  made.first_.push_back(0);
  for (State& state : states_) {
    for (const Arc& arc : state.arcs) {
      if (!arc.is_used) continue;
      made.arcs_.push_back({arc.label, arc.target, arc.member});
    }
    made.first_.push_back(static_cast<std::uint32_t>(made.arcs_.size()));
  }
  made.states_ = std::move(numbers_);
  return made;
}

std::optional<Component> OpenSubtree::take() && {
  if (!own(automaton_.location) || !explore()) return std::nullopt;
  return drawn();
}

}  // namespace btcheck
