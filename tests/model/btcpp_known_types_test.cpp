// SPDX-License-Identifier: MIT
//
// The node types of BehaviorTree.CPP and Nav2: all are there, once, with the
// kind that the reader gives them; leaves answer and remember what their base
// class does.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "model/btcpp/known_types.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::btcpp::btcpp_known_types_test {
namespace {

// Nav2's leaves by what they derive from, in any branch.
struct Family {
  BtcppKind kind;
  bool may_run;
  LeafMemory memory;
  const char* ids;
};
const Family kFamilies[] = {
    {BtcppKind::Action, true, LeafMemory::Latched,
     "AssistedTeleop BackUp ComputeAndTrackRoute ComputePathThroughPoses "
     "ComputePathToPose ComputeRoute DriveOnHeading FollowPath "
     "NavigateThroughPoses NavigateToPose Spin Wait SmoothPath FollowObject "
     "DockRobot UndockRobot"},
    {BtcppKind::Action, true, LeafMemory::None,
     "ClearEntireCostmap ClearCostmapExceptRegion ClearCostmapAroundRobot "
     "ClearCostmapAroundPose ReinitializeGlobalLocalization "
     "RemoveInCollisionGoals ToggleCollisionMonitor CheckPoseOccupancy "
     "ValidatePath CheckStopStatus"},
    {BtcppKind::Action, false, LeafMemory::None,
     "CancelAssistedTeleop CancelBackUp CancelComputeAndTrackRoute "
     "CancelControl CancelDriveOnHeading CancelFollowObject CancelSpin "
     "CancelWait ControllerSelector GoalCheckerSelector PathHandlerSelector "
     "PlannerSelector ProgressCheckerSelector SmootherSelector "
     "AppendGoalPoseToGoals ConcatenatePaths ExtractRouteNodesAsGoals "
     "GetCurrentPose GetNextFewGoals GetPoseFromPath RemovePassedGoals "
     "TruncatePath TruncatePathLocal"},
    {BtcppKind::Condition, false, LeafMemory::None,
     "GoalReached IsStuck IsBatteryLow IsBatteryCharging InitialPoseReceived "
     "WouldAControllerRecoveryHelp WouldAPlannerRecoveryHelp "
     "WouldASmootherRecoveryHelp WouldARouteRecoveryHelp AreErrorCodesPresent "
     "ArePosesNear IsGoalNearby IsWithinPathTrackingBounds IsPathValid"},
    {BtcppKind::Condition, true, LeafMemory::None, "IsStopped"},
    {BtcppKind::Condition, false, LeafMemory::FirstTickFails,
     "GoalUpdated DistanceTraveled TimeExpired"},
    {BtcppKind::Condition, false, LeafMemory::FirstTickOfLifeFails,
     "PathExpiringTimer"},
    {BtcppKind::Condition, false, LeafMemory::FirstTickOfLifeSucceeds,
     "GlobalUpdatedGoal"},
    {BtcppKind::Condition, false, LeafMemory::SuccessStays,
     "TransformAvailable"}};

bool is_in(Nav2Branch branch, const NodeTypeRow& row) {
  return row.branches.has(branch);
}

std::size_t count_in(Nav2Branch branch, BtcppKind kind) {
  std::size_t count = 0;
  for (const NodeTypeRow& row : nav2_types()) {
    if (row.kind == kind && is_in(branch, row)) ++count;
  }
  return count;
}

bool is_leaf(const NodeTypeRow& row) {
  return row.kind == BtcppKind::Action || row.kind == BtcppKind::Condition;
}

TEST_CASE("every leaf of Nav2 has a row that fits what it derives from") {
  std::size_t count = 0;
  for (const Family& family : kFamilies) {
    std::istringstream ids(family.ids);
    for (std::string id; ids >> id; ++count) {
      CAPTURE(id);
      const NodeTypeRow* leaf = nav2_type(id);
      REQUIRE(leaf != nullptr);
      CHECK(leaf->kind == family.kind);
      CHECK(leaf->answers.may_run == family.may_run);
      CHECK(leaf->answers.memory == family.memory);
    }
  }
  const auto types = nav2_types();
  CHECK(count == static_cast<std::size_t>(
                     std::count_if(types.begin(), types.end(), is_leaf)));
}

TEST_CASE("no type of Nav2 is there twice, and the leaves are lowered as one") {
  std::set<std::string_view> ids;
  for (const NodeTypeRow& row : nav2_types()) {
    CAPTURE(row.id);
    CHECK(ids.insert(row.id).second);
    CHECK(!row.branches.is_empty());
    CHECK((row.answers.may_succeed || row.answers.may_fail));
    CHECK(nav2_type(row.id) == &row);
    CHECK(is_leaf(row) == (info_of(row.type).max_children == 0));
    CHECK(builtin_type(BtcppRelease::V4, row.id) == nullptr);
  }
  CHECK(!is_leaf(*nav2_type("RecoveryNode")));
  CHECK(nav2_type("goalupdated") == nullptr);
}

// As many as the plugins of each branch register, with those for docking.
TEST_CASE("each branch of Nav2 has its leaves") {
  using enum Nav2Branch;
  const auto has = [](Nav2Branch branch, std::string_view id) {
    return is_in(branch, *nav2_type(id));
  };
  CHECK(count_in(Galactic, BtcppKind::Action) == 17);
  CHECK(count_in(Galactic, BtcppKind::Condition) == 8);
  CHECK(count_in(Humble, BtcppKind::Action) == 32);
  CHECK(count_in(Humble, BtcppKind::Condition) == 12);
  CHECK(count_in(Iron, BtcppKind::Action) == 30);
  CHECK(count_in(Iron, BtcppKind::Condition) == 16);
  CHECK(count_in(Jazzy, BtcppKind::Action) == 38);
  CHECK(count_in(Jazzy, BtcppKind::Condition) == 17);
  CHECK(count_in(Kilted, BtcppKind::Action) == 41);
  CHECK(count_in(Kilted, BtcppKind::Condition) == 19);
  CHECK(count_in(Lyrical, BtcppKind::Action) == 49);
  CHECK(count_in(Lyrical, BtcppKind::Condition) == 19);
  CHECK(has(Kilted, "IsPathValid"));
  CHECK(!has(Lyrical, "IsPathValid"));
  CHECK(!has(Kilted, "ValidatePath"));
  CHECK(has(Lyrical, "ValidatePath"));
  CHECK(has(Galactic, "SpeedController"));
  CHECK(!has(Galactic, "PathLongerOnApproach"));
  CHECK(has(Humble, "ComputeRoute"));
  CHECK(!has(Iron, "ComputeRoute"));
  CHECK(!has(Kilted, "ClearCostmapAroundPose"));
  CHECK(has(Kilted, "IsStopped"));
  CHECK(!has(Jazzy, "IsStopped"));
}

TEST_CASE("the kind of a builtin type fits what it is lowered as") {
  for (const auto release : {BtcppRelease::V3, BtcppRelease::V4}) {
    for (const std::string& id : builtin_names(release)) {
      CAPTURE(id);
      const NodeTypeRow* row = builtin_type(release, id);
      REQUIRE(row != nullptr);
      const NodeTypeInfo& info = info_of(row->type);
      CHECK(is_leaf(*row) == (info.max_children == 0));
      CHECK((row->exact_children == 0 ||
             (row->exact_children >= info.min_children &&
              row->exact_children <= info.max_children)));
    }
  }
  CHECK(builtin_type(BtcppRelease::V3, "Sleep") == nullptr);
}

TEST_CASE("who may run, and who may not fail") {
  CHECK(nav2_type("FollowPath")->answers.may_run);
  CHECK(nav2_type("ValidatePath")->answers.may_run);
  CHECK(!nav2_type("IsPathValid")->answers.may_run);
  CHECK(!nav2_type("CancelControl")->answers.may_run);
  CHECK(builtin_type(BtcppRelease::V4, "Sleep")->answers.may_run);
  CHECK(!builtin_type(BtcppRelease::V4, "Sleep")->answers.may_fail);
  CHECK(!builtin_type(BtcppRelease::V4, "AlwaysFailure")->answers.may_succeed);
  CHECK(builtin_type(BtcppRelease::V4, "SetBlackboard")->answers.may_fail);
  CHECK(!builtin_type(BtcppRelease::V3, "SetBlackboard")->answers.may_fail);
}

}  // namespace
}  // namespace btcheck::btcpp::btcpp_known_types_test
