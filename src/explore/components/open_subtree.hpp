// SPDX-License-Identifier: MIT
//
// All that a subtree can do, whoever calls it.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "explore/components/component.hpp"

namespace btcheck {

// Explores a subtree whose children are components already, and draws its own.
class OpenSubtree {
 public:
  OpenSubtree(Components& all, AutomatonId root);

  // Nothing where it cannot be told, or grows beyond the limits.
  std::optional<Component> take() &&;

 private:
  // What somebody outside notices of a step: when it is due, under which
  // condition it is taken, and what it assigns, in terms of variables that are
  // not the subtree's own.
  struct Label {
    Interval when;
    std::uint8_t mark = 0;
    Expression guard;
    std::vector<Assignment> updates;
  };
  struct Arc {
    std::uint32_t label = 0;
    std::uint32_t target = 0;
    Component::Member member;
    bool is_used = false;  // by some caller
  };
  struct State {
    Values values;  // of the subtree's own variables
    std::vector<Arc> arcs;
    bool is_expanded = false;
  };
  // A change that others make to the root's status while it is not called.
  struct Change {
    std::optional<int> from;  // absent: whatever it is
    int to = 0;
  };

  static constexpr std::uint32_t kQuiet = 1;  // it has nothing to do by itself
  static constexpr std::uint32_t kAtRest = 2;  // nobody has called it
  static constexpr std::uint32_t kFirstLabel = 3;
  static constexpr std::uint64_t kMostRead = 64;

  const Network& network() const { return all_.network_; }
  const Automaton& member(std::uint32_t number) const;
  std::optional<std::size_t> own(VariableId variable) const;
  void collect_own();
  void collect_changes();
  std::optional<std::uint32_t> state_number(Values values);
  std::uint32_t label_number(Label label);
  bool expand(std::uint32_t state);
  bool expand(std::uint32_t state, std::uint32_t number, std::uint32_t edge);
  bool add_arc(std::uint32_t state, Component::Member member, const Edge& edge,
               std::uint8_t mark,
               const std::vector<std::pair<VariableId, int>>& read);
  bool explore();
  LabelledGraph graph() const;
  std::optional<Component> drawn();

  Components& all_;
  const AutomatonId root_;
  const Automaton& automaton_;
  const VariableId status_;
  const std::vector<AutomatonId>& children_;
  std::vector<VariableId> own_;
  std::vector<int> place_of_;   // by VariableId: in own_, or -1
  std::vector<Variable> ranges_;  // of own_
  std::vector<Change> changes_;
  std::vector<State> states_;
  std::unordered_map<Values, std::uint32_t, Component::HashOfValues> numbers_;
  std::vector<Label> labels_;  // from kFirstLabel on
  std::map<std::vector<std::int32_t>, std::uint32_t> label_numbers_;
};

}  // namespace btcheck
