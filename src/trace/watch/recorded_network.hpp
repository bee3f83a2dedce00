// SPDX-License-Identifier: MIT
//
// The tree of a run that stands for itself, as far as rules can speak of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "check/bind/verdict.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/watch/entry_regions.hpp"

namespace btcheck {

// The nodes and variables of a recorded run as a tree and a network without
// edges: rules are bound to it as to any other, and its states are read, never
// computed. An automaton has the locations of every node's frame; the others
// of the run are one, `elsewhere`.
class RecordedNetwork {
 public:
  // Of the states only the values are looked at. A value that a rule names and
  // the run never has is one of the variable's all the same.
  RecordedNetwork(const RecordedRun& run, const PropertyFile& rules);

  const BehaviorTree& tree() const { return tree_; }
  const Network& network() const { return network_; }
  // So that `remember_for` can add its variables.
  Network& network() { return network_; }

  // What the network's own variables are in a recorded state; those that rules
  // have it remember, and those of other nodes, stay as they are.
  void read(const RecordedState& state, std::span<const std::size_t> nodes,
            Valuation& valuation) const;

  VariableId location(std::size_t node) const;
  static int location_number(std::string_view name);

 private:
  void add_node(const RecordedNode& node, std::uint32_t number);
  void add_automaton(std::uint32_t number);
  static StateVariable variable_of(const RecordedRun& run, std::size_t number,
                                   const PropertyFile& rules);
  void add_variable(StateVariable variable);
  VariableId add(VariableRole role, std::string name,
                 std::vector<std::string> values,
                 std::optional<AutomatonId> owner);
  int value_of(std::size_t variable, const std::string& word) const;

  BehaviorTree tree_;
  Network network_;
  EntryRegions regions_;
  bool has_entries_ = false;
};

}  // namespace btcheck
