// SPDX-License-Identifier: MIT
#include "model/btcpp/known_types.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/releases.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace btcheck::btcpp {
namespace {

using enum PortType;
using enum Need;
constexpr auto kIn = BtcppDirection::Input;
constexpr auto kOut = BtcppDirection::Output;
constexpr auto kInOut = BtcppDirection::InOut;

constexpr std::array kSubTree = {
    PortRow{"_autoremap", kIn, Bool, Optional, "false",
            "If true, all the ports with the same name will be remapped"}};
constexpr std::array kParallel = {
    PortRow{"success_count", kIn, Int, Optional, "-1",
            "number of children that need to succeed to trigger a SUCCESS"},
    PortRow{"failure_count", kIn, Int, Optional, "1",
            "number of children that need to fail to trigger a FAILURE"}};
constexpr Releases kHasTwoThresholds = {releases::kHasOneThreshold.end,
                                        kNoRelease};
constexpr std::array kOldParallel = {
    PortRow{.name = "threshold",
            .type = Int,
            .need = Mandatory,
            .in = releases::kHasOneThreshold},
    PortRow{.name = "success_threshold",
            .type = Int,
            .need = Mandatory,
            .in = kHasTwoThresholds},
    PortRow{.name = "failure_threshold", .type = Int, .in = kHasTwoThresholds}};
constexpr std::array kParallelAll = {
    PortRow{"max_failures", kIn, Int, Optional, "1",
            "If the number of children returning FAILURE exceeds this value, "
            "ParallelAll returns FAILURE"}};
constexpr std::array kTryCatch = {
    PortRow{"catch_on_halt", kIn, Bool, Optional, "false",
            "If true, execute the catch child when the node is halted during "
            "the try-block"}};
constexpr std::array kRetry = {
    PortRow{"num_attempts", kIn, Int, Mandatory, "",
            "Execute again a failing child up to N times. Use -1 to create an "
            "infinite loop."}};
constexpr std::array kRepeat = {
    PortRow{"num_cycles", kIn, Int, Mandatory, "",
            "Repeat a successful child up to N times. Use -1 to create an "
            "infinite loop."}};
constexpr std::array kSleep = {PortRow{"msec", kIn, Unsigned, Mandatory}};
constexpr std::array kTimeout = {
    PortRow{"msec", kIn, Unsigned, Mandatory, "",
            "After a certain amount of time, halt() the child if it is still "
            "running."}};
constexpr std::array kDelay = {
    PortRow{"delay_msec", kIn, Unsigned, Mandatory, "",
            "Tick the child after a few milliseconds"}};
constexpr std::array kRunOnce = {
    PortRow{"then_skip", kIn, Bool, Optional, "true",
            "If true, skip after the first execution, otherwise return the "
            "same NodeStatus returned once by the child."}};
constexpr std::array kPrecondition = {
    PortRow{"if", kIn, Script, Mandatory},
    PortRow{"else", kIn, Status, Optional, "FAILURE",
            "Return status if condition is false"}};
constexpr std::array kScript = {PortRow{"code", kIn, Script, Mandatory, "",
                                        "Piece of code that can be parsed"}};
constexpr std::array kScriptCondition = {
    PortRow{"code", kIn, Script, Mandatory, "",
            "Piece of code that can be parsed. Must return false or true",
            "BT::AnyTypeAllowed"}};
constexpr std::array kSetBlackboard = {
    PortRow{"value", kIn, Any, Mandatory, "",
            "Value to be written into the output_key"},
    PortRow{"output_key", kInOut, Any, Mandatory, "",
            "Name of the blackboard entry where the value should be written"}};
constexpr std::array kUnset = {
    PortRow{"key", kIn, String, Mandatory, "", "Key of the entry to remove"}};
constexpr std::array kEntry = {
    PortRow{"entry", kIn, Any, Mandatory, "", "Entry to check", "BT::Any"}};
constexpr std::array kSwitch = {PortRow{"variable", kIn, String, Mandatory},
                                PortRow{"case_1", kIn, String, Mandatory},
                                PortRow{"case_2", kIn, String, Mandatory},
                                PortRow{"case_3", kIn, String, Mandatory},
                                PortRow{"case_4", kIn, String, Mandatory},
                                PortRow{"case_5", kIn, String, Mandatory},
                                PortRow{"case_6", kIn, String, Mandatory}};

template <PortType type>
constexpr std::array kLoop = {
    PortRow{"queue", kInOut, Any, Mandatory},
    PortRow{"if_empty", kIn, Status, Optional, "SUCCESS",
            "Status to return if queue is empty: "
            "SUCCESS, FAILURE, SKIPPED"},
    PortRow{"value", kOut, type}};
constexpr std::array kCheck = {PortRow{"value_A", kIn, Any, Mandatory},
                               PortRow{"value_B", kIn, Any, Mandatory},
                               PortRow{"return_on_mismatch", kIn, Status}};

// Rows. Those of inner nodes first.
constexpr NodeTypeRow control(std::string_view id, NodeType type,
                              std::span<const PortRow> ports = {},
                              int exact_children = 0) {
  return {id, BtcppKind::Control, type, ports, exact_children};
}
constexpr NodeTypeRow decorator(std::string_view id, NodeType type,
                                std::span<const PortRow> ports = {}) {
  return {id, BtcppKind::Decorator, type, ports};
}
constexpr NodeTypeRow subtree(std::string_view id,
                              std::span<const PortRow> ports = {}) {
  return {id, BtcppKind::SubTree, NodeType::SubTree, ports};
}
// Cases 1 to `count`, and a last child for all other values.
constexpr NodeTypeRow switch_of(std::string_view id, std::size_t count) {
  return control(id, NodeType::Switch, std::span(kSwitch).first(count + 1),
                 static_cast<int>(count + 1));
}

// A leaf is reset when its parent gives it the status IDLE again: after the
// parent's end, at a halt, and below a ReactiveSequence or ReactiveFallback
// whenever another child runs. A leaf's own members outlive that.

// At once, and anew on every tick: SyncActionNode, ConditionNode, Nav2's
// BtCancelActionNode (which waits within the tick), and what derives from
// ActionNodeBase and answers at once.
constexpr LeafAnswers kAtOnce = {};
constexpr LeafAnswers kSucceeds = {true, false};
constexpr LeafAnswers kFails = {false, true};
// Ticked again after its end without a reset, it gives the same answer and
// starts nothing. StatefulActionNode; Nav2's BtActionNode, which looks at its
// own status: only IDLE sends a new goal.
constexpr LeafAnswers kLatched = {true, true, true, LeafMemory::Latched};
// Ticked again after its end without a reset, it starts anew. Nav2's
// BtServiceNode, which looks at its own `request_sent_` and sends another
// request.
constexpr LeafAnswers kRestarting = {true, true, true};

constexpr NodeTypeRow action(std::string_view id, LeafAnswers answers,
                             std::span<const PortRow> ports = {},
                             NodeType type = NodeType::Action) {
  return {id, BtcppKind::Action, type, ports, 0, answers};
}
constexpr NodeTypeRow condition(std::string_view id,
                                LeafMemory memory = LeafMemory::None) {
  const LeafAnswers answers = {true, true, false, memory};
  return {id, BtcppKind::Condition, NodeType::Condition, {}, 0, answers};
}

constexpr NodeTypeRow in(Nav2Branches branches, NodeTypeRow row) {
  row.branches = branches;
  return row;
}
constexpr Nav2Branches from(Nav2Branch first) {
  return Nav2Branches::between(first, Nav2Branch::Lyrical);
}
constexpr Nav2Branches kFromHumble = from(Nav2Branch::Humble);
constexpr Nav2Branches kFromIron = from(Nav2Branch::Iron);
constexpr Nav2Branches kFromJazzy = from(Nav2Branch::Jazzy);
constexpr Nav2Branches kFromKilted = from(Nav2Branch::Kilted);
constexpr Nav2Branches kFromLyrical = from(Nav2Branch::Lyrical);
constexpr Nav2Branches kGalactic = {Nav2Branch::Galactic};
constexpr Nav2Branches kKilted = {Nav2Branch::Kilted};
constexpr Nav2Branches kUntilKilted =
    Nav2Branches::between(Nav2Branch::Humble, Nav2Branch::Kilted);
// Taken back into older branches, but not into all.
constexpr Nav2Branches kNotIron = {Nav2Branch::Humble, Nav2Branch::Jazzy,
                                   Nav2Branch::Kilted, Nav2Branch::Lyrical};
constexpr Nav2Branches kJazzyAndLyrical = {Nav2Branch::Jazzy,
                                           Nav2Branch::Lyrical};

constexpr std::array kBothReleases = {
    control("Fallback", NodeType::Fallback),
    control("Sequence", NodeType::Sequence),
    control("ReactiveSequence", NodeType::ReactiveSequence),
    control("ReactiveFallback", NodeType::ReactiveFallback),
    control("IfThenElse", NodeType::IfThenElse),
    decorator("Inverter", NodeType::Inverter),
    decorator("RetryUntilSuccessful", NodeType::RetryUntilSuccessful, kRetry),
    decorator("KeepRunningUntilFailure", NodeType::KeepRunningUntilFailure),
    decorator("Repeat", NodeType::Repeat, kRepeat),
    decorator("Timeout", NodeType::Timeout, kTimeout),
    decorator("Delay", NodeType::Delay, kDelay),
    decorator("ForceSuccess", NodeType::ForceSuccess),
    decorator("ForceFailure", NodeType::ForceFailure),
    action("AlwaysSuccess", kSucceeds),
    action("AlwaysFailure", kFails),
    switch_of("Switch2", 2),
    switch_of("Switch3", 3),
    switch_of("Switch4", 4),
    switch_of("Switch5", 5),
    switch_of("Switch6", 6)};

constexpr std::array kOnlyVersion4 = {
    subtree("SubTree", kSubTree),
    control("AsyncFallback", NodeType::AsyncFallback),
    control("AsyncSequence", NodeType::AsyncSequence),
    control("SequenceWithMemory", NodeType::SequenceWithMemory),
    control("Parallel", NodeType::Parallel, kParallel),
    control("ParallelAll", NodeType::ParallelAll, kParallelAll),
    control("WhileDoElse", NodeType::WhileDoElse),
    control("TryCatch", NodeType::TryCatch, kTryCatch),
    decorator("RunOnce", NodeType::RunOnce, kRunOnce),
    decorator("Precondition", NodeType::Precondition, kPrecondition),
    action("Script", kSucceeds, kScript, NodeType::Script),
    NodeTypeRow{"ScriptCondition", BtcppKind::Condition, NodeType::Script,
                kScriptCondition},
    // Fails where the entry that is copied has no value; throws where there is
    // no such entry.
    action("SetBlackboard", kAtOnce, kSetBlackboard, NodeType::Script),
    action("UnsetBlackboard", kSucceeds, kUnset, NodeType::Script),
    // Runs until its time is up; with no milliseconds it succeeds at once.
    action("Sleep", {true, false, true, LeafMemory::Latched}, kSleep,
           NodeType::Wait),
    decorator("LoopInt", NodeType::Loop, kLoop<Int>),
    decorator("LoopBool", NodeType::Loop, kLoop<Bool>),
    decorator("LoopDouble", NodeType::Loop, kLoop<Double>),
    decorator("LoopString", NodeType::Loop, kLoop<String>),
    // Remembers the last change it saw (`sequence_id_`) beyond a reset.
    action("WasEntryUpdated", kAtOnce, kEntry),
    decorator("SkipUnlessUpdated", NodeType::WhenUpdated, kEntry),
    decorator("WaitValueUpdate", NodeType::WhenUpdated, kEntry)};

constexpr std::array kOnlyVersion3 = {
    subtree("SubTree"),
    control("SequenceStar", NodeType::SequenceWithMemory),
    control("Parallel", NodeType::Parallel, kOldParallel),
    control("WhileDoElse", NodeType::WhileDoElse, {}, 3),
    subtree("SubTreePlus"),
    action("SetBlackboard", kSucceeds, kSetBlackboard, NodeType::Script),
    decorator("BlackboardCheckInt", NodeType::BlackboardCheck, kCheck),
    decorator("BlackboardCheckDouble", NodeType::BlackboardCheck, kCheck),
    decorator("BlackboardCheckString", NodeType::BlackboardCheck, kCheck),
    decorator("BlackboardCheckBool", NodeType::BlackboardCheck, kCheck)};

constexpr std::array kRecovery = {PortRow{"number_of_retries", kIn, Int}};
constexpr std::array kRoundRobin = {PortRow{"wrap_around", kIn, Bool}};
constexpr std::array kPersistent = {
    PortRow{"current_child_idx", kInOut, Int, Mandatory}};
constexpr std::array kRate = {PortRow{"hz", kIn, Double}};
constexpr std::array kDistance = {PortRow{"distance", kIn, Double}};
constexpr std::array kSpeed = {
    PortRow{"min_rate", kIn, Double}, PortRow{"max_rate", kIn, Double},
    PortRow{"min_speed", kIn, Double}, PortRow{"max_speed", kIn, Double}};
constexpr std::array kApproach = {PortRow{"prox_len", kIn, Double},
                                  PortRow{"length_factor", kIn, Double}};

// nav2_docking/opennav_docking_bt/include/opennav_docking_bt/dock_robot.hpp and
// undock_robot.hpp of main, and BtActionNode's own; `error_msg` since kilted.
constexpr std::array kDock = {PortRow{"use_dock_id", kIn, Bool},
                              PortRow{"dock_id", kIn, String},
                              PortRow{"dock_pose", kIn},
                              PortRow{"dock_type", kIn, String},
                              PortRow{"max_staging_time", kIn, Double},
                              PortRow{"navigate_to_staging_pose", kIn, Bool},
                              PortRow{"server_name", kIn, String},
                              PortRow{"server_timeout", kIn},
                              PortRow{"success", kOut, Bool},
                              PortRow{"error_code_id", kOut},
                              PortRow{"error_msg", kOut, String},
                              PortRow{"num_retries", kOut}};
constexpr std::array kUndock = {PortRow{"dock_type", kIn, String},
                                PortRow{"max_undocking_time", kIn, Double},
                                PortRow{"server_name", kIn, String},
                                PortRow{"server_timeout", kIn},
                                PortRow{"success", kOut, Bool},
                                PortRow{"error_code_id", kOut},
                                PortRow{"error_msg", kOut, String}};

constexpr std::array kNav2 = {
    control("RecoveryNode", NodeType::Recovery, kRecovery),
    control("PipelineSequence", NodeType::PipelineSequence),
    control("RoundRobin", NodeType::RoundRobin, kRoundRobin),
    in(kFromLyrical,
       control("NonblockingSequence", NodeType::NonblockingSequence)),
    in(kFromLyrical, control("PersistentSequence", NodeType::PersistentSequence,
                             kPersistent)),
    in(kFromLyrical,
       control("PauseResumeController", NodeType::PauseResumeController)),
    decorator("RateController", NodeType::RateController, kRate),
    decorator("DistanceController", NodeType::WhenDue, kDistance),
    decorator("SpeedController", NodeType::WhenDue, kSpeed),
    decorator("GoalUpdatedController", NodeType::WhenDue),
    decorator("GoalUpdater", NodeType::GoalUpdater),
    in(kFromHumble, decorator("PathLongerOnApproach",
                              NodeType::PathLongerOnApproach, kApproach)),
    decorator("SingleTrigger", NodeType::SingleTrigger),
    // Conditions that ask the world.
    condition("GoalReached"),
    condition("IsStuck"),
    condition("IsBatteryLow"),
    in(kFromHumble, condition("IsBatteryCharging")),
    condition("InitialPoseReceived"),
    in(kFromIron, condition("WouldAControllerRecoveryHelp")),
    in(kFromIron, condition("WouldAPlannerRecoveryHelp")),
    in(kFromIron, condition("WouldASmootherRecoveryHelp")),
    in(kFromKilted, condition("WouldARouteRecoveryHelp")),
    in(kFromIron, condition("AreErrorCodesPresent")),
    in(kFromJazzy, condition("ArePosesNear")),
    in(kFromLyrical, condition("IsGoalNearby")),
    in(kFromLyrical, condition("IsWithinPathTrackingBounds")),
    in(kUntilKilted, condition("IsPathValid")),
    // Fails while the robot moves, runs until it has stood still for long
    // enough.
    in(kKilted, {"IsStopped",
                 BtcppKind::Condition,
                 NodeType::Action,
                 {},
                 0,
                 kRestarting}),
    // Conditions with a memory: what to compare with later is noted on the
    // first tick after a reset, or in the life of the tree (`first_time_`); a
    // success is kept (`was_found_`).
    condition("GoalUpdated", LeafMemory::FirstTickFails),
    condition("DistanceTraveled", LeafMemory::FirstTickFails),
    condition("TimeExpired", LeafMemory::FirstTickFails),
    in(kFromHumble,
       condition("PathExpiringTimer", LeafMemory::FirstTickOfLifeFails)),
    in(kFromHumble,
       condition("GlobalUpdatedGoal", LeafMemory::FirstTickOfLifeSucceeds)),
    condition("TransformAvailable", LeafMemory::SuccessStays),
    // Clients of an action (BtActionNode).
    in(kFromHumble, action("AssistedTeleop", kLatched)),
    action("BackUp", kLatched),
    in(kNotIron, action("ComputeAndTrackRoute", kLatched)),
    action("ComputePathThroughPoses", kLatched),
    action("ComputePathToPose", kLatched),
    in(kNotIron, action("ComputeRoute", kLatched)),
    in(kFromHumble, action("DriveOnHeading", kLatched)),
    action("FollowPath", kLatched),
    action("NavigateThroughPoses", kLatched),
    action("NavigateToPose", kLatched),
    action("Spin", kLatched),
    action("Wait", kLatched),
    in(kFromHumble, action("SmoothPath", kLatched)),
    in(kFromLyrical, action("FollowObject", kLatched)),
    in(kFromJazzy, action("DockRobot", kLatched, kDock)),
    in(kFromJazzy, action("UndockRobot", kLatched, kUndock)),
    // Clients of a service (BtServiceNode).
    action("ClearEntireCostmap", kRestarting),
    action("ClearCostmapExceptRegion", kRestarting),
    action("ClearCostmapAroundRobot", kRestarting),
    in(kJazzyAndLyrical, action("ClearCostmapAroundPose", kRestarting)),
    action("ReinitializeGlobalLocalization", kRestarting),
    in(kFromKilted, action("RemoveInCollisionGoals", kRestarting)),
    in(kFromLyrical, action("ToggleCollisionMonitor", kRestarting)),
    in(kFromLyrical, action("CheckPoseOccupancy", kRestarting)),
    in(kFromLyrical, action("ValidatePath", kRestarting)),
    // Those that cancel a goal and wait for that (BtCancelActionNode).
    in(kFromHumble, action("CancelAssistedTeleop", kAtOnce)),
    in(kFromHumble, action("CancelBackUp", kAtOnce)),
    in(kFromJazzy, action("CancelComputeAndTrackRoute", kAtOnce)),
    in(kFromHumble, action("CancelControl", kAtOnce)),
    in(kFromHumble, action("CancelDriveOnHeading", kAtOnce)),
    in(kFromLyrical, action("CancelFollowObject", kAtOnce)),
    in(kFromHumble, action("CancelSpin", kAtOnce)),
    in(kFromHumble, action("CancelWait", kAtOnce)),
    // Those that take over what a topic says (SyncActionNode).
    action("ControllerSelector", kAtOnce),
    action("GoalCheckerSelector", kAtOnce),
    in(kFromLyrical, action("PathHandlerSelector", kAtOnce)),
    action("PlannerSelector", kAtOnce),
    in(kFromHumble, action("ProgressCheckerSelector", kAtOnce)),
    in(kFromHumble, action("SmootherSelector", kAtOnce)),
    // Those that compute something (ActionNodeBase).
    in(kFromJazzy, action("ConcatenatePaths", kAtOnce)),
    in(kFromKilted, action("ExtractRouteNodesAsGoals", kAtOnce)),
    in(kFromJazzy, action("GetCurrentPose", kAtOnce)),
    in(kFromKilted, action("GetNextFewGoals", kAtOnce)),
    in(kFromHumble, action("GetPoseFromPath", kAtOnce)),
    action("RemovePassedGoals", kAtOnce),
    in(kFromHumble, action("TruncatePathLocal", kAtOnce)),
    // Those that change a value that is there, and cannot fail.
    in(kFromKilted, action("AppendGoalPoseToGoals", kSucceeds)),
    action("TruncatePath", kSucceeds),
    // Fails while the robot moves, runs until it has stood still for long
    // enough; not a service, but it asks anew at every tick as well.
    in(kFromLyrical, action("CheckStopStatus", kRestarting)),
};

// py_trees: the arguments of the constructors, as the exporter writes them.
constexpr std::array kMemory = {PortRow{"memory", kIn, Bool, Mandatory}};
constexpr std::array kPolicy = {PortRow{"policy", kIn, String, Mandatory},
                                PortRow{"synchronise", kIn, Bool},
                                PortRow{"selected", kIn, String}};
constexpr std::array kNumSuccess = {
    PortRow{"num_success", kIn, Int, Mandatory}};
constexpr std::array kNumFailures = {
    PortRow{"num_failures", kIn, Int, Mandatory}};
constexpr std::array kSeconds = {PortRow{"duration", kIn, Double, Mandatory}};
constexpr std::array kOneShot = {PortRow{"policy", kIn, String, Mandatory}};
constexpr std::array kAwaited = {PortRow{"status", kIn, String, Mandatory}};
constexpr std::array kVariable = {PortRow{"variable_name", kIn, String}};
constexpr std::array kCheckOf = {PortRow{"check", kIn, String}};
constexpr std::array kSetVariable = {PortRow{"variable_name", kIn, String},
                                     PortRow{"overwrite", kIn, Bool}};
constexpr std::array kWeights = {PortRow{"weights", kIn, String}};
constexpr std::array kTickCounter = {
    PortRow{"duration", kIn, Int, Mandatory},
    PortRow{"completion_status", kIn, String, Mandatory}};
constexpr std::array kQueue = {PortRow{"queue", kIn, String, Mandatory},
                               PortRow{"eventually", kIn, String}};
constexpr std::array kPeriod = {PortRow{"n", kIn, Int, Mandatory}};

constexpr LeafAnswers kRuns = {false, false, true};
constexpr LeafAnswers kAwaits = {true, false, true};
constexpr LeafAnswers kAnything = {true, true, true};

constexpr std::array kPyTrees = {
    subtree("SubTree"), control("Sequence", NodeType::Sequence, kMemory),
    control("Selector", NodeType::Fallback, kMemory),
    control("Parallel", NodeType::PolicyParallel, kPolicy),
    control("EternalGuard", NodeType::EternalGuard),
    decorator("Inverter", NodeType::Inverter),
    decorator("FailureIsSuccess", NodeType::ForceSuccess),
    decorator("SuccessIsFailure", NodeType::ForceFailure),
    decorator("SuccessIsRunning", NodeType::KeepRunningUntilFailure),
    decorator("FailureIsRunning", NodeType::AnswerMap),
    decorator("RunningIsFailure", NodeType::AnswerMap),
    decorator("RunningIsSuccess", NodeType::AnswerMap),
    decorator("Condition", NodeType::AnswerMap, kAwaited),
    decorator("PassThrough", NodeType::AnswerMap),
    decorator("Count", NodeType::AnswerMap),
    decorator("StatusToBlackboard", NodeType::AnswerMap, kVariable),
    decorator("Repeat", NodeType::Repeat, kNumSuccess),
    decorator("Retry", NodeType::RetryUntilSuccessful, kNumFailures),
    decorator("Timeout", NodeType::Timeout, kSeconds),
    decorator("OneShot", NodeType::RunOnce, kOneShot),
    action("Success", kSucceeds), action("Failure", kFails),
    action("Running", kRuns), action("Dummy", kRuns),
    action("TickCounter", {}, kTickCounter, NodeType::AnswerQueue),
    action("StatusQueue", {}, kQueue, NodeType::AnswerQueue),
    action("Periodic", {}, kPeriod, NodeType::AnswerQueue),
    action("SuccessEveryN", {}, kPeriod, NodeType::AnswerQueue),
    action("Timer", kAwaits, kSeconds, NodeType::Wait),
    action("ProbabilisticBehaviour", kAnything, kWeights),
    // What is on the blackboard is left open.
    action("CheckBlackboardVariableExists", kAtOnce, kVariable),
    action("CheckBlackboardVariableValue", kAtOnce, kCheckOf),
    action("CheckBlackboardVariableValues", kAtOnce, kCheckOf),
    action("WaitForBlackboardVariable", kAwaits, kVariable),
    action("WaitForBlackboardVariableValue", kAwaits, kCheckOf),
    action("SetBlackboardVariable", kAtOnce, kSetVariable),
    action("UnsetBlackboardVariable", kSucceeds, kVariable),
    action("BlackboardToStatus", kAnything, kVariable)};

const NodeTypeRow* row_of(std::span<const NodeTypeRow> rows,
                          std::string_view id) {
  const auto found = std::ranges::find(rows, id, &NodeTypeRow::id);
  return found == rows.end() ? nullptr : &*found;
}

std::span<const NodeTypeRow> shared_in(BtcppRelease release) {
  if (release == BtcppRelease::PyTrees) return {};
  return kBothReleases;
}

std::span<const NodeTypeRow> only_in(BtcppRelease release) {
  switch (release) {
    case BtcppRelease::V3:
      return kOnlyVersion3;
    case BtcppRelease::V4:
      return kOnlyVersion4;
    case BtcppRelease::PyTrees:
      return kPyTrees;
  }
  return {};
}

// The C++ types as generated models name them. Those with a width, like
// int16_t, are left out, so that nothing is refused that the engine accepts.
PortType type_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PortType>, 9> kTypes = {
      {{"int", PortType::Int},
       {"unsigned int", PortType::Unsigned},
       {"unsigned", PortType::Unsigned},
       {"bool", PortType::Bool},
       {"double", PortType::Double},
       {"float", PortType::Double},
       {"NodeStatus", PortType::Status},
       {"BT::NodeStatus", PortType::Status},
       {"std::string", PortType::String}}};
  for (const auto& [word, type] : kTypes) {
    if (word == name) return type;
  }
  return PortType::Any;
}

}  // namespace

