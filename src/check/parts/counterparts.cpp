// SPDX-License-Identifier: MIT
#include "check/parts/counterparts.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "explore/components/cut_part.hpp"
#include "explore/reduce/call_protocol.hpp"
#include "explore/state/accesses.hpp"

namespace btcheck {
namespace {

bool are_alike(const Node& one, const Node& other) {
  return one.type == other.type && one.name == other.name;
}

// By NodeId.
std::vector<std::vector<AutomatonId>> timers_of(const Network& network) {
  std::vector<std::vector<AutomatonId>> timers(network.node_automaton.size());
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& each = network.automata[a];
    if (each.kind != AutomatonKind::Timer) continue;
    timers[index(each.node)].push_back(AutomatonId{a});
  }
  return timers;
}

// The number of each state variable; nothing where several are called so.
std::map<std::string_view, std::optional<std::size_t>> by_name(
    const Network& network) {
  std::map<std::string_view, std::optional<std::size_t>> numbers;
  for (std::size_t v = 0; v < network.state_variable.size(); ++v) {
    const Variable& variable = network.variable(network.state_variable[v]);
    const auto [known, is_new] = numbers.try_emplace(variable.name, v);
    if (!is_new) known->second.reset();
  }
  return numbers;
}

}  // namespace

std::vector<std::optional<NodeId>> nodes_since(const BehaviorTree& earlier,
                                               const BehaviorTree& tree) {
  const std::size_t before = earlier.nodes.size();
  const std::size_t now = tree.nodes.size();
  const std::size_t fewer = std::min(before, now);
  std::size_t front = 0;
  while (front < fewer && are_alike(earlier.nodes[front], tree.nodes[front])) {
    ++front;
  }
  std::size_t back = 0;
  while (back < fewer - front && are_alike(earlier.nodes[before - 1 - back],
                                           tree.nodes[now - 1 - back])) {
    ++back;
  }
  if (before == now) front = before - back;
  std::vector<std::optional<NodeId>> nodes(before);
  for (std::size_t n = 0; n < before; ++n) {
    if (n < front) {
      nodes[n] = NodeId{static_cast<std::uint32_t>(n)};
    } else if (n >= before - back) {
      nodes[n] = NodeId{static_cast<std::uint32_t>(now - (before - n))};
    }
  }
  return nodes;
}

Counterparts::Counterparts(const EarlierReport& earlier,
                           const BehaviorTree& tree, const Network& network)
    : earlier_(earlier.network),
      network_(network),
      nodes_(nodes_since(earlier.tree, tree)),
      automata_(earlier_.automata.size()),
      variables_(earlier_.variables.size()),
      is_kept_(earlier_.edge_count(), false),
      is_leaf_(earlier_.automata.size(), false) {
  map_automata();
  map_state_variables();
  map_variables();
  compare();
}

void Counterparts::map_automata() {
  const auto timers = timers_of(earlier_);
  const auto timers_here = timers_of(network_);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (!nodes_[n]) continue;
    const std::size_t here = index(*nodes_[n]);
    map(earlier_.node_automaton[n], network_.node_automaton[here]);
    const std::size_t both =
        std::min(timers[n].size(), timers_here[here].size());
    for (std::size_t i = 0; i < both; ++i) {
      map(timers[n][i], timers_here[here][i]);
    }
  }
}

// By their names; and who moves them.
void Counterparts::map_state_variables() {
  const auto named = by_name(network_);
  for (const auto& [name, one] : by_name(earlier_)) {
    const auto other = named.find(name);
    if (!one || other == named.end() || !other->second) continue;
    map(earlier_.state_variable[*one], network_.state_variable[*other->second]);
    const auto& mover = earlier_.state_automaton[*one];
    const auto& mover_here = network_.state_automaton[*other->second];
    if (mover && mover_here) map(*mover, *mover_here);
  }
}

void Counterparts::map_variables() {
  for (std::uint32_t a = 0; a < automata_.size(); ++a) {
    if (!automata_[a]) continue;
    const Automaton& one = earlier_.automata[a];
    const Automaton& other = network_.automaton(*automata_[a]);
    map(one.location, other.location);
    if (one.gate && other.gate) map(*one.gate, *other.gate);
    if (one.locals.size() == other.locals.size()) {
      for (std::size_t i = 0; i < one.locals.size(); ++i) {
        map(one.locals[i], other.locals[i]);
      }
    }
    if (one.kind != AutomatonKind::Node) continue;
    map(earlier_.node_status[index(one.node)],
        network_.node_status[index(other.node)]);
  }
  if (earlier_.fault && network_.fault) map(*earlier_.fault, *network_.fault);
}

