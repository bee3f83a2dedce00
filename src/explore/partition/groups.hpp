// SPDX-License-Identifier: MIT
//
// The steps of a network by group: one for each edge, and one for time. What
// a group reads and writes is said beforehand, so that an engine knows which
// steps cannot disturb each other, and which parts of a state they leave alone
// (Blom, van de Pol and Weber, "LTSmin: distributed and symbolic
// reachability", CAV 2010).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "explore/partition/slots.hpp"

namespace btcheck {

// What one group has to do with slots. Whether its step can be taken, and what
// it writes then, depends on `reads` alone; a slot that is not in `may_write`
// keeps its value, one in `must_write` gets another or the same.
struct GroupSlots {
  SlotSet enabling;  // of `reads`, those that say whether it can be taken
  SlotSet reads;
  SlotSet may_write;
  SlotSet must_write;
};

class Groups {
 public:
  // Both must outlive it.
  Groups(const CompiledNetwork& system, const Slots& slots);

  std::uint32_t size() const { return time() + 1; }
  // The group of steps in which time passes, the last one.
  std::uint32_t time() const {
    return static_cast<std::uint32_t>(edges_.size());
  }
  std::uint32_t of(const Step& step) const {
    return step.edge == kTimeStep ? time() : step.edge;
  }
  const GroupSlots& slots(std::uint32_t group) const { return slots_[group]; }
  // What says whether a timer goes before everything else, or nothing goes on.
  const SlotSet& preempting() const { return preempting_; }

  // Whether the group has a step there; `next` gets the state it leads to. In
  // the group of time that may be an idle step.
  bool step(std::uint32_t group, StateView state, std::span<Word> next) const;

  struct GroupEdge {
    AutomatonId automaton{};
    const Edge* edge = nullptr;
    std::uint32_t place = 0;  // among the compiled ones
    bool is_timer = false;
  };
  const GroupEdge& edge(std::uint32_t group) const { return edges_[group]; }

 private:
  void add_variable(VariableId variable, SlotSet& to) const;
  void add_clock(AutomatonId automaton, SlotSet& to) const;
  void add_read(const Expression& expression, SlotSet& to) const;
  SlotSet preempting_slots() const;
  GroupSlots slots_of(const GroupEdge& edge) const;
  GroupSlots slots_of_time() const;
  bool may_be_taken(const GroupEdge& edge, StateView state) const;
  bool is_due(const GroupEdge& edge, StateView state) const;

  const CompiledNetwork& system_;
  const Slots& of_;
  std::vector<GroupEdge> edges_;  // by number
  SlotSet preempting_;
  std::vector<GroupSlots> slots_;  // by group
};

}  // namespace btcheck
