// SPDX-License-Identifier: MIT
//
// What an engine looks up while it steps, made beforehand so that a step
// allocates nothing: what each edge means, and what leaves are given.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/leaves.hpp"

namespace btcheck {

// An edge, by its place among the compiled ones.
struct EdgeFacts {
  AutomatonId owner{};
  std::uint32_t number = 0;  // in the whole network
  Interval when;
  LocationRole source = LocationRole::Inner;
  LocationRole target = LocationRole::Inner;
  bool is_root = false;    // of a root
  bool is_answer = false;  // of a leaf that the world decides
  // Then what it answers, or kFaultResult; of a state variable's own edge what
  // the variable becomes.
  int result = 0;
};

// An Action, a Condition or a SetSV.
struct LeafFacts {
  Condition requirement;
  std::vector<Program> arguments;    // of those that are known, in order
  std::vector<GivenArgument> given;  // all, with their values of now
  std::optional<AutomatonId> timer;  // of an action with a :duration
};

// Network and tree must outlive it.
class LeafTable {
 public:
  LeafTable(const BehaviorTree& tree, const CompiledNetwork& system);

  const EdgeFacts& edge(std::uint32_t place) const { return edges_[place]; }
  bool has_leaf(NodeId node) const { return leaves_[index(node)].has_value(); }
  const LeafFacts& leaf(NodeId node) const { return *leaves_[index(node)]; }

  // Whether the leaf may do what it is for; where not, it only can fail.
  bool meets_requirement(NodeId node, StateView state) const {
    return conditions_.holds(leaf(node).requirement, state.data());
  }
  // Evaluates the arguments of a leaf that is about to be ticked.
  void give_arguments(NodeId node, StateView state);

  std::span<const AutomatonId> timers() const { return timers_; }
  // By location of a root: no edge leads on. One may stay there, by which the
  // answers of the last tick are forgotten.
  bool is_over(AutomatonId root, LocationId location) const;

 private:
  EdgeFacts facts_of(std::uint32_t place) const;
  LeafFacts facts_of(NodeId node);

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  ConditionPool conditions_;
  std::vector<EdgeFacts> edges_;
  std::vector<std::optional<LeafFacts>> leaves_;  // by NodeId
  std::vector<AutomatonId> timers_;
};

}  // namespace btcheck
