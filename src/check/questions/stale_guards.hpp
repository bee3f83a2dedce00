// SPDX-License-Identifier: MIT
//
// Guards that are not ticked again while the action they stand before runs.
#pragma once

#include <optional>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/questions/found_step.hpp"
#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// An action that may run, and the guards that may go stale meanwhile: to its
// left under a node that resumes its running child stands a Condition, a SetSV
// (a measurement) or an Eval whose value can change while the action runs.
struct GuardedAction {
  NodeId action{};
  std::vector<NodeId> guards;  // in pre-order
};
std::vector<GuardedAction> guarded_actions(const BehaviorTree& tree,
                                           const Network& network);

// Of the guards those that the run shows to be stale: it ends with the action
// being ticked while it runs, and each was ticked in the present activation of
// the node above both, but not since the action has answered running.
std::vector<NodeId> stale_guards(const BehaviorTree& tree,
                                 const Network& network,
                                 const GuardedAction& guarded, const Run& run);

// Looks for the first step with which each guarded action is ticked while it
// runs. To be told of single steps as a ReachabilityVisitor is.
class SecondTickWatch {
 public:
  SecondTickWatch(const BehaviorTree& tree, const CompiledNetwork& system);

  void passed(StateId from, StateView before, Step step) {
    if (step.edge == kTimeStep || watched_[step.edge] == kNone) return;
    look_at(before, {from, step.edge});
  }

  const std::vector<GuardedAction>& actions() const { return actions_; }
  // By the number of the action in `actions`.
  const std::optional<FoundStep>& found(std::size_t i) const {
    return found_[i];
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  void look_at(StateView state, FoundStep step);

  const CompiledNetwork& system_;
  std::vector<GuardedAction> actions_;
  std::vector<std::uint32_t> watched_;  // by edge: the number of the action
  std::vector<std::optional<FoundStep>> found_;
};

}  // namespace btcheck