std::string_view port_type_name(PortType type) {
  constexpr std::array<std::string_view, 8> kNames = {
      "any",    "int",    "unsigned int", "bool",
      "double", "string", "NodeStatus",   "script"};
  return kNames[static_cast<std::size_t>(type)];
}

const NodeTypeRow* builtin_type(BtcppRelease release, std::string_view id) {
  const NodeTypeRow* row = row_of(shared_in(release), id);
  return row != nullptr ? row : row_of(only_in(release), id);
}

const NodeTypeRow* nav2_type(std::string_view id) { return row_of(kNav2, id); }

std::span<const NodeTypeRow> nav2_types() { return kNav2; }

const NodeTypeRow* known_type(BtcppRelease release, std::string_view id) {
  const NodeTypeRow* row = builtin_type(release, id);
  if (row != nullptr || release == BtcppRelease::PyTrees) return row;
  return nav2_type(id);
}

BtcppRelease dialect_of(Profile profile) {
  if (profile == Profile::PyTrees) return BtcppRelease::PyTrees;
  return is_release_3(profile) ? BtcppRelease::V3 : BtcppRelease::V4;
}

// What nobody has named is main rather than lyrical.
Profile profile_of_branch(Nav2Branch branch) {
  constexpr std::array kProfiles = {Profile::Nav2Galactic, Profile::Nav2Humble,
                                    Profile::Nav2Iron,     Profile::Nav2Jazzy,
                                    Profile::Nav2Kilted,   Profile::Nav2Main};
  return kProfiles[static_cast<std::size_t>(branch)];
}

