// SPDX-License-Identifier: MIT
//
// Each clause of CompiledNetwork::successors is a slot that is read: a fault
// ends everything, a timer that is due goes first, a gate must be open, an
// automaton stand at the source, the guard hold, the clock be within the
// interval. Time passes where no edge that could be taken is urgent, so it
// reads what says so of any of them.
#include "explore/partition/groups.hpp"

#include <algorithm>

#include "explore/state/accesses.hpp"

namespace btcheck {

Groups::Groups(const CompiledNetwork& system, const Slots& slots)
    : system_(system), of_(slots), preempting_(preempting_slots()) {
  const Network& network = system.network();
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    for (const Edge& edge : automaton.edges) {
      edges_.push_back({AutomatonId{a}, &edge, 0,
                        automaton.kind == AutomatonKind::Timer &&
                            system.layout().clocks[a].has_value()});
    }
  }
  for (std::uint32_t place = 0; place < edges_.size(); ++place) {
    edges_[system.edge_number(place)].place = place;
  }
  for (const GroupEdge& edge : edges_) slots_.push_back(slots_of(edge));
  slots_.push_back(slots_of_time());
}

void Groups::add_variable(VariableId variable, SlotSet& to) const {
  of_.add(system_.layout().fields[index(variable)], to);
}

void Groups::add_clock(AutomatonId automaton, SlotSet& to) const {
  const auto& clock = system_.layout().clocks[index(automaton)];
  if (clock) of_.add(*clock, to);
}

void Groups::add_read(const Expression& expression, SlotSet& to) const {
  for_each_read(expression, [&](VariableId variable, std::optional<int>) {
    add_variable(variable, to);
  });
}

SlotSet Groups::preempting_slots() const {
  const Network& network = system_.network();
  SlotSet slots = of_.none();
  if (network.fault) add_variable(*network.fault, slots);
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const bool is_clocked = system_.layout().clocks[a].has_value();
    if (network.automata[a].kind != AutomatonKind::Timer || !is_clocked) {
      continue;
    }
    add_variable(network.automata[a].location, slots);
    add_clock(AutomatonId{a}, slots);
  }
  return slots;
}

GroupSlots Groups::slots_of(const GroupEdge& of) const {
  const Network& network = system_.network();
  const Automaton& automaton = network.automaton(of.automaton);
  GroupSlots slots{preempting_, {}, of_.none(), {}};
  if (automaton.gate) add_variable(*automaton.gate, slots.enabling);
  add_variable(automaton.location, slots.enabling);
  add_read(of.edge->guard, slots.enabling);
  if (of.edge->when.lower > 0) add_clock(of.automaton, slots.enabling);
  slots.reads = slots.enabling;
  const auto write = [&](VariableId variable) {
    add_variable(variable, slots.may_write);
    const auto moved = automaton_at(network, variable);
    if (moved) add_clock(*moved, slots.may_write);
  };
  write(automaton.location);
  for (const Assignment& update : of.edge->updates) {
    add_read(update.value, slots.reads);
    write(update.variable);
  }
  slots.must_write = slots.may_write;
  return slots;
}

GroupSlots Groups::slots_of_time() const {
  const Network& network = system_.network();
  GroupSlots slots{of_.none(), {}, of_.none(), of_.none()};
  for (std::uint32_t edge = 0; edge < edges_.size(); ++edge) {
    slots.enabling |= slots_[edge].enabling;
    add_clock(edges_[edge].automaton, slots.enabling);
  }
  slots.reads = slots.enabling;
  if (network.ticks == TickSemantics::None) return slots;
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (!system_.layout().clocks[a]) continue;
    add_variable(network.automata[a].location, slots.reads);
    add_clock(AutomatonId{a}, slots.reads);
    add_clock(AutomatonId{a}, slots.may_write);
  }
  return slots;
}

bool Groups::step(std::uint32_t group, StateView state,
                  std::span<Word> next) const {
  if (group != time()) {
    const GroupEdge& edge = edges_[group];
    if (system_.location(state, edge.automaton) != edge.edge->source ||
        !may_be_taken(edge, state)) {
      return false;
    }
    std::ranges::copy(state, next.begin());
    system_.fire(edge.place, next);
    return true;
  }
  bool passes = false;
  system_.successors(state, [&](StateView target, const Step& step) {
    if (step.edge != kTimeStep) return;
    passes = true;
    std::ranges::copy(target, next.begin());
  });
  return passes;
}

// Of an edge whose source is the present location.
bool Groups::may_be_taken(const GroupEdge& of, StateView state) const {
  if (system_.is_preempted(state)) return is_due(of, state);
  if (!system_.is_open(state, of.automaton) ||
      system_.clock(state, of.automaton) < of.edge->when.lower) {
    return false;
  }
  bool is_open = false;
  system_.open_edges(state, of.automaton, [&](std::uint32_t place) {
    is_open |= place == of.place;
  });
  return is_open;
}

bool Groups::is_due(const GroupEdge& of, StateView state) const {
  const auto& fault = system_.network().fault;
  return of.is_timer && !(fault && system_.value(state, *fault) != 0) &&
         system_.clock(state, of.automaton) == of.edge->when.upper;
}

}  // namespace btcheck
