// SPDX-License-Identifier: MIT
//
// What of a network is the same as in that of an earlier tree, as it was before
// an edit.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "check/questions/defaults.hpp"
#include "explore/state/transition_system.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// A report of a tree as it was before an edit, or of this one as far as it was
// searched. All must outlive this.
struct EarlierReport {
  const BehaviorTree& tree;
  const Network& network;
  const DefaultReport& report;
};

// Which node of a tree was which of an earlier one, by NodeId there: alike are
// those before the first that differs and those behind the last; what lies
// between is where there are as many.
std::vector<std::optional<NodeId>> nodes_since(const BehaviorTree& earlier,
                                               const BehaviorTree& tree);

class Counterparts {
 public:
  Counterparts(const EarlierReport& earlier, const BehaviorTree& tree,
               const Network& network);

  const std::optional<NodeId>& node(NodeId earlier) const {
    return nodes_[index(earlier)];
  }
  // The same step here, whether it can be taken or not.
  std::optional<Step> step(Step earlier) const;
  // A run of the earlier network all of whose steps are kept is one of this
  // network: all that moves does what it did, on the same values, and whoever
  // does something else here is called on none of them, but for leaves.
  std::optional<Step> kept(Step earlier) const;
  // Nothing differs: also what has not been taken on a run goes on as it did.
  bool keeps_all() const { return keeps_all_; }
  // Of a step of a leaf that does something else here: the leaf.
  std::optional<AutomatonId> leaf_of(Step earlier) const;
  bool ends_turn(Step earlier) const;
  // A turn of such a leaf, by its edges from its call to its answer, as edges
  // here that do to all others what it did, and leave it at its start; nothing
  // where it has no such turn here, or may have no such turn in some state.
  using Edges = std::vector<std::uint32_t>;
  std::optional<Edges> turn(AutomatonId leaf, const Edges& earlier) const;

 private:
  void map_automata();
  void map_state_variables();
  void map_variables();
  void map(VariableId earlier, VariableId here) {
    variables_[index(earlier)] = here;
  }
  void map(AutomatonId earlier, AutomatonId here) {
    automata_[index(earlier)] = here;
  }
  // A variable as it is called here; none of this network where it is none.
  VariableId name_here(VariableId earlier) const {
    return variables_[index(earlier)].value_or(VariableId{0xffffffff});
  }
  bool is_same(const Automaton& earlier, const Automaton& here) const;
  bool has_simple_turns(AutomatonId earlier) const;
  void compare();
  bool can_keep(const std::vector<bool>& differs) const;

  const Network& earlier_;
  const Network& network_;
  std::vector<std::optional<NodeId>> nodes_;
  std::vector<std::optional<AutomatonId>> automata_;  // by AutomatonId before
  std::vector<std::optional<VariableId>> variables_;  // by VariableId before
  bool keeps_time_ = false;
  bool keeps_all_ = false;
  std::vector<bool> is_kept_;  // by number of an edge before
  std::vector<bool> is_leaf_;  // by AutomatonId before: with such turns
};

}  // namespace btcheck