Nav2Branch branch_of(Profile profile) {
  constexpr auto kFirst = static_cast<int>(Profile::Nav2Galactic);
  constexpr auto kLast = static_cast<int>(Nav2Branch::Lyrical);
  const int number = static_cast<int>(profile) - kFirst;
  return static_cast<Nav2Branch>(std::clamp(number, 0, kLast));
}

namespace {

// Ports of Nav2's nodes that only some branches know; "" for any node.
struct PortOfBranches {
  std::string_view node;
  std::string_view port;
  Nav2Branches branches;
};
constexpr Nav2Branches kUntilJazzy =
    Nav2Branches::between(Nav2Branch::Galactic, Nav2Branch::Jazzy);
constexpr std::array kPortsOfBranches = {
    PortOfBranches{"SpeedController", "filter_duration", kGalactic},
    PortOfBranches{"BackUp", "time_allowance", kFromHumble},
    PortOfBranches{"Spin", "time_allowance", kFromHumble},
    PortOfBranches{"Spin", "is_recovery", kFromHumble},
    PortOfBranches{"NavigateToPose", "behavior_tree", kFromHumble},
    PortOfBranches{"NavigateThroughPoses", "behavior_tree", kFromHumble},
    PortOfBranches{"RoundRobin", "wrap_around", kFromLyrical},
    PortOfBranches{"", "error_msg", kFromKilted},
    PortOfBranches{"", "error_code_id", kFromIron},
    PortOfBranches{"", "disable_collision_checks", kFromKilted},
    PortOfBranches{"FollowPath", "progress_checker_id", kFromIron},
    PortOfBranches{"FollowPath", "path_handler_id", kFromLyrical},
    PortOfBranches{"FollowPath", "tracking_feedback", kFromLyrical},
    PortOfBranches{"ComputePathToPose", "viapoints", kFromLyrical},
    PortOfBranches{"ComputePathToPose", "use_start", kFromJazzy},
    PortOfBranches{"GoalUpdater", "input_goals", kFromKilted},
    PortOfBranches{"GoalUpdater", "output_goals", kFromKilted},
    PortOfBranches{"GoalUpdated", "goal", kFromJazzy},
    PortOfBranches{"GoalUpdated", "goals", kFromJazzy},
    PortOfBranches{"GlobalUpdatedGoal", "goal", kFromJazzy},
    PortOfBranches{"GlobalUpdatedGoal", "goals", kFromJazzy},
    PortOfBranches{"IsPathValid", "max_cost", kKilted},
    PortOfBranches{"IsPathValid", "consider_unknown_as_obstacle", kKilted},
    PortOfBranches{"GoalReached", "global_frame", kUntilJazzy},
    PortOfBranches{"RemovePassedGoals", "global_frame", kUntilJazzy},
    PortOfBranches{"TruncatePathLocal", "robot_frame", kUntilKilted},
    PortOfBranches{"TruncatePathLocal", "robot_base_frame", kFromLyrical}};

Nav2Branches branches_for(const BtcppNode& node, const NodeTypeRow& type) {
  Nav2Branches branches = type.branches;
  for (const BtcppAttribute& port : node.ports) {
    branches = branches & branches_with_port(node.id, port.name);
  }
  return branches;
}

}  // namespace