bool Counterparts::is_same(const Automaton& earlier,
                           const Automaton& here) const {
  std::vector<std::int32_t> one;
  std::vector<std::int32_t> other;
  append(
      earlier, [&](VariableId name) { return name_here(name); }, one);
  append(
      here, [](VariableId name) { return name; }, other);
  return one == other &&
         std::ranges::equal(earlier.locations, here.locations, {},
                            &Location::role, &Location::role);
}

// Whatever differs has to be called before it does anything, and what all
// others work on is as it was.
bool Counterparts::can_keep(const std::vector<bool>& differs) const {
  const bool is_alike =
      earlier_.profile == network_.profile &&
      earlier_.ticks == network_.ticks &&
      earlier_.fault.has_value() == network_.fault.has_value();
  if (!is_alike) return false;
  for (std::size_t a = 0; a < network_.automata.size(); ++a) {
    const Automaton& automaton = network_.automata[a];
    if (!differs[a] || automaton.gate) continue;
    // A timer waits where it begins, for its node to start it.
    const auto begins = static_cast<std::uint32_t>(
        network_.variable(automaton.location).initial);
    const bool waits = std::ranges::none_of(
        automaton.edges,
        [&](const Edge& edge) { return index(edge.source) == begins; });
    if (automaton.kind != AutomatonKind::Timer || !waits) return false;
  }
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    if (!variables_[v]) continue;
    const Variable& one = earlier_.variables[v];
    const Variable& other = network_.variable(*variables_[v]);
    const bool is_own = other.owner && differs[index(*other.owner)];
    if (one.initial != other.initial ||
        (!is_own && (one.min != other.min || one.max != other.max))) {
      return false;
    }
  }
  return true;
}

void Counterparts::compare() {
  std::vector<bool> differs(network_.automata.size(), true);
  for (std::size_t a = 0; a < automata_.size(); ++a) {
    if (!automata_[a]) continue;
    differs[index(*automata_[a])] =
        !is_same(earlier_.automata[a], network_.automaton(*automata_[a]));
  }
  // A timer does its part of what its node does.
  for (std::size_t a = 0; a < differs.size(); ++a) {
    const Automaton& automaton = network_.automata[a];
    if (!differs[a] || automaton.kind != AutomatonKind::Timer) continue;
    differs[index(network_.node_automaton[index(automaton.node)])] = true;
  }
  keeps_time_ = can_keep(differs);
  if (!keeps_time_) return;
  keeps_all_ = automata_.size() == differs.size() &&
               std::ranges::find(differs, true) == differs.end();
  std::vector<bool> calls(network_.variables.size(), false);
  for (std::size_t a = 0; a < differs.size(); ++a) {
    const auto& gate = network_.automata[a].gate;
    if (differs[a] && gate) calls[index(*gate)] = true;
  }
  for (std::uint32_t a = 0; a < automata_.size(); ++a) {
    const bool is_other = automata_[a] && differs[index(*automata_[a])];
    if (!is_other || !has_simple_turns(AutomatonId{a})) continue;
    is_leaf_[a] = true;
    calls[index(*network_.automaton(*automata_[a]).gate)] = false;
  }
  for (std::size_t a = 0; a < automata_.size(); ++a) {
    if (!automata_[a] || differs[index(*automata_[a])]) continue;
    const Automaton& here = network_.automaton(*automata_[a]);
    for (std::size_t e = 0; e < here.edges.size(); ++e) {
      is_kept_[earlier_.automata[a].first_edge + e] = std::ranges::none_of(
          here.edges[e].updates, [&](const Assignment& update) {
            return calls[index(update.variable)];
          });
    }
  }
}

