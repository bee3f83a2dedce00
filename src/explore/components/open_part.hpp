// SPDX-License-Identifier: MIT
//
// All that a part of a network can do, whatever the rest of it is.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "explore/components/component.hpp"
#include "explore/components/cut_part.hpp"

namespace btcheck {

// Explores a part whose members are components already but for one, and draws
// its own.
class OpenPart {
 public:
  // The part must outlive this.
  OpenPart(const CutPart& part, const ComponentTable::Limits& limits);

  // Nothing where it cannot be told, or grows beyond the limits.
  std::optional<Component> take() &&;

 private:
  using Values = Component::Values;

  // What somebody outside of the part notices of a step: when it is due, under
  // which condition it is taken, and what it assigns, in terms of variables
  // that are not the part's own.
  struct Label {
    Interval when;
    bool is_like_time = false;
    Expression guard;
    std::vector<Assignment> updates;
  };
  struct Arc {
    std::uint32_t label = 0;
    std::uint32_t target = 0;
    Component::Member member;
    bool is_used = false;  // whatever the rest does
  };
  struct State {
    Values values;  // of the part's own variables
    std::vector<Arc> arcs;
    bool is_expanded = false;
    std::optional<std::uint32_t> later;  // where time passes
  };
  // What lies between the two parts: the status of the subtree's root, and
  // whether it has been called.
  struct Call {
    int status = 0;
    bool is_called = false;
  };

  static constexpr std::uint32_t kQuiet = 1;  // it does nothing by itself
  static constexpr std::uint32_t kTime = 2;   // a unit of time passes
  static constexpr std::uint32_t kRest = 3;   // it waits to be called
  static constexpr std::uint32_t kFirstLabel = 4;
  static constexpr std::uint64_t kMostRead = 64;

  // A large component has thousands of edges, of which few begin in one place.
  static std::vector<std::vector<std::uint32_t>> edges_by_place(
      const CutPart::Moving& member);
  static std::size_t place_number(const Component* shape,
                                  const Component::Place& place);
  const Variable& range_of(VariableId id) const {
    return part_.variables()[index(id)];
  }
  bool is_timed() const { return part_.ticks() != TickSemantics::None; }
  std::optional<std::size_t> own(VariableId variable) const;
  std::optional<std::uint32_t> state_number(Values values);
  std::uint32_t label_number(Label label);
  bool expand(std::uint32_t state);
  bool expand(std::uint32_t state, Component::Member which);
  bool add_arc(std::uint32_t state, Component::Member which,
               const Interval& when,
               const std::vector<std::pair<VariableId, int>>& read);
  // The values after a unit of time in which the part does nothing.
  std::optional<Values> later(Values values) const;
  // A subtree that nobody has called.
  bool is_at_rest(const Values& values) const;
  // Calls found(call) for what the rest may make of one.
  template <class Found>
  void for_each_change(const Call& call, const Values& values,
                       Found found) const;
  bool explore();
  LabelledGraph graph() const;
  std::vector<std::uint32_t> ranks() const;
  std::optional<Component> drawn();

  const CutPart& part_;
  const ComponentTable::Limits limits_;
  const std::vector<CutPart::Moving> members_;
  const std::vector<CutPart::Moving> timers_;
  const Automaton& automaton_;  // of the member that is no component
  const bool is_called_;        // by a node that stands outside
  const VariableId status_;
  const std::optional<VariableId> gate_;
  std::vector<int> place_of_;  // by number: in part_.own(), or -1
  // By member and its place: its edges from there.
  std::vector<std::vector<std::vector<std::uint32_t>>> edges_;
  std::vector<State> states_;
  Component::Numbers numbers_;
  std::vector<Label> labels_;  // from kFirstLabel on
  std::map<std::vector<std::int32_t>, std::uint32_t> label_numbers_;
  bool is_instant_ = true;
};

}  // namespace btcheck
