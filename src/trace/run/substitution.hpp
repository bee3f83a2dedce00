// SPDX-License-Identifier: MIT
//
// A run for the user's own executor: test nodes for BehaviorTree.CPP 4.
#pragma once

#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// JSON for BehaviorTreeFactory::loadSubstitutionRuleFromJSON. Each leaf that
// the run ticks is replaced, by its name, with a test node that answers what it
// answered in the run, in that order, and on in its loop.
//
//   TestNodeConfigs     by the name of the leaf. A leaf that always answers the
//                       same has a return_status alone. Else a script (4.10)
//                       chooses by a counter on the blackboard.
//   SubstitutionRules   by the name of the leaf
//   Blackboard          counters: to be set on tree.rootBlackboard() before the
//                       first tick (BehaviorTree.CPP itself skips this member)
//   Notes               sentences: what a test node cannot repeat, and why
//
// A node that answers running first does so for one millisecond, so that ticks
// must be further apart than that.
std::string substitution_text(const RecordedRun& run);

}  // namespace btcheck
