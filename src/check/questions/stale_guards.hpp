// SPDX-License-Identifier: MIT
//
// Guards that are not ticked again while the action behind them runs.
//
// Which guards a run has asked hangs on the run, and the search keeps one run
// of many. So an action's guards are those that every run to it has asked: in
// (Sequence c (Fallback d e) a) c and d, but not e; nor what may be skipped.
#pragma once

#include <vector>

#include "check/findings/suspicion.hpp"
#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// An action that may run while guards go stale: to their left under a node that
// resumes its running child stands a Condition, a SetSV (a measurement) or an
// Eval whose value can change while the action runs.
struct GuardedAction {
  // The action is ticked while it runs.
  Sighting sighting;
  // In pre-order. Each was ticked on any run to the sighting, but not since the
  // action has answered running.
  std::vector<NodeId> guards;
};

// By action, in pre-order. An action has several where a node in between may
// have begun anew and left it running: that has to run, too.
std::vector<GuardedAction> guarded_actions(const BehaviorTree& tree,
                                           const Network& network);

// Of its guards those that a run to the sighting shows to be so.
std::vector<NodeId> stale_guards(const Network& network,
                                 const GuardedAction& guarded,
                                 const std::vector<Step>& run);

}  // namespace btcheck
