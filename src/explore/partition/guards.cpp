// SPDX-License-Identifier: MIT
#include "explore/partition/guards.hpp"

#include <algorithm>

#include "explore/state/accesses.hpp"

namespace btcheck {
namespace {

int value_at(const Network& network, const Automaton& automaton,
             LocationId location) {
  return network.variable(automaton.location).min +
         static_cast<int>(index(location));
}

}  // namespace

Guards::Guards(const CompiledNetwork& system, const Slots& slots,
               const Groups& groups)
    : system_(system),
      slots_(slots),
      groups_(groups),
      conditions_(system.network(), system.layout()),
      of_(groups.size()),
      assigned_(groups.size()) {
  for (std::uint32_t group = 0; group < groups.time(); ++group) {
    take_apart(group);
    note_writes(group);
  }
  of_[groups.time()] = {whole(groups.time())};
}

std::uint32_t Guards::condition(const Expression& expression) {
  const auto found = std::ranges::find(
      known_, expression, [](const auto& k) -> const auto& { return k.first; });
  if (found != known_.end()) return found->second;
  Guard guard;
  guard.condition = conditions_.compile(expression);
  guard.reads = slots_.none();
  const auto terms = expression.terms();
  for_each_read(expression, [&](VariableId variable, std::optional<int> value) {
    slots_.add(system_.layout().fields[index(variable)], guard.reads);
    if (terms.size() != 3 || !value) return;
    guard.demand = {variable, *value, terms[2].operation == Operation::Equal};
  });
  const auto number = static_cast<std::uint32_t>(guards_.size());
  guards_.push_back(std::move(guard));
  known_.emplace_back(expression, number);
  return number;
}

std::uint32_t Guards::clock(AutomatonId automaton, int least) {
  const auto [known, is_new] = clocks_.try_emplace(
      {automaton, least}, static_cast<std::uint32_t>(guards_.size()));
  if (!is_new) return known->second;
  Guard guard;
  guard.kind = Kind::Clock;
  guard.clock = automaton;
  guard.least = least;
  guard.reads = slots_.none();
  slots_.add(*system_.layout().clocks[index(automaton)], guard.reads);
  guards_.push_back(std::move(guard));
  return known->second;
}

std::uint32_t Guards::calm() {
  if (calm_) return *calm_;
  calm_ = static_cast<std::uint32_t>(guards_.size());
  Guard guard;
  guard.kind = Kind::Calm;
  guard.reads = groups_.preempting();
  guards_.push_back(std::move(guard));
  return *calm_;
}

std::uint32_t Guards::whole(std::uint32_t group) {
  Guard guard;
  guard.kind = Kind::Group;
  guard.group = group;
  guard.reads = groups_.slots(group).enabling;
  guards_.push_back(std::move(guard));
  return static_cast<std::uint32_t>(guards_.size() - 1);
}

// A timer goes before others when it is due, and then asks for nothing else.
void Guards::take_apart(std::uint32_t group) {
  const Groups::GroupEdge& of = groups_.edge(group);
  if (of.is_timer) {
    of_[group] = {whole(group)};
    return;
  }
  const Automaton& automaton = system_.network().automaton(of.automaton);
  std::vector<std::uint32_t> guards;
  if (groups_.preempting().any()) guards.push_back(calm());
  if (automaton.gate) guards.push_back(condition(differs(*automaton.gate, 0)));
  guards.push_back(condition(
      equals(automaton.location,
             value_at(system_.network(), automaton, of.edge->source))));
  for (const Expression& conjunct : of.edge->guard.conjuncts()) {
    guards.push_back(condition(conjunct));
  }
  if (of.edge->when.lower > 0) {
    guards.push_back(clock(of.automaton, of.edge->when.lower));
  }
  of_[group] = std::move(guards);
}

void Guards::note_writes(std::uint32_t group) {
  const Groups::GroupEdge& of = groups_.edge(group);
  const Automaton& automaton = system_.network().automaton(of.automaton);
  for (const Assignment& update : of.edge->updates) {
    assigned_[group][update.variable] = constant_value(update);
  }
  assigned_[group][automaton.location] =
      value_at(system_.network(), automaton, of.edge->target);
}

bool Guards::holds(std::uint32_t guard, StateView state) const {
  const Guard& of = guards_[guard];
  switch (of.kind) {
    case Kind::Condition:
      return conditions_.holds(of.condition, state.data());
    case Kind::Clock:
      return system_.clock(state, of.clock) >= of.least;
    case Kind::Calm:
      return !system_.is_preempted(state);
    case Kind::Group:
      return moves(of.group, state);
  }
  return false;
}

bool Guards::moves(std::uint32_t group, StateView state) const {
  StateVector next(state.size());
  return groups_.step(group, state, next) &&
         (group != groups_.time() || !std::ranges::equal(next, state));
}

bool Guards::may_make(std::uint32_t guard, std::uint32_t group,
                      bool truth) const {
  const Guard& of = guards_[guard];
  if (!groups_.slots(group).may_write.intersects(of.reads)) return false;
  // A clock goes on with time, and is set to 0 by all others.
  if (of.kind == Kind::Clock) return (group == groups_.time()) == truth;
  if (!of.demand || group == groups_.time()) return !of.demand;
  const auto found = assigned_[group].find(of.demand->variable);
  if (found == assigned_[group].end()) return false;
  if (!found->second) return true;
  const bool is_met =
      (*found->second == of.demand->value) == of.demand->is_equal;
  return is_met == truth;
}

bool Guards::may_coincide(std::uint32_t one, std::uint32_t other) const {
  const auto& first = guards_[one].demand;
  const auto& second = guards_[other].demand;
  if (!first || !second || first->variable != second->variable) return true;
  if (first->is_equal && second->is_equal) {
    return first->value == second->value;
  }
  return first->is_equal == second->is_equal || first->value != second->value;
}

// Both at their deadline at once and able to be taken: then no time passes.
bool Guards::is_urgent(std::uint32_t group) const {
  if (group == groups_.time()) return false;
  const Groups::GroupEdge& of = groups_.edge(group);
  if (of.edge->when.upper != 0) return false;
  const Automaton& automaton = system_.network().automaton(of.automaton);
  return std::ranges::all_of(automaton.edges, [&](const Edge& edge) {
    return edge.source != of.edge->source || edge.when.greatest_clock() == 0;
  });
}

bool Guards::are_never_together(std::uint32_t one, std::uint32_t other) const {
  const auto time = groups_.time();
  if ((one == time && is_urgent(other)) || (other == time && is_urgent(one))) {
    return true;
  }
  return std::ranges::any_of(of_[one], [&](std::uint32_t first) {
    return std::ranges::any_of(of_[other], [&](std::uint32_t second) {
      return !may_coincide(first, second);
    });
  });
}

bool Guards::accord(std::uint32_t one, std::uint32_t other) const {
  if (are_never_together(one, other)) return true;
  const GroupSlots& first = groups_.slots(one);
  const GroupSlots& second = groups_.slots(other);
  return !first.may_write.intersects(second.may_write) &&
         !first.may_write.intersects(second.reads) &&
         !second.may_write.intersects(first.reads);
}

}  // namespace btcheck