Nav2Branches branches_with_port(std::string_view node, std::string_view port) {
  Nav2Branches branches = Nav2Branches::all();
  for (const PortOfBranches& row : kPortsOfBranches) {
    const bool is_meant = row.node.empty() || row.node == node;
    if (is_meant && row.port == port) branches = branches & row.branches;
  }
  return branches;
}

Nav2Branches branches_for(const BtcppDocument& document) {
  constexpr Nav2Branches kOn3 =
      Nav2Branches::between(Nav2Branch::Galactic, Nav2Branch::Iron);
  Nav2Branches branches =
      document.release == BtcppRelease::V3 ? kOn3 : kFromJazzy;
  for (const BtcppTree& tree : document.trees) {
    for (const BtcppNode& node : tree.nodes) {
      const NodeTypeRow* type = nav2_type(node.id);
      const bool is_other =
          builtin_type(document.release, node.id) != nullptr ||
          document.model(node.id) != nullptr;
      if (type == nullptr || is_other) continue;
      branches = branches & branches_for(node, *type);
    }
  }
  return branches;
}

std::vector<std::string> builtin_names(BtcppRelease release) {
  std::vector<std::string> names;
  for (const auto& row : shared_in(release)) names.emplace_back(row.id);
  for (const auto& row : only_in(release)) names.emplace_back(row.id);
  return names;
}

