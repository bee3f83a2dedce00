// SPDX-License-Identifier: MIT
//
// Variables that the rest touches as well have no values here: what an edge
// asks of them and assigns to them is put on its label, with the values of the
// part's own variables put in. So a state is one of the part alone, and the
// graph is right beside whatever the rest is. Too many states would be found if
// it could do anything: reset a node that still runs, say. So the calls and
// answers of the subtree's root are followed beside the states, and the rest
// takes part in them only as the edges of its automata do.
#include "explore/components/open_part.hpp"

#include <algorithm>
#include <deque>

#include "explore/components/residual.hpp"
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

OpenPart::OpenPart(const CutPart& part, const ComponentTable::Limits& limits)
    : part_(part),
      limits_(limits),
      members_(part.members()),
      timers_(part.timers()),
      automaton_(members_[0].automaton),
      is_called_(part.is_called()),
      status_(part.status()),
      gate_(part.gate()),
      place_of_(part.names().size(), -1) {
  for (std::size_t i = 0; i < part.own().size(); ++i) {
    place_of_[index(part.own()[i])] = static_cast<int>(i);
  }
  for (const CutPart::Moving& member : members_) {
    edges_.push_back(edges_by_place(member));
  }
}

std::vector<std::vector<std::uint32_t>> OpenPart::edges_by_place(
    const CutPart::Moving& member) {
  const Component* shape = member.shape;
  const auto& edges = member.automaton.edges;
  std::vector<std::vector<std::uint32_t>> by_place(
      member.automaton.locations.size() +
      (shape == nullptr ? 0 : static_cast<std::size_t>(shape->memory.max)));
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const Component::Place from =
        shape == nullptr
            ? Component::Place{static_cast<int>(index(edges[e].source)), 0}
            : shape->places_[shape->drawn_[e].from];
    by_place[place_number(shape, from)].push_back(e);
  }
  return by_place;
}

// Those at rest first.
std::size_t OpenPart::place_number(const Component* shape,
                                   const Component::Place& place) {
  if (shape == nullptr) return static_cast<std::size_t>(place.location);
  return static_cast<std::size_t>(
      place.location == 0 ? place.memory : shape->memory.max + place.location);
}

std::optional<std::size_t> OpenPart::own(VariableId variable) const {
  const int place = place_of_[index(variable)];
  return place < 0 ? std::nullopt
                   : std::optional(static_cast<std::size_t>(place));
}

std::optional<std::uint32_t> OpenPart::state_number(Values values) {
  const auto [known, is_new] =
      numbers_.try_emplace(values, static_cast<std::uint32_t>(states_.size()));
  if (is_new) {
    if (states_.size() >= limits_.states) return std::nullopt;
    states_.push_back({std::move(values), {}, false, {}});
  }
  return known->second;
}

