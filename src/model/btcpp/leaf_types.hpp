// SPDX-License-Identifier: MIT
//
// What the actions and conditions that BehaviorTree.CPP and Nav2 bring along
// can answer, and what they remember. After BehaviorTree.CPP 3.8.8 and 4.10.0
// (src/action_node.cpp, actions/) and Nav2's branches humble, jazzy and main
// (nav2_behavior_tree/plugins/action, …/condition, and the base classes in
// nav2_behavior_tree/include/nav2_behavior_tree).
//
// A leaf is reset when its parent gives it the status IDLE again: after the
// parent's end, at a halt, and below a ReactiveSequence or ReactiveFallback
// whenever another child runs. A leaf's own members outlive that. No leaf here
// answers SKIPPED.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "model/btcpp/document.hpp"

namespace btcheck::btcpp {

enum class LeafBehaviour : std::uint8_t {
  // Success, failure or running at every tick, the first included. Ticked
  // again after success or failure without a reset, it gives the same answer
  // and starts nothing. StatefulActionNode; Nav2's BtActionNode, which looks
  // at its own status: only IDLE sends a new goal.
  Latched,
  // Success, failure or running. Ticked again after success or failure without
  // a reset, it starts anew. Nav2's BtServiceNode, which looks at its own
  // `request_sent_` and sends another request; CheckStopStatus.
  Restarting,
  // Success or failure, anew at every tick, reset or not. SyncActionNode,
  // ConditionNode, Nav2's BtCancelActionNode (which waits within the tick), and
  // what derives from ActionNodeBase and answers at once.
  Synchronous,
  // A condition that fails on the first tick after a reset, where it notes
  // what it compares with later; then success or failure. It remembers nothing
  // beyond a reset: its own status is all the state there is.
  FirstTickFails,
  // A condition that fails on the first tick since the tree was made (member
  // `first_time_`); then success or failure, whatever resets it.
  FirstTickOfLifeFails,
  // A condition that succeeds on the first tick since the tree was made
  // (member `first_time`); then success or failure, whatever resets it.
  FirstTickOfLifeSucceeds,
  // A condition that never fails again once it has succeeded (member
  // `was_found_`), whatever resets it.
  SuccessStays,
  // Answers at once; what, the blackboard and the attributes say, not the
  // world. WasEntryUpdated remembers the last change it saw (`sequence_id_`)
  // beyond a reset; the others remember nothing.
  Computed
};

// The branches that profiles are named after, in the order of their release.
enum class Nav2Branch : std::uint8_t { Humble, Jazzy, Main };

struct LeafTypeRow {
  std::string_view id;
  BtcppKind kind;  // Action or Condition
  LeafBehaviour behaviour;
  bool may_succeed = true;
  bool may_fail = true;
  // The branches that have it; of no meaning in BehaviorTree.CPP's own.
  Nav2Branch first = Nav2Branch::Humble;
  Nav2Branch last = Nav2Branch::Main;
};

// Whether it can answer running.
bool may_run(const LeafTypeRow& leaf);

// A leaf that every program of this release has registered, or nullptr.
const LeafTypeRow* builtin_leaf(BtcppRelease release, std::string_view id);

// A leaf of Nav2 in any branch, or nullptr.
const LeafTypeRow* nav2_leaf(std::string_view id);
// A leaf of Nav2 in this branch, or nullptr.
const LeafTypeRow* nav2_leaf(std::string_view id, Nav2Branch branch);

// All of Nav2's, no two of one ID.
std::span<const LeafTypeRow> nav2_leaves();

}  // namespace btcheck::btcpp