int first_release(std::string_view id) {
  struct Row {
    std::string_view id;
    int release;
  };
  constexpr std::array kRows = {
      Row{"Delay", 30502},
      Row{"RetryUntilSuccessful", releases::kMisspellsRetry.end},
      Row{"BlackboardCheckBool", 30601},
      Row{"AsyncSequence", 40200},
      Row{"AsyncFallback", 40200},
      Row{"RunOnce", 40200},
      Row{"LoopDouble", 40200},
      Row{"LoopString", 40200},
      Row{"Sleep", 40300},
      Row{"ScriptCondition", 40301},
      Row{"ParallelAll", 40302},
      Row{"LoopInt", 40305},
      Row{"LoopBool", 40305},
      Row{"UnsetBlackboard", 40403},
      Row{"WasEntryUpdated", 40600},
      Row{"SkipUnlessUpdated", 40600},
      Row{"WaitValueUpdate", 40600},
      Row{"TryCatch", 40900}};
  const auto found = std::ranges::find(kRows, id, &Row::id);
  return found == kRows.end() ? 0 : found->release;
}

OldName old_name(BtcppRelease release, std::string_view id) {
  if (release == BtcppRelease::PyTrees) return {};
  // Misspelt in the engine itself up to 3.5.
  constexpr std::string_view kOldRetry = "RetryUntilSuccesful";
  if (release == BtcppRelease::V3) {
    return {id == kOldRetry ? "RetryUntilSuccessful" : "", false};
  }
  if (id == kOldRetry) return {"RetryUntilSuccessful", true};
  // An option of the build, USE_BTCPP3_OLD_NAMES, brings it back.
  if (id == "SequenceStar") return {"SequenceWithMemory", false};
  const bool is_check =
      id.starts_with("BlackboardCheck") && row_of(kOnlyVersion3, id) != nullptr;
  if (is_check) return {"Precondition", true};
  return {};
}