// It calls nobody, needs no time, and has nothing of its own but where it
// stands.
bool Counterparts::has_simple_turns(AutomatonId earlier) const {
  const auto is_simple = [](const Network& network, AutomatonId id) {
    const Automaton& automaton = network.automaton(id);
    if (automaton.kind != AutomatonKind::Node || !automaton.gate ||
        !automaton.locals.empty()) {
      return false;
    }
    const bool has_timer =
        std::ranges::any_of(network.automata, [&](const Automaton& other) {
          return other.kind == AutomatonKind::Timer &&
                 other.node == automaton.node;
        });
    const bool calls =
        std::ranges::any_of(automaton.locations, [](const Location& location) {
          return location.role == LocationRole::Call ||
                 location.role == LocationRole::Called;
        });
    return !has_timer && !calls;
  };
  return is_simple(earlier_, earlier) &&
         is_simple(network_, *automata_[index(earlier)]);
}

std::optional<AutomatonId> Counterparts::leaf_of(Step earlier) const {
  if (earlier.edge == kTimeStep) return std::nullopt;
  const AutomatonId owner{static_cast<std::uint32_t>(
      &earlier_.owner_of_edge(earlier.edge) - earlier_.automata.data())};
  return is_leaf_[index(owner)] ? std::optional(owner) : std::nullopt;
}

bool Counterparts::ends_turn(Step earlier) const {
  return btcheck::ends_turn(earlier_.owner_of_edge(earlier.edge),
                            earlier_.edge(earlier.edge));
}

std::optional<Counterparts::Edges> Counterparts::turn(
    AutomatonId leaf, const Edges& earlier) const {
  constexpr std::size_t kLongest = 8;
  const Automaton& owner = earlier_.automaton(leaf);
  const Automaton& here = network_.automaton(*automata_[index(leaf)]);
  const Automaton before =
      with_names(owner, [&](VariableId name) { return name_here(name); });
  // What a turn has made of variables, its own place left out.
  using Effect = std::map<VariableId, std::int64_t>;
  const auto add = [&](const Edge& edge, Effect& effect) {
    for (const Assignment& update : edge.updates) {
      const auto value = constant_value(update);
      if (!value) return false;
      if (update.variable != here.location) effect[update.variable] = *value;
    }
    return true;
  };
  const auto edge_before = [&](std::uint32_t number) -> const Edge& {
    return before.edges[number - owner.first_edge];
  };
  Effect wanted;
  for (const std::uint32_t edge : earlier) {
    if (!add(edge_before(edge), wanted)) return std::nullopt;
  }
  // The first edge asks what the call was for; it is asked the same here.
  const Expression& asked = edge_before(earlier.front()).guard;
  const auto may_begin = [&](const Expression& guard) {
    return asked.is_true() ? guard.is_true() : guard == asked;
  };
  const LocationId start{
      static_cast<std::uint32_t>(network_.variable(here.location).initial)};
  struct Way {
    Edges edges;
    LocationId at;
    Effect effect;
  };
  std::vector<Way> ways = {{{}, start, {}}};
  for (std::size_t next = 0; next < ways.size(); ++next) {
    const Way way = ways[next];
    if (way.edges.size() == kLongest) break;
    for (std::uint32_t e = 0; e < here.edges.size(); ++e) {
      const Edge& edge = here.edges[e];
      const bool is_open =
          way.edges.empty() ? may_begin(edge.guard) : edge.guard.is_true();
      if (edge.source != way.at || !is_open || edge.when.lower != 0) continue;
      Way longer = way;
      longer.edges.push_back(here.first_edge + e);
      longer.at = edge.target;
      if (!add(edge, longer.effect)) continue;
      if (!btcheck::ends_turn(here, edge)) {
        ways.push_back(std::move(longer));
      } else if (longer.at == start && longer.effect == wanted) {
        return longer.edges;
      }
    }
  }
  return std::nullopt;
}

std::optional<Step> Counterparts::step(Step earlier) const {
  if (earlier.edge == kTimeStep) return earlier;
  const Automaton& owner = earlier_.owner_of_edge(earlier.edge);
  const auto& here =
      automata_[static_cast<std::size_t>(&owner - earlier_.automata.data())];
  if (!here) return std::nullopt;
  const Automaton& automaton = network_.automaton(*here);
  const std::uint32_t place = earlier.edge - owner.first_edge;
  if (place >= automaton.edges.size()) return std::nullopt;
  earlier.edge = automaton.first_edge + place;
  return earlier;
}

std::optional<Step> Counterparts::kept(Step earlier) const {
  const bool is_kept =
      earlier.edge == kTimeStep ? keeps_time_ : bool{is_kept_[earlier.edge]};
  return is_kept ? step(earlier) : std::nullopt;
}

}  // namespace btcheck
