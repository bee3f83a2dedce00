// SPDX-License-Identifier: MIT
#include "model/btcpp/leaf_types.hpp"

#include <algorithm>
#include <array>

namespace btcheck::btcpp {
namespace {

using enum BtcppKind;
using enum LeafBehaviour;

constexpr LeafTypeRow condition(std::string_view id) {
  return {id, Condition, Synchronous};
}
constexpr LeafTypeRow latched(std::string_view id) {
  return {id, Action, Latched};
}
constexpr LeafTypeRow restarting(std::string_view id) {
  return {id, Action, Restarting};
}
constexpr LeafTypeRow at_once(std::string_view id) {
  return {id, Action, Synchronous};
}
constexpr LeafTypeRow always(std::string_view id) {
  return {id, Action, Synchronous, true, false};
}

constexpr LeafTypeRow from_jazzy(LeafTypeRow row) {
  row.first = Nav2Branch::Jazzy;
  return row;
}
constexpr LeafTypeRow from_main(LeafTypeRow row) {
  row.first = Nav2Branch::Main;
  return row;
}
constexpr LeafTypeRow until_jazzy(LeafTypeRow row) {
  row.last = Nav2Branch::Jazzy;
  return row;
}

constexpr std::array kNav2Leaves = {
    // Conditions that ask the world.
    condition("GoalReached"),
    condition("IsStuck"),
    condition("IsBatteryLow"),
    condition("IsBatteryCharging"),
    condition("InitialPoseReceived"),
    from_jazzy(condition("WouldAControllerRecoveryHelp")),
    from_jazzy(condition("WouldAPlannerRecoveryHelp")),
    from_jazzy(condition("WouldASmootherRecoveryHelp")),
    from_main(condition("WouldARouteRecoveryHelp")),
    from_jazzy(condition("AreErrorCodesPresent")),
    from_jazzy(condition("ArePosesNear")),
    from_main(condition("IsGoalNearby")),
    from_main(condition("IsWithinPathTrackingBounds")),
    until_jazzy(condition("IsPathValid")),
    // Conditions with a memory.
    LeafTypeRow{"GoalUpdated", Condition, FirstTickFails},
    LeafTypeRow{"DistanceTraveled", Condition, FirstTickFails},
    LeafTypeRow{"TimeExpired", Condition, FirstTickFails},
    LeafTypeRow{"PathExpiringTimer", Condition, FirstTickOfLifeFails},
    LeafTypeRow{"GlobalUpdatedGoal", Condition, FirstTickOfLifeSucceeds},
    LeafTypeRow{"TransformAvailable", Condition, SuccessStays},
    // Clients of an action (BtActionNode).
    latched("AssistedTeleop"),
    latched("BackUp"),
    from_jazzy(latched("ComputeAndTrackRoute")),
    latched("ComputePathThroughPoses"),
    latched("ComputePathToPose"),
    from_jazzy(latched("ComputeRoute")),
    latched("DriveOnHeading"),
    latched("FollowPath"),
    latched("NavigateThroughPoses"),
    latched("NavigateToPose"),
    latched("Spin"),
    latched("Wait"),
    latched("SmoothPath"),
    from_main(latched("FollowObject")),
    from_jazzy(latched("DockRobot")),
    from_jazzy(latched("UndockRobot")),
    // Clients of a service (BtServiceNode).
    restarting("ClearEntireCostmap"),
    restarting("ClearCostmapExceptRegion"),
    restarting("ClearCostmapAroundRobot"),
    from_jazzy(restarting("ClearCostmapAroundPose")),
    restarting("ReinitializeGlobalLocalization"),
    from_main(restarting("RemoveInCollisionGoals")),
    from_main(restarting("ToggleCollisionMonitor")),
    from_main(restarting("CheckPoseOccupancy")),
    from_main(restarting("ValidatePath")),
    // Those that cancel a goal and wait for that (BtCancelActionNode).
    at_once("CancelAssistedTeleop"),
    at_once("CancelBackUp"),
    from_jazzy(at_once("CancelComputeAndTrackRoute")),
    at_once("CancelControl"),
    at_once("CancelDriveOnHeading"),
    from_main(at_once("CancelFollowObject")),
    at_once("CancelSpin"),
    at_once("CancelWait"),
    // Those that take over what a topic says (SyncActionNode).
    at_once("ControllerSelector"),
    at_once("GoalCheckerSelector"),
    from_main(at_once("PathHandlerSelector")),
    at_once("PlannerSelector"),
    at_once("ProgressCheckerSelector"),
    at_once("SmootherSelector"),
    // Those that compute something (ActionNodeBase).
    from_jazzy(at_once("ConcatenatePaths")),
    from_main(at_once("ExtractRouteNodesAsGoals")),
    from_jazzy(at_once("GetCurrentPose")),
    from_main(at_once("GetNextFewGoals")),
    from_jazzy(at_once("GetPoseFromPath")),
    at_once("RemovePassedGoals"),
    at_once("TruncatePathLocal"),
    // Those that change a value that is there, and cannot fail.
    from_main(always("AppendGoalPoseToGoals")),
    always("TruncatePath"),
    // Fails while the robot moves, runs until it has stood still for long
    // enough; not a service, but it asks anew at every tick as well.
    from_main(restarting("CheckStopStatus")),
};

constexpr std::array kBothReleases = {
    always("AlwaysSuccess"),
    LeafTypeRow{"AlwaysFailure", Action, Synchronous, false, true}};

constexpr std::array kOnlyVersion4 = {
    // Fails where the entry that is copied has no value; throws where there is
    // no such entry.
    LeafTypeRow{"SetBlackboard", Action, Computed},
    LeafTypeRow{"UnsetBlackboard", Action, Computed, true, false},
    LeafTypeRow{"Script", Action, Computed, true, false},
    LeafTypeRow{"ScriptCondition", Condition, Computed},
    LeafTypeRow{"WasEntryUpdated", Action, Computed},
    // Running until its time is up; of no milliseconds, success at once.
    LeafTypeRow{"Sleep", Action, Latched, true, false}};

constexpr std::array kOnlyVersion3 = {
    LeafTypeRow{"SetBlackboard", Action, Computed, true, false}};

const LeafTypeRow* row_of(std::span<const LeafTypeRow> rows,
                          std::string_view id) {
  const auto found = std::find_if(
      rows.begin(), rows.end(), [&](const auto& row) { return row.id == id; });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace

bool may_run(const LeafTypeRow& leaf) {
  return leaf.behaviour == Latched || leaf.behaviour == Restarting;
}

const LeafTypeRow* builtin_leaf(BtcppRelease release, std::string_view id) {
  if (const LeafTypeRow* row = row_of(kBothReleases, id)) return row;
  return release == BtcppRelease::V4 ? row_of(kOnlyVersion4, id)
                                     : row_of(kOnlyVersion3, id);
}

const LeafTypeRow* nav2_leaf(std::string_view id) {
  return row_of(kNav2Leaves, id);
}

const LeafTypeRow* nav2_leaf(std::string_view id, Nav2Branch branch) {
  const LeafTypeRow* row = nav2_leaf(id);
  if (row == nullptr || branch < row->first || branch > row->last) {
    return nullptr;
  }
  return row;
}

std::span<const LeafTypeRow> nav2_leaves() { return kNav2Leaves; }

}  // namespace btcheck::btcpp