namespace {
bool is_leaf_of_two_kinds(const NodeTypeRow& row) {
  return row.kind == BtcppKind::Condition && row.type == NodeType::Action;
}
}  // namespace

NodeType engine_type(BtcppRelease release, const BtcppNode& node) {
  constexpr std::array kOfKind = {NodeType::Action, NodeType::Condition,
                                  NodeType::OtherControl,
                                  NodeType::OtherDecorator, NodeType::SubTree};
  const NodeType plain = kOfKind[static_cast<std::size_t>(node.kind)];
  if (node.kind == BtcppKind::SubTree) return plain;
  const bool is_of_py_trees = release == BtcppRelease::PyTrees;
  // One of the project's own, whatever a later release calls so.
  const bool is_own =
      release == BtcppRelease::V3 && first_release(node.id) > kNewestRelease3;
  if (is_own) return plain;
  const NodeTypeRow* row =
      known_type(is_of_py_trees ? release : BtcppRelease::V4, node.id);
  if (row == nullptr && !is_of_py_trees) row = row_of(kOnlyVersion3, node.id);
  // A model may make an Action or a Condition of a leaf of Nav2. A condition
  // that may run is an Action to all but its author.
  if (row != nullptr && row->kind == node.kind && is_leaf_of_two_kinds(*row)) {
    return row->type;
  }
  const bool is_special =
      row != nullptr && std::ranges::find(kOfKind, row->type) == kOfKind.end();
  return is_special ? row->type : plain;
}

