// SPDX-License-Identifier: MIT
//
// A part of a network by itself: what is equal here becomes equal components.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "explore/components/component.hpp"

namespace btcheck {

// The part with its variables numbered as they are first spoken of. Behind them
// stand its clocks, as if they were variables.
class CutPart {
 public:
  // An automaton or a component, in such numbers.
  struct Moving {
    Automaton automaton;
    const Component* shape = nullptr;
    PartSide side = PartSide::Inside;
    VariableId memory{};                   // of a component
    std::optional<VariableId> clock = {};  // of an automaton
  };

  // The members are components already but for the first. All must outlive
  // this.
  CutPart(const ComponentTable& all, AutomatonId root, PartSide side,
          const std::vector<PartMember>& members);

  // Of all that counts: another part with this hash is made alike.
  ContentHash hash() const { return hash_of(content_); }
  // The variable of each number; of a clock the one that stands for it.
  const std::vector<VariableId>& names() const { return names_; }

  TickSemantics ticks() const { return network_.ticks; }
  PartSide side() const { return side_; }
  bool is_called() const { return is_called_; }
  // No time passes in the subtree while the part, outside of it, waits for it.
  bool waits_instantly() const { return waits_instantly_; }
  VariableId status() const { return status_; }
  const std::optional<VariableId>& gate() const { return gate_; }
  // Where the component stands, and what it remembers.
  VariableId location() const { return location_; }
  VariableId memory() const { return memory_; }
  // What the rest may make of the status of the subtree's root.
  const std::set<std::pair<int, int>>& changes() const { return changes_; }
  // Whether that is a status with which the subtree is ever called.
  bool may_enter(int status) const {
    return entry_ == nullptr || entry_->has(status);
  }
  // By number; with the ranges that components have.
  const std::vector<Variable>& variables() const { return variables_; }
  // The part's own, in the order in which its states have them.
  const std::vector<VariableId>& own() const { return own_; }
  // It stands in no network, but for a component.
  bool is_behind(VariableId number) const {
    return index(names_[index(number)]) >= network_.variables.size();
  }
  std::vector<Moving> members() const;
  std::vector<Moving> timers() const;

 private:
  template <class Value>
  void put(Value value) {
    content_.push_back(static_cast<std::int32_t>(value));
  }
  void put_automaton(AutomatonId id);
  void put_component(const PartMember& member);
  void collect_changes();
  void collect_own();
  void add_clock(AutomatonId id);
  VariableId number(VariableId name);
  VariableId known_number(VariableId name) const {
    return numbers_.at(index(name));
  }
  Moving numbered(AutomatonId id) const;

  const ComponentTable& all_;
  const Network& network_;
  const AutomatonId root_;
  const PartSide side_;
  const std::vector<PartMember>& members_;
  const std::vector<AutomatonId>& timers_;
  const bool is_called_;
  bool waits_instantly_ = false;
  std::vector<std::int32_t> content_;
  std::vector<VariableId> names_;
  std::unordered_map<std::uint32_t, VariableId> numbers_;  // by name
  VariableId status_{};
  std::optional<VariableId> gate_;
  VariableId location_{};
  VariableId memory_{};
  std::set<std::pair<int, int>> changes_;
  const CalledWith* entry_ = nullptr;  // where it is known
  std::vector<Variable> variables_;
  std::vector<VariableId> own_;
};

// An automaton, as far as components look at one, with the variables that it
// speaks of called something else. It may have locals that it does not.
template <class Name>
Automaton with_names(const Automaton& automaton, Name&& name) {
  const auto renamed = [&](const Expression& expression) {
    if (expression.is_true()) return Expression();
    return expression.replaced([&](const Term& term) {
      return read(name(VariableId{static_cast<std::uint32_t>(term.operand)}));
    });
  };
  Automaton made;
  made.kind = automaton.kind;
  made.name = automaton.name;
  made.node = automaton.node;
  made.location = name(automaton.location);
  if (automaton.gate) made.gate = name(*automaton.gate);
  made.locations = automaton.locations;
  made.edges.reserve(automaton.edges.size());
  for (const Edge& edge : automaton.edges) {
    Edge& each = made.edges.emplace_back();
    each.source = edge.source;
    each.target = edge.target;
    each.guard = renamed(edge.guard);
    for (const Assignment& update : edge.updates) {
      each.updates.push_back({name(update.variable), renamed(update.value)});
    }
    each.when = edge.when;
    each.is_like_time = edge.is_like_time;
  }
  return made;
}

// What an automaton does, as a row of numbers: equal ones do the same.
template <class Number>
void append(const Automaton& automaton, Number&& number,
            std::vector<std::int32_t>& to) {
  const auto put = [&](auto value) {
    to.push_back(static_cast<std::int32_t>(value));
  };
  const auto put_expression = [&](const Expression& expression) {
    put(expression.terms().size());
    for (const Term& term : expression.terms()) {
      put(term.operation);
      put(term.operation == Operation::Variable
              ? static_cast<std::int32_t>(index(number(
                    VariableId{static_cast<std::uint32_t>(term.operand)})))
              : term.operand);
    }
  };
  put(index(number(automaton.location)));
  put(automaton.gate ? static_cast<std::int64_t>(index(number(*automaton.gate)))
                     : -1);
  put(automaton.locations.size());
  put(automaton.edges.size());
  for (const Edge& edge : automaton.edges) {
    put(index(edge.source));
    put(index(edge.target));
    put(edge.when.lower);
    put(edge.when.upper);
    put(edge.is_like_time);
    put_expression(edge.guard);
    put(edge.updates.size());
    for (const Assignment& update : edge.updates) {
      put(index(number(update.variable)));
      put_expression(update.value);
    }
  }
}

}  // namespace btcheck
