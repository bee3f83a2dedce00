// SPDX-License-Identifier: MIT
//
// What each group waits for, taken apart into guards, and how groups and guards
// work on each other: what a partial-order reduction by stubborn sets asks for
// (Laarman, Pater, van de Pol and Hansen, "Guard-based partial-order
// reduction", STTT 2016). Whatever is not known counts as possible.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "explore/partition/groups.hpp"
#include "explore/state/condition.hpp"

namespace btcheck {

class Guards {
 public:
  // All must outlive it.
  Guards(const CompiledNetwork& system, const Slots& slots,
         const Groups& groups);

  std::size_t size() const { return guards_.size(); }
  // A group has a step where all of these hold, and nowhere else. Time has one
  // where that changes the state.
  std::span<const std::uint32_t> of(std::uint32_t group) const {
    return of_[group];
  }
  const SlotSet& reads(std::uint32_t guard) const {
    return guards_[guard].reads;
  }
  bool holds(std::uint32_t guard, StateView state) const;

  // Whether a step of the group may make the guard true, or false.
  bool may_enable(std::uint32_t guard, std::uint32_t group) const {
    return may_make(guard, group, true);
  }
  bool may_disable(std::uint32_t guard, std::uint32_t group) const {
    return may_make(guard, group, false);
  }
  // Whether both may hold in one state.
  bool may_coincide(std::uint32_t one, std::uint32_t other) const;
  // Whether two groups that both have a step may be taken in either order, to
  // the same end.
  bool accord(std::uint32_t one, std::uint32_t other) const;

 private:
  // variable = value, or variable /= value.
  struct Demand {
    VariableId variable{};
    int value = 0;
    bool is_equal = true;
  };
  enum class Kind : std::uint8_t {
    Condition,  // of variables
    Clock,      // the clock has come to a number
    Calm,       // no fault, and no timer is due
    Group       // all that the group asks for at once
  };
  struct Guard {
    Kind kind = Kind::Condition;
    Condition condition;
    std::optional<Demand> demand;  // all that the condition says
    AutomatonId clock{};
    int least = 0;
    std::uint32_t group = 0;
    SlotSet reads;
  };

  std::uint32_t condition(const Expression& expression);
  std::uint32_t clock(AutomatonId automaton, int least);
  std::uint32_t calm();
  std::uint32_t whole(std::uint32_t group);
  void take_apart(std::uint32_t group);
  void note_writes(std::uint32_t group);

  bool may_make(std::uint32_t guard, std::uint32_t group, bool truth) const;
  bool are_never_together(std::uint32_t one, std::uint32_t other) const;
  bool is_urgent(std::uint32_t group) const;
  bool moves(std::uint32_t group, StateView state) const;

  const CompiledNetwork& system_;
  const Slots& slots_;
  const Groups& groups_;
  ConditionPool conditions_;
  std::vector<Guard> guards_;
  std::vector<std::pair<Expression, std::uint32_t>> known_;  // conditions
  std::map<std::pair<AutomatonId, int>, std::uint32_t> clocks_;
  std::optional<std::uint32_t> calm_;
  std::vector<std::vector<std::uint32_t>> of_;  // by group
  // By group: what a variable is in the end, where that is a constant.
  std::vector<std::map<VariableId, std::optional<int>>> assigned_;
};

}  // namespace btcheck