const LibraryType* library_type_of(const BtcppNode& node,
                                   std::size_t children) {
  const LibraryType* type = library_type(
      node.id, node.is_explicit ? TypeForm::Explicit : TypeForm::Compact);
  if (type == nullptr) return nullptr;
  const bool is_decorator = type->kind == kind_name(BtcppKind::Decorator);
  const bool is_of_kind = !node.is_explicit || node.tag == type->kind;
  return is_of_kind && children == (is_decorator ? 1 : 0) ? type : nullptr;
}

namespace {
std::optional<PortFacts> library_facts(const BtcppNode& node,
                                       std::string_view port) {
  const LibraryType* type = library_type_of(node, node.children.size());
  if (type == nullptr) return std::nullopt;
  if (has_port(type->inputs, port)) return PortFacts{kIn};
  if (has_port(type->outputs, port)) return PortFacts{kOut};
  if (has_port(type->both, port)) return PortFacts{kInOut};
  return std::nullopt;
}
}  // namespace

std::optional<PortFacts> facts_of(const BtcppDocument& document,
                                  const BtcppNode& node,
                                  std::string_view port) {
  const NodeTypeRow* type = builtin_type(document.release, node.id);
  const BtcppModel* model = document.model(node.id);
  if (type == nullptr && model != nullptr) {
    const BtcppPort* found = model->port(port);
    if (found == nullptr) return std::nullopt;
    return PortFacts{found->direction, type_named(found->type)};
  }
  if (type == nullptr) type = known_type(document.release, node.id);
  if (type == nullptr && document.release == BtcppRelease::PyTrees) {
    return std::nullopt;
  }
  if (type == nullptr) return library_facts(node, port);
  for (const PortRow& row : type->ports) {
    if (row.name == port && row.in.has(document.engine())) {
      return PortFacts{row.direction, row.type};
    }
  }
  return std::nullopt;
}

}  // namespace btcheck::btcpp
