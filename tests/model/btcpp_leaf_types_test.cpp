// SPDX-License-Identifier: MIT
//
// The leaves of BehaviorTree.CPP and Nav2: all are there, once, with the kind
// that the reader gives them and the behaviour of their base class.
#include <doctest/doctest.h>

#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "model/btcpp/leaf_types.hpp"
#include "model/btcpp/node_types.hpp"

namespace btcheck::btcpp {
namespace {

// Nav2's leaves by what they derive from, in any branch.
struct Family {
  BtcppKind kind;
  LeafBehaviour behaviour;
  const char* ids;
};
const Family kFamilies[] = {
    {BtcppKind::Action, LeafBehaviour::Latched,
     "AssistedTeleop BackUp ComputeAndTrackRoute ComputePathThroughPoses "
     "ComputePathToPose ComputeRoute DriveOnHeading FollowPath "
     "NavigateThroughPoses NavigateToPose Spin Wait SmoothPath FollowObject "
     "DockRobot UndockRobot"},
    {BtcppKind::Action, LeafBehaviour::Restarting,
     "ClearEntireCostmap ClearCostmapExceptRegion ClearCostmapAroundRobot "
     "ClearCostmapAroundPose ReinitializeGlobalLocalization "
     "RemoveInCollisionGoals ToggleCollisionMonitor CheckPoseOccupancy "
     "ValidatePath CheckStopStatus"},
    {BtcppKind::Action, LeafBehaviour::Synchronous,
     "CancelAssistedTeleop CancelBackUp CancelComputeAndTrackRoute "
     "CancelControl CancelDriveOnHeading CancelFollowObject CancelSpin "
     "CancelWait ControllerSelector GoalCheckerSelector PathHandlerSelector "
     "PlannerSelector ProgressCheckerSelector SmootherSelector "
     "AppendGoalPoseToGoals ConcatenatePaths ExtractRouteNodesAsGoals "
     "GetCurrentPose GetNextFewGoals GetPoseFromPath RemovePassedGoals "
     "TruncatePath TruncatePathLocal"},
    {BtcppKind::Condition, LeafBehaviour::Synchronous,
     "GoalReached IsStuck IsBatteryLow IsBatteryCharging InitialPoseReceived "
     "WouldAControllerRecoveryHelp WouldAPlannerRecoveryHelp "
     "WouldASmootherRecoveryHelp WouldARouteRecoveryHelp AreErrorCodesPresent "
     "ArePosesNear IsGoalNearby IsWithinPathTrackingBounds IsPathValid"},
    {BtcppKind::Condition, LeafBehaviour::FirstTickFails,
     "GoalUpdated DistanceTraveled TimeExpired"},
    {BtcppKind::Condition, LeafBehaviour::FirstTickOfLifeFails,
     "PathExpiringTimer"},
    {BtcppKind::Condition, LeafBehaviour::FirstTickOfLifeSucceeds,
     "GlobalUpdatedGoal"},
    {BtcppKind::Condition, LeafBehaviour::SuccessStays, "TransformAvailable"}};

std::size_t count_in(Nav2Branch branch, BtcppKind kind) {
  std::size_t count = 0;
  for (const LeafTypeRow& leaf : nav2_leaves()) {
    if (leaf.kind == kind && nav2_leaf(leaf.id, branch) != nullptr) ++count;
  }
  return count;
}

TEST_CASE("every leaf of Nav2 has a row that fits what it derives from") {
  std::size_t count = 0;
  for (const Family& family : kFamilies) {
    std::istringstream ids(family.ids);
    for (std::string id; ids >> id; ++count) {
      CAPTURE(id);
      const LeafTypeRow* leaf = nav2_leaf(id);
      REQUIRE(leaf != nullptr);
      CHECK(leaf->kind == family.kind);
      CHECK(leaf->behaviour == family.behaviour);
    }
  }
  CHECK(count == nav2_leaves().size());
}

TEST_CASE("no leaf of Nav2 is there twice, and the reader knows all") {
  std::set<std::string_view> ids;
  for (const LeafTypeRow& leaf : nav2_leaves()) {
    CAPTURE(leaf.id);
    CHECK(ids.insert(leaf.id).second);
    CHECK(leaf.first <= leaf.last);
    CHECK((leaf.may_succeed || leaf.may_fail));
    const NodeTypeRow* type = nav2_type(leaf.id);
    REQUIRE(type != nullptr);
    CHECK(type->kind == leaf.kind);
    CHECK(type->max_children == 0);
    CHECK(builtin_type(BtcppRelease::V4, leaf.id) == nullptr);
  }
  CHECK(nav2_leaf("RecoveryNode") == nullptr);
  CHECK(nav2_leaf("goalupdated") == nullptr);
}

// As many as nav2_tree_nodes.xml lists in each branch.
TEST_CASE("each branch of Nav2 has its leaves") {
  CHECK(count_in(Nav2Branch::Humble, BtcppKind::Action) == 29);
  CHECK(count_in(Nav2Branch::Humble, BtcppKind::Condition) == 12);
  CHECK(count_in(Nav2Branch::Jazzy, BtcppKind::Action) == 38);
  CHECK(count_in(Nav2Branch::Jazzy, BtcppKind::Condition) == 17);
  CHECK(count_in(Nav2Branch::Main, BtcppKind::Action) == 49);
  CHECK(count_in(Nav2Branch::Main, BtcppKind::Condition) == 19);
  CHECK(nav2_leaf("IsPathValid", Nav2Branch::Jazzy) != nullptr);
  CHECK(nav2_leaf("IsPathValid", Nav2Branch::Main) == nullptr);
  CHECK(nav2_leaf("ValidatePath", Nav2Branch::Jazzy) == nullptr);
  CHECK(nav2_leaf("ValidatePath", Nav2Branch::Main) != nullptr);
}

TEST_CASE("every leaf that BehaviorTree.CPP registers has a row") {
  for (const auto release : {BtcppRelease::V3, BtcppRelease::V4}) {
    for (const std::string& id : builtin_names(release)) {
      CAPTURE(id);
      const BtcppKind kind = builtin_type(release, id)->kind;
      const LeafTypeRow* leaf = builtin_leaf(release, id);
      const bool is_leaf =
          kind == BtcppKind::Action || kind == BtcppKind::Condition;
      REQUIRE((leaf != nullptr) == is_leaf);
      if (leaf != nullptr) CHECK(leaf->kind == kind);
    }
  }
  CHECK(builtin_leaf(BtcppRelease::V3, "Sleep") == nullptr);
}

TEST_CASE("who may run, and who may not fail") {
  CHECK(may_run(*nav2_leaf("FollowPath")));
  CHECK(may_run(*nav2_leaf("ValidatePath")));
  CHECK(!may_run(*nav2_leaf("IsPathValid")));
  CHECK(!may_run(*nav2_leaf("CancelControl")));
  CHECK(may_run(*builtin_leaf(BtcppRelease::V4, "Sleep")));
  CHECK(!builtin_leaf(BtcppRelease::V4, "Sleep")->may_fail);
  CHECK(!builtin_leaf(BtcppRelease::V4, "AlwaysFailure")->may_succeed);
  CHECK(builtin_leaf(BtcppRelease::V4, "SetBlackboard")->may_fail);
  CHECK(!builtin_leaf(BtcppRelease::V3, "SetBlackboard")->may_fail);
}

}  // namespace
}  // namespace btcheck::btcpp