// Steps that nobody notices have label 0.
std::uint32_t OpenPart::label_number(Label label) {
  const bool is_silent = is_always(label.guard) && label.updates.empty() &&
                         !label.is_like_time &&
                         (!is_timed() || label.when.is_urgent());
  if (is_silent) return LabelledGraph::kSilent;
  std::vector<std::int32_t> key = {label.when.lower, label.when.upper,
                                   label.is_like_time};
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

bool OpenPart::expand(std::uint32_t state) {
  states_[state].is_expanded = true;
  for (std::uint32_t number = 0; number < members_.size(); ++number) {
    const Automaton& moving = members_[number].automaton;
    const auto value_of = [&](VariableId variable) {
      return states_[state].values[*own(variable)];
    };
    // That of the subtree itself is open while anything moves in it.
    const bool is_closed =
        moving.gate && moving.gate != gate_ && value_of(*moving.gate) == 0;
    if (is_closed) continue;
    const Component* shape = members_[number].shape;
    const bool remembers =
        shape != nullptr && members_[number].side == PartSide::Inside;
    const Component::Place here{
        value_of(moving.location) - range_of(moving.location).min,
        remembers ? value_of(members_[number].memory) : 0};
    for (const std::uint32_t e : edges_[number][place_number(shape, here)]) {
      if (!expand(state, {number, e})) return false;
    }
  }
  return true;
}

// A variable of others whose value the part keeps is told apart by it.
bool OpenPart::expand(std::uint32_t state, Component::Member which) {
  ask_budget();
  const Edge& edge = members_[which.number].automaton.edges[which.edge];
  Interval when = edge.when;
  if (when.needs_clock() && is_timed()) {
    const int clock = states_[state].values[*own(*members_[0].clock)];
    if (clock < when.lower) return true;
    when = clock == when.upper ? kAtOnce : kAnyTime;
  }
  std::vector<VariableId> kept;
  std::vector<VariableId> assigned;
  for (const Assignment& update : edge.updates) {
    if (!own(update.variable)) {
      assigned.push_back(update.variable);
      continue;
    }
    for (const Term& term : update.value.terms()) {
      if (term.operation != Operation::Variable) continue;
      const VariableId read{static_cast<std::uint32_t>(term.operand)};
      if (own(read)) continue;
      if (std::ranges::find(assigned, read) != assigned.end()) return false;
      if (std::ranges::find(kept, read) == kept.end()) kept.push_back(read);
    }
  }
  std::uint64_t count = 1;
  for (const VariableId each : kept) {
    if (part_.is_behind(each)) return false;
    count *= static_cast<std::uint64_t>(range_of(each).domain_size());
    if (count > kMostRead) return false;
  }
  for (std::uint64_t n = 0; n < count; ++n) {
    std::vector<std::pair<VariableId, int>> read;
    std::uint64_t rest = n;
    for (const VariableId each : kept) {
      const Variable& range = range_of(each);
      const auto size = static_cast<std::uint64_t>(range.domain_size());
      read.emplace_back(each, range.min + static_cast<int>(rest % size));
      rest /= size;
    }
    if (!add_arc(state, which, when, read)) return false;
  }
  return true;
}

bool OpenPart::add_arc(std::uint32_t state, Component::Member which,
                       const Interval& when,
                       const std::vector<std::pair<VariableId, int>>& read) {
  const CutPart::Moving& member = members_[which.number];
  const Edge& edge = member.automaton.edges[which.edge];
  Values values = states_[state].values;
  const KnownValue known =
      [&](VariableId variable) -> std::optional<std::int64_t> {
    if (variable == gate_ && part_.side() == PartSide::Inside) return 1;
    if (const auto place = own(variable)) return values[*place];
    return std::nullopt;
  };
  Label label;
  label.when = when;
  label.is_like_time = edge.is_like_time;
  label.guard = residual(edge.guard, known);
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
  const auto put = [&](VariableId id, std::int64_t value) {
    const Variable& range = range_of(id);
    if (value < range.min || value > range.max) return false;
    values[*own(id)] = static_cast<int>(value);
    return true;
  };
  const auto start_clock = [&](const CutPart::Moving& moving) {
    if (moving.clock) values[*own(*moving.clock)] = 0;
  };
  for (const Assignment& update : edge.updates) {
    const auto place = own(update.variable);
    Expression value = residual(update.value, place ? told : known);
    if (!place) {
      label.updates.push_back({update.variable, std::move(value)});
      continue;
    }
    const auto constant = value.is_true() ? std::optional<std::int32_t>(1)
                                          : value.only(Operation::Constant);
    if (!constant || !put(update.variable, *constant)) return false;
    for (const CutPart::Moving& timer : timers_) {
      if (timer.automaton.location == update.variable) {
        start_clock(timer);
      }
    }
  }
  const VariableId location = member.automaton.location;
  if (!put(location,
           range_of(location).min + static_cast<int>(index(edge.target)))) {
    return false;
  }
  start_clock(member);
  const auto target = state_number(std::move(values));
  if (!target) return false;
  const Arc arc{label_number(std::move(label)), *target, which, false};
  states_[state].arcs.push_back(arc);
  return true;
}

bool OpenPart::is_at_rest(const Values& values) const {
  return is_called_ &&
         values[*own(automaton_.location)] == range_of(automaton_.location).min;
}

// Components move on by their own tables; timers that have counted so far are
// due at once, before anything else happens.
std::optional<Component::Values> OpenPart::later(Values values) const {
  for (const CutPart::Moving& member : members_) {
    if (member.shape == nullptr) continue;
    int& stands_at = values[*own(member.side == PartSide::Inside
                                     ? member.memory
                                     : member.automaton.location)];
    stands_at = member.shape->later[static_cast<std::size_t>(stands_at)];
  }
  const auto count = [&](const CutPart::Moving& moving, bool is_timer) {
    const Automaton& counting = moving.automaton;
    if (!moving.clock) return true;
    int& clock = values[*own(*moving.clock)];
    int& location = values[*own(counting.location)];
    const int first = range_of(counting.location).min;
    const Edge* due = nullptr;
    int greatest = 0;
    for (const Edge& edge : counting.edges) {
      if (location != first + static_cast<int>(index(edge.source))) continue;
      greatest = std::max(greatest, edge.when.greatest_clock());
      if (!is_timer || clock + 1 != edge.when.upper) continue;
      if (due != nullptr) return false;
      due = &edge;
    }
    if (clock < greatest) ++clock;
    if (due == nullptr) return true;
    location = first + static_cast<int>(index(due->target));
    clock = 0;
    return true;
  };
  bool is_known = count(members_[0], false);
  for (const CutPart::Moving& timer : timers_) {
    is_known = is_known && count(timer, true);
  }
  return is_known ? std::optional(std::move(values)) : std::nullopt;
}

// While the subtree is called its parent waits; nobody else touches the two.
template <class Found>
void OpenPart::for_each_change(const Call& call, const Values& values,
                               Found found) const {
  const bool may_change =
      part_.side() == PartSide::Inside ? is_at_rest(values) : call.is_called;
  if (!may_change) return;
  for (const auto& [from, to] : part_.changes()) {
    if (from == call.status) found(Call{to, call.is_called});
  }
  if (part_.side() == PartSide::Outside) found(Call{call.status, false});
}

// Beside each state the calls are followed that lead to it.
bool OpenPart::explore() {
  const Variable& range = range_of(status_);
  const bool is_inside = part_.side() == PartSide::Inside;
  const std::size_t calls = 2 * static_cast<std::size_t>(range.domain_size());
  std::vector<bool> seen;
  std::deque<std::pair<std::uint32_t, Call>> open;
  const auto found = [&](std::uint32_t state, const Call& call) {
    const std::size_t place =
        state * calls + 2 * static_cast<std::size_t>(call.status - range.min) +
        call.is_called;
    if (place >= seen.size()) seen.resize((place + 1) * 2, false);
    if (seen[place]) return;
    seen[place] = true;
    open.emplace_back(state, call);
  };
  Values initial;
  for (const VariableId each : part_.own()) {
    initial.push_back(range_of(each).initial);
  }
  const auto first = state_number(std::move(initial));
  if (!first) return false;
  found(*first, {range.initial, false});
  while (!open.empty()) {
    const auto [state, call] = open.front();
    open.pop_front();
    if (!states_[state].is_expanded && !expand(state)) return false;
    const bool rests = is_at_rest(states_[state].values);
    for_each_change(call, states_[state].values,
                    [&, state = state](const Call& to) { found(state, to); });
    const KnownValue known =
        [&, call = call](VariableId variable) -> std::optional<std::int64_t> {
      if (variable == status_) return call.status;
      if (variable == gate_ && !is_inside) return call.is_called ? 1 : 0;
      return std::nullopt;
    };
    bool is_urgent = false;
    const bool is_idle = rests && !part_.may_enter(call.status);
    for (Arc& arc : states_[state].arcs) {
      if (is_idle) break;
      if (arc.label == LabelledGraph::kSilent) {
        arc.is_used = is_urgent = true;
        found(arc.target, call);
        continue;
      }
      const Label& label = labels_[arc.label - kFirstLabel];
      const Expression guard = residual(label.guard, known);
      if (is_never(guard)) continue;
      arc.is_used = true;
      is_urgent |= is_always(guard) && label.when.is_urgent();
      Call after = call;
      bool is_status_known = true;
      for (const Assignment& update : label.updates) {
        if (update.variable != status_ && update.variable != gate_) continue;
        const auto value =
            residual(update.value, known).only(Operation::Constant);
        if (update.variable == gate_) {
          if (!value) return false;
          after.is_called = !is_inside && *value != 0;
        } else if (value) {
          after.status = *value;
        } else {
          is_status_known = false;
        }
      }
      for (int each = range.min; each <= range.max; ++each) {
        if (is_status_known && each != after.status) continue;
        found(arc.target, {each, after.is_called});
      }
    }
    if (!is_timed()) continue;
    // In a subtree that is called, time may pass where it changes nothing.
    const bool waits =
        !rests && !is_urgent && !(call.is_called && part_.waits_instantly());
    if (!rests && !waits) continue;
    auto values = later(states_[state].values);
    if (!values) return false;
    const auto after_time = state_number(std::move(*values));
    if (!after_time) return false;
    if (is_called_ && !rests) {
      if (*after_time != state) return false;
      is_instant_ = false;
      continue;
    }
    states_[state].later = *after_time;
    found(*after_time, call);
  }
  return true;
}

LabelledGraph OpenPart::graph() const {
  LabelledGraph graph;
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
    if (is_at_rest(states_[s].values)) arcs.push_back({kRest, s});
    if (const auto later = states_[s].later) arcs.push_back({kTime, *later});
    graph.add_state(arcs);
  }
  return graph;
}

namespace {

// A graph without the states that go on silently and in no other way, and with
// equivalent ones as one. Nothing of a state that nobody has called is silent.
struct Minimal {
  LabelledGraph graph;
  std::vector<std::uint32_t> state_of;  // by state of the graph before
};

constexpr std::uint32_t kPassing = Component::kPassing;

Minimal quotient_of(const LabelledGraph& graph) {
  Minimal made;
  Partition blocks = coarsest_partition(graph, Equivalence::Branching);
  made.graph = quotient(graph, blocks, Equivalence::Branching);
  made.state_of = std::move(blocks.block);
  return made;
}

// By state: those that a silent way ends in, through states that pass.
class Ends {
 public:
  Ends(const LabelledGraph& graph, std::uint32_t time, std::uint32_t initial)
      : graph_(graph), ends_(graph.size()), is_kept_(graph.size(), false) {
    is_kept_[initial] = true;
    for (std::uint32_t s = 0; s < graph.size(); ++s) {
      for (const auto& arc : graph.arcs(s)) {
        if (arc.label == time) is_kept_[arc.target] = true;
      }
    }
  }

  // What time leads to is one state: nothing is decided with a step of time.
  bool passes(std::uint32_t state) const {
    const auto arcs = graph_.arcs(state);
    return !is_kept_[state] && !arcs.empty() &&
           std::ranges::all_of(arcs, [&](const auto& arc) {
             return arc.label == LabelledGraph::kSilent && arc.target != state;
           });
  }
  const std::vector<std::uint32_t>& of(std::uint32_t state) {
    std::vector<std::uint32_t>& ends = ends_[state];
    if (!ends.empty()) return ends;
    if (!passes(state)) return ends = {state};
    // Beyond silent loops of one state there are none (partition.cpp).
    std::vector<std::uint32_t> found;
    for (const auto& arc : graph_.arcs(state)) {
      const auto& behind = of(arc.target);
      found.insert(found.end(), behind.begin(), behind.end());
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return ends_[state] = std::move(found);
  }

 private:
  const LabelledGraph& graph_;
  std::vector<std::vector<std::uint32_t>> ends_;
  std::vector<bool> is_kept_;
};

Minimal minimal(const LabelledGraph& graph, std::uint32_t time) {
  Minimal first = quotient_of(graph);
  Ends ends(first.graph, time, first.state_of[0]);
  std::vector<std::uint32_t> left(first.graph.size(), kPassing);
  std::uint32_t count = 0;
  for (std::uint32_t s = 0; s < first.graph.size(); ++s) {
    if (!ends.passes(s)) left[s] = count++;
  }
  LabelledGraph without;
  std::vector<LabelledGraph::Arc> arcs;
  for (std::uint32_t s = 0; s < first.graph.size(); ++s) {
    if (left[s] == kPassing) continue;
    arcs.clear();
    for (const auto& arc : first.graph.arcs(s)) {
      for (const std::uint32_t end : ends.of(arc.target)) {
        arcs.push_back({arc.label, left[end]});
      }
    }
    std::ranges::sort(arcs);
    arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
    without.add_state(arcs);
  }
  Minimal made = quotient_of(without);
  std::vector<std::uint32_t> state_of;
  for (const std::uint32_t block : first.state_of) {
    state_of.push_back(left[block] == kPassing ? kPassing
                                               : made.state_of[left[block]]);
  }
  made.state_of = std::move(state_of);
  return made;
}

// Numbers the states as a breadth-first search finds them that takes steps in
// the order of their labels' ranks: so graphs that differ in nothing else
// mostly become the same.
void put_in_order(Minimal& small, const std::vector<std::uint32_t>& rank) {
  const auto count = static_cast<std::uint32_t>(small.graph.size());
  std::vector<std::uint32_t> place(count, kPassing);
  std::vector<std::uint32_t> order;
  const auto add = [&](std::uint32_t state) {
    if (place[state] != kPassing) return;
    place[state] = static_cast<std::uint32_t>(order.size());
    order.push_back(state);
  };
  add(small.state_of[0]);
  LabelledGraph ordered;
  std::vector<LabelledGraph::Arc> arcs;
  for (std::uint32_t next = 0; next < count; ++next) {
    for (std::uint32_t s = 0; order.size() == next; ++s) add(s);
    const auto all = small.graph.arcs(order[next]);
    arcs.assign(all.begin(), all.end());
    std::ranges::stable_sort(arcs, {}, [&](const LabelledGraph::Arc& arc) {
      return std::pair(rank[arc.label], place[arc.target]);
    });
    for (LabelledGraph::Arc& arc : arcs) {
      add(arc.target);
      arc.target = place[arc.target];
    }
    ordered.add_state(arcs);
  }
  small.graph = std::move(ordered);
  for (std::uint32_t& state : small.state_of) {
    if (state != kPassing) state = place[state];
  }
}

}  // namespace

// By label: its place among all of the part, whatever it was found by.
std::vector<std::uint32_t> OpenPart::ranks() const {
  std::vector<std::uint32_t> ranks = {0, kQuiet, kTime, kRest};
  ranks.resize(kFirstLabel + labels_.size());
  std::uint32_t next = kFirstLabel;
  for (const auto& [content, label] : label_numbers_) ranks[label] = next++;
  return ranks;
}

std::optional<Component> OpenPart::drawn() {
  Component made;
  made.is_instant = is_instant_;
  made.memory_id = part_.memory();
  made.location_id = part_.location();
  Minimal small = minimal(graph(), kTime);
  put_in_order(small, ranks());
  const auto count = static_cast<std::uint32_t>(small.graph.size());
  std::vector<bool> is_rest(count, false);
  for (std::uint32_t s = 0; s < states_.size(); ++s) {
    if (small.state_of[s] == kPassing) continue;
    is_rest[small.state_of[s]] = is_at_rest(states_[s].values);
  }
  Automaton& automaton = made.automaton;
  automaton.kind = AutomatonKind::Node;
  automaton.location = made.location_id;
  if (is_called_) {
    automaton.gate = gate_;
    automaton.locations.push_back({"start_", LocationRole::Start, {}});
  }
  int memories = 0;
  for (std::uint32_t p = 0; p < count; ++p) {
    if (is_rest[p]) {
      made.places_.push_back({0, memories++});
      continue;
    }
    made.places_.push_back({static_cast<int>(automaton.locations.size()), 0});
    automaton.locations.push_back(
        {"place_" + std::to_string(p), LocationRole::Inner, {}});
  }
  const Component::Place begin = made.places_[small.state_of[0]];
  made.location = {VariableRole::Location,
                   "location",
                   0,
                   static_cast<int>(automaton.locations.size()) - 1,
                   begin.location,
                   {},
                   {}};
  made.memory = {VariableRole::Local, "memory", 0, std::max(0, memories - 1),
                 begin.memory,        {},       {}};
  const auto in_time = [&](const Component::Place& place) {
    return is_called_ ? place.memory : place.location;
  };
  made.later.resize(is_called_ ? static_cast<std::size_t>(memories) : count);
  for (std::size_t i = 0; i < made.later.size(); ++i) {
    made.later[i] = static_cast<int>(i);
  }
  for (std::uint32_t p = 0; p < count; ++p) {
    const Component::Place from = made.places_[p];
    for (const LabelledGraph::Arc& arc : small.graph.arcs(p)) {
      const Component::Place to = made.places_[arc.target];
      if (arc.label == kTime) {
        made.later[static_cast<std::size_t>(in_time(from))] = in_time(to);
      }
      if (arc.label < kFirstLabel && arc.label != LabelledGraph::kSilent) {
        continue;
      }
      if (automaton.edges.size() >= limits_.inner_edges) return std::nullopt;
      Edge edge;
      edge.source = LocationId{static_cast<std::uint32_t>(from.location)};
      edge.target = LocationId{static_cast<std::uint32_t>(to.location)};
      if (arc.label != LabelledGraph::kSilent) {
        const Label& label = labels_[arc.label - kFirstLabel];
        edge.when = label.when;
        edge.guard = label.guard;
        edge.updates = label.updates;
        edge.is_like_time = label.is_like_time;
      }
      if (is_rest[p]) {
        Expression here = differs(*gate_, 0);
        if (memories > 1) {
          here = both(std::move(here), equals(made.memory_id, from.memory));
        }
        edge.guard = both(std::move(here), std::move(edge.guard));
      }
      if (memories > 1 && (is_rest[p] || is_rest[arc.target])) {
        edge.updates.push_back(
            {made.memory_id, Expression::constant(to.memory)});
      }
      automaton.edges.push_back(std::move(edge));
      const bool is_loop =
          arc.label == LabelledGraph::kSilent && arc.target == p;
      made.drawn_.push_back({arc.label, p, arc.target, is_loop});
    }
  }
  // Else time writes it as well.
  const bool is_timeless = std::ranges::all_of(
      made.later, [m = 0](int to) mutable { return to == m++; });
  if (is_called_ && is_timeless) automaton.locals = {made.memory_id};
  made.tell_content();
  made.own_ = part_.own();
  made.place_of_ = std::move(small.state_of);
  made.first_.push_back(0);
  for (const State& state : states_) {
    for (const Arc& arc : state.arcs) {
      if (!arc.is_used) continue;
      made.arcs_.push_back({arc.label, arc.target, arc.member});
    }
    made.first_.push_back(static_cast<std::uint32_t>(made.arcs_.size()));
  }
  made.states_ = std::move(numbers_);
  return made;
}

std::optional<Component> OpenPart::take() && {
  if (!own(automaton_.location) || !explore()) return std::nullopt;
  return drawn();
}

}  // namespace btcheck
