// SPDX-License-Identifier: MIT
#include "model/btcpp/known_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/tree/releases.hpp"

namespace btcheck::btcpp {
namespace {

using enum PortType;
using enum Need;
constexpr auto kIn = BtcppDirection::Input;
constexpr auto kOut = BtcppDirection::Output;
constexpr auto kInOut = BtcppDirection::InOut;

// Of types with one port.
template <const auto& rows>
void read_rounds(PortReader& ports, Node& node) {
  node.repetitions = ports.rounds(rows[0].name);
  ports.read_at_tick(node, Int, rows[0].name);
}
template <const auto& rows>
void read_milliseconds(PortReader& ports, Node& node) {
  node.duration = ports.ticks(rows[0].name, 1);
  ports.read_at_tick(node, Unsigned, rows[0].name);
}
template <const auto& rows>
void read_option(PortReader& ports, Node& node) {
  node.option = ports.flag(rows[0].name, rows[0].preset == "true");
}

constexpr std::array kSubTree = {
    PortRow{"_autoremap", kIn, Bool, Optional, "false",
            "If true, all the ports with the same name will be remapped"}};
constexpr PortRow threshold(PortRow row) {
  row.is_threshold = true;
  return row;
}

constexpr std::array kParallel = {
    threshold({"success_count", kIn, Int, Optional, "-1",
               "number of children that need to succeed to trigger a SUCCESS"}),
    threshold({"failure_count", kIn, Int, Optional, "1",
               "number of children that need to fail to trigger a FAILURE"})};
constexpr Releases kHasTwoThresholds = {releases::kHasOneThreshold.end,
                                        kNoRelease};
constexpr std::array kOldParallel = {
    threshold({.name = "threshold",
               .type = Int,
               .need = Mandatory,
               .in = releases::kHasOneThreshold}),
    threshold({.name = "success_threshold",
               .type = Int,
               .need = Mandatory,
               .in = kHasTwoThresholds}),
    threshold(
        {.name = "failure_threshold", .type = Int, .in = kHasTwoThresholds})};
void read_parallel(PortReader& ports, Node& node) {
  const std::string_view successes = releases::success_port(ports.release());
  node.threshold = ports.known_number(successes, -1);
  node.counts_skipped = node.threshold < 0;
  if (ports.is_in(releases::kHasOneThreshold)) {
    const auto count = static_cast<int>(ports.element().children.size());
    node.failure_threshold = count - node.threshold + 1;
    return;
  }
  const bool is_3 = is_release_3(ports.profile());
  node.failure_threshold =
      ports.known_number(is_3 ? "failure_threshold" : "failure_count", 1);
}

constexpr std::array kParallelAll = {threshold(
    {"max_failures", kIn, Int, Optional, "1",
     "If the number of children returning FAILURE exceeds this value, "
     "ParallelAll returns FAILURE"})};
void read_parallel_all(PortReader& ports, Node& node) {
  node.failure_threshold = ports.known_number("max_failures", 1);
}

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
void read_delay(PortReader& ports, Node& node) {
  node.duration = Duration{0, 0};
  if (!ports.is_in(releases::kDelayIsNone)) {
    read_milliseconds<kDelay>(ports, node);
  }
}

constexpr std::array kRunOnce = {
    PortRow{"then_skip", kIn, Bool, Optional, "true",
            "If true, skip after the first execution, otherwise return the "
            "same NodeStatus returned once by the child."}};
constexpr std::array kPrecondition = {
    PortRow{"if", kIn, Script, Mandatory},
    PortRow{"else", kIn, Status, Optional, "FAILURE",
            "Return status if condition is false"}};
void read_precondition(PortReader& ports, Node& node) {
  node.otherwise = ports.status("else", NodeStatus::Failure);
  node.own_scripts = {ports.condition("if")};
}

constexpr std::array kScript = {PortRow{"code", kIn, Script, Mandatory, "",
                                        "Piece of code that can be parsed"}};
void read_script(PortReader& ports, Node& node) {
  node.own_scripts = {ports.action("code")};
}

constexpr std::array kScriptCondition = {
    PortRow{"code", kIn, Script, Mandatory, "",
            "Piece of code that can be parsed. Must return false or true",
            "BT::AnyTypeAllowed"}};
void read_script_condition(PortReader& ports, Node& node) {
  node.answers_value = true;
  node.own_scripts = {ports.condition("code")};
}

constexpr std::array kSetBlackboard = {
    PortRow{"value", kIn, Any, Mandatory, "",
            "Value to be written into the output_key"},
    PortRow{"output_key", kInOut, Any, Mandatory, "",
            "Name of the blackboard entry where the value should be written"}};
void read_set_blackboard(PortReader& ports, Node& node) {
  node.own_scripts = {ports.set_blackboard()};
}

constexpr std::array kUnset = {
    PortRow{"key", kIn, String, Mandatory, "", "Key of the entry to remove"}};
void read_unset_blackboard(PortReader& ports, Node& node) {
  node.own_scripts = {ports.unset_blackboard()};
}

constexpr std::array kEntry = {
    PortRow{"entry", kIn, Any, Mandatory, "", "Entry to check", "BT::Any"}};
template <NodeStatus otherwise>
void read_when_updated(PortReader&, Node& node) {
  node.otherwise = otherwise;
}

constexpr std::string_view kMayBeUpdated =
    "the entry may have been written before each tick";
constexpr std::array kSwitch = {PortRow{"variable", kIn, String, Mandatory},
                                PortRow{"case_1", kIn, String, Mandatory},
                                PortRow{"case_2", kIn, String, Mandatory},
                                PortRow{"case_3", kIn, String, Mandatory},
                                PortRow{"case_4", kIn, String, Mandatory},
                                PortRow{"case_5", kIn, String, Mandatory},
                                PortRow{"case_6", kIn, String, Mandatory}};
void read_cases(PortReader& ports, Node& node) {
  const PortComparison how = ports.is_in(releases::kSwitchComparesTexts)
                                 ? PortComparison::Text
                             : ports.is_in(releases::kSwitchReadsBeginnings)
                                 ? PortComparison::OldSwitch
                                 : PortComparison::Switch;
  for (std::size_t i = 1; i < ports.element().children.size(); ++i) {
    node.own_scripts.push_back(
        ports.equality(how, "variable", fmt::format("case_{}", i)));
  }
}

template <PortType type>
constexpr std::array kLoop = {
    PortRow{"queue", kInOut, Any, Mandatory},
    PortRow{"if_empty", kIn, Status, Optional, "SUCCESS",
            "Status to return if queue is empty: "
            "SUCCESS, FAILURE, SKIPPED"},
    PortRow{"value", kOut, type}};
// "1;2;3" has three elements; a queue in an entry any number.
void read_loop(PortReader& ports, Node& node) {
  node.otherwise = ports.status("if_empty", NodeStatus::Success);
  const std::string queue = ports.text("queue");
  if (queue.starts_with("{") || queue.starts_with("json:")) {
    node.repetitions = kOpenRounds;
    return ports.leave_open(
        "its queue, which an entry holds, may be empty in each tick");
  }
  const auto separators = std::ranges::count(queue, ';');
  node.repetitions = queue.empty() ? 0 : static_cast<int>(separators + 1);
}
void read_loop_of_texts(PortReader& ports, Node& node) {
  const std::string queue = ports.text("queue");
  const bool is_literal = !queue.empty() && !queue.starts_with("{");
  if (is_literal && ports.is_in(releases::kReadsNoTexts)) {
    ports.refuse_unmodelled("queue", "a LoopString with a queue of its own");
  }
  read_loop(ports, node);
}

constexpr std::array kCheck = {PortRow{"value_A", kIn, Any, Mandatory},
                               PortRow{"value_B", kIn, Any, Mandatory},
                               PortRow{"return_on_mismatch", kIn, Status}};
template <PortComparison how>
void read_check(PortReader& ports, Node& node) {
  const bool is_exact =
      how == PortComparison::Double && ports.is_in(releases::kChecksExactly);
  node.otherwise = ports.status("return_on_mismatch", NodeStatus::Failure);
  node.own_scripts = {ports.equality(
      is_exact ? PortComparison::ExactDouble : how, "value_A", "value_B")};
}

// Rows. Those of inner nodes first.
constexpr NodeTypeRow control(std::string_view id, NodeType type,
                              std::span<const PortRow> ports = {},
                              ReadPorts read = nullptr,
                              int exact_children = 0) {
  return {id, BtcppKind::Control, type, ports, exact_children, {}, read};
}
constexpr NodeTypeRow decorator(std::string_view id, NodeType type,
                                std::span<const PortRow> ports = {},
                                ReadPorts read = nullptr) {
  return {id, BtcppKind::Decorator, type, ports, 0, {}, read};
}
constexpr NodeTypeRow subtree(std::string_view id,
                              std::span<const PortRow> ports = {}) {
  return {id, BtcppKind::SubTree, NodeType::SubTree, ports};
}
// Cases 1 to `count`, and a last child for all other values.
constexpr NodeTypeRow switch_of(std::string_view id, std::size_t count) {
  return control(id, NodeType::Switch, std::span(kSwitch).first(count + 1),
                 read_cases, static_cast<int>(count + 1));
}
constexpr NodeTypeRow since(int release, NodeTypeRow row) {
  row.since = release;
  return row;
}
constexpr NodeTypeRow as(BtcppKind kind, NodeTypeRow row) {
  row.kind = kind;
  return row;
}
constexpr NodeTypeRow with(KeyedEntry keyed, NodeTypeRow row) {
  row.keyed = keyed;
  return row;
}
constexpr NodeTypeRow open(std::string_view why, NodeTypeRow row) {
  row.left_open = why;
  return row;
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
                             NodeType type = NodeType::Action,
                             ReadPorts read = nullptr) {
  return {id, BtcppKind::Action, type, ports, 0, answers, read};
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

constexpr std::array kBothReleases = {
    control("Fallback", NodeType::Fallback),
    control("Sequence", NodeType::Sequence),
    control("ReactiveSequence", NodeType::ReactiveSequence),
    control("ReactiveFallback", NodeType::ReactiveFallback),
    control("IfThenElse", NodeType::IfThenElse),
    decorator("Inverter", NodeType::Inverter),
    since(releases::kMisspellsRetry.end,
          decorator("RetryUntilSuccessful", NodeType::RetryUntilSuccessful,
                    kRetry, read_rounds<kRetry>)),
    decorator("KeepRunningUntilFailure", NodeType::KeepRunningUntilFailure),
    decorator("Repeat", NodeType::Repeat, kRepeat, read_rounds<kRepeat>),
    decorator("Timeout", NodeType::Timeout, kTimeout,
              read_milliseconds<kTimeout>),
    since(30502, decorator("Delay", NodeType::Delay, kDelay, read_delay)),
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
    since(40200, control("AsyncFallback", NodeType::AsyncFallback)),
    since(40200, control("AsyncSequence", NodeType::AsyncSequence)),
    control("SequenceWithMemory", NodeType::SequenceWithMemory),
    control("Parallel", NodeType::Parallel, kParallel, read_parallel),
    since(40302, control("ParallelAll", NodeType::ParallelAll, kParallelAll,
                         read_parallel_all)),
    control("WhileDoElse", NodeType::WhileDoElse),
    since(40900, control("TryCatch", NodeType::TryCatch, kTryCatch,
                         read_option<kTryCatch>)),
    since(40200, decorator("RunOnce", NodeType::RunOnce, kRunOnce,
                           read_option<kRunOnce>)),
    decorator("Precondition", NodeType::Precondition, kPrecondition,
              read_precondition),
    action("Script", kSucceeds, kScript, NodeType::Script, read_script),
    since(40301, as(BtcppKind::Condition,
                    action("ScriptCondition", kAtOnce, kScriptCondition,
                           NodeType::Script, read_script_condition))),
    // Fails where the entry that is copied has no value; throws where there is
    // no such entry.
    with(KeyedEntry::IsSet, action("SetBlackboard", kAtOnce, kSetBlackboard,
                                   NodeType::Script, read_set_blackboard)),
    since(40403, with(KeyedEntry::IsUnset,
                      action("UnsetBlackboard", kSucceeds, kUnset,
                             NodeType::Script, read_unset_blackboard))),
    // Runs until its time is up; with no milliseconds it succeeds at once.
    since(40300, action("Sleep", {true, false, true, LeafMemory::Latched},
                        kSleep, NodeType::Wait, read_milliseconds<kSleep>)),
    since(40305, decorator("LoopInt", NodeType::Loop, kLoop<Int>, read_loop)),
    since(40305, decorator("LoopBool", NodeType::Loop, kLoop<Bool>, read_loop)),
    since(40200,
          decorator("LoopDouble", NodeType::Loop, kLoop<Double>, read_loop)),
    since(40200, decorator("LoopString", NodeType::Loop, kLoop<String>,
                           read_loop_of_texts)),
    // Remembers the last change it saw (`sequence_id_`) beyond a reset.
    since(40600,
          open(kMayBeUpdated, action("WasEntryUpdated", kAtOnce, kEntry))),
    since(40600,
          open(kMayBeUpdated,
               decorator("SkipUnlessUpdated", NodeType::WhenUpdated, kEntry,
                         read_when_updated<NodeStatus::Skipped>))),
    since(40600,
          open(kMayBeUpdated,
               decorator("WaitValueUpdate", NodeType::WhenUpdated, kEntry,
                         read_when_updated<NodeStatus::Running>)))};

constexpr std::array kOnlyVersion3 = {
    subtree("SubTree"),
    control("SequenceStar", NodeType::SequenceWithMemory),
    control("Parallel", NodeType::Parallel, kOldParallel, read_parallel),
    control("WhileDoElse", NodeType::WhileDoElse, {}, nullptr, 3),
    subtree("SubTreePlus"),
    with(KeyedEntry::IsSet, action("SetBlackboard", kSucceeds, kSetBlackboard,
                                   NodeType::Script, read_set_blackboard)),
    decorator("BlackboardCheckInt", NodeType::BlackboardCheck, kCheck,
              read_check<PortComparison::Int>),
    decorator("BlackboardCheckDouble", NodeType::BlackboardCheck, kCheck,
              read_check<PortComparison::Double>),
    decorator("BlackboardCheckString", NodeType::BlackboardCheck, kCheck,
              read_check<PortComparison::Text>),
    since(30601, decorator("BlackboardCheckBool", NodeType::BlackboardCheck,
                           kCheck, read_check<PortComparison::Bool>))};

constexpr std::array kRecovery = {PortRow{"number_of_retries", kIn, Int}};
void read_recovery(PortReader& ports, Node& node) {
  // Read into an unsigned number: what does not fit is silently 1.
  const int retries = ports.known_number("number_of_retries", 1);
  node.repetitions = retries < 0 ? 1 : retries;
}

constexpr std::array kRoundRobin = {PortRow{"wrap_around", kIn, Bool}};
void read_round_robin(PortReader& ports, Node& node) {
  node.option =
      wraps_round(ports.profile()) || ports.flag("wrap_around", false);
}

constexpr std::array kPersistent = {
    PortRow{"current_child_idx", kInOut, Int, Mandatory}};
constexpr std::array kRate = {PortRow{"hz", kIn, Double}};
void read_rate(PortReader& ports, Node& node) {
  node.duration = ports.period("hz");
}

constexpr std::array kDistance = {PortRow{"distance", kIn, Double}};
constexpr std::array kSpeed = {
    PortRow{"min_rate", kIn, Double}, PortRow{"max_rate", kIn, Double},
    PortRow{"min_speed", kIn, Double}, PortRow{"max_speed", kIn, Double}};
constexpr std::string_view kMayBeDue = "its child may be due in each tick";
void read_when_due(PortReader&, Node& node) { node.contract.may_fail = false; }
void read_speed(PortReader& ports, Node& node) {
  read_when_due(ports, node);
  node.option = keeps_speed_period(ports.profile());
}

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

// btcheck/observer.hpp: the verdict of a rule while the tree runs, which stays
// once it is there. A program may have a type of its own of that name: without
// the port it is no such node.
constexpr std::array kVerdictPorts = {PortRow{"rule", kIn, String, Mandatory},
                                      PortRow{"is", kIn, String}};
void read_verdict(PortReader& ports, Node& node) {
  const std::string is = ports.text("is");
  const bool stays =
      is.empty() || is == "violated" || is == "satisfied" || is == "excluded";
  if (!stays) node.contract.memory = LeafMemory::None;
}
constexpr std::array kObserver = {
    NodeTypeRow{"Verdict",
                BtcppKind::Condition,
                NodeType::Condition,
                kVerdictPorts,
                0,
                {true, true, false, LeafMemory::SuccessStays},
                read_verdict}};

constexpr std::array kNav2 = {
    control("RecoveryNode", NodeType::Recovery, kRecovery, read_recovery),
    control("PipelineSequence", NodeType::PipelineSequence),
    control("RoundRobin", NodeType::RoundRobin, kRoundRobin, read_round_robin),
    in(kFromLyrical,
       control("NonblockingSequence", NodeType::NonblockingSequence)),
    in(kFromLyrical,
       open("its index, which an entry holds, may be any in each tick",
            control("PersistentSequence", NodeType::PersistentSequence,
                    kPersistent))),
    in(kFromLyrical,
       open("it may be asked to pause and to resume before each tick",
            control("PauseResumeController", NodeType::PauseResumeController))),
    decorator("RateController", NodeType::RateController, kRate, read_rate),
    open(kMayBeDue,
         decorator("DistanceController", NodeType::WhenDue, kDistance)),
    open(kMayBeDue,
         decorator("SpeedController", NodeType::WhenDue, kSpeed, read_speed)),
    open(kMayBeDue, decorator("GoalUpdatedController", NodeType::WhenDue, {},
                              read_when_due)),
    open("what it writes is not known",
         decorator("GoalUpdater", NodeType::GoalUpdater)),
    in(kFromHumble, open("the path may have become longer in each tick",
                         decorator("PathLongerOnApproach",
                                   NodeType::PathLongerOnApproach, kApproach))),
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
    in(kKilted, as(BtcppKind::Condition, action("IsStopped", kRestarting))),
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

// Of the user's program.
struct KindRow {
  BtcppKind kind;
  NodeType type;
};
constexpr std::array kOfKind = {
    KindRow{BtcppKind::Action, NodeType::Action},
    KindRow{BtcppKind::Condition, NodeType::Condition},
    KindRow{BtcppKind::Control, NodeType::OtherControl},
    KindRow{BtcppKind::Decorator, NodeType::OtherDecorator},
    KindRow{BtcppKind::SubTree, NodeType::SubTree}};
static_assert(is_indexed(kOfKind, &KindRow::kind));
static_assert(are_all_types(In::Btcpp,
                            {kBothReleases, kOnlyVersion4, kOnlyVersion3,
                             kNav2},
                            {NodeType::BehaviorTree, NodeType::OtherControl,
                             NodeType::OtherDecorator}));

struct BranchRow {
  Nav2Branch branch;
  Profile profile;
};
// What nobody has named is main rather than lyrical.
constexpr std::array kBranches = {
    BranchRow{Nav2Branch::Galactic, Profile::Nav2Galactic},
    BranchRow{Nav2Branch::Humble, Profile::Nav2Humble},
    BranchRow{Nav2Branch::Iron, Profile::Nav2Iron},
    BranchRow{Nav2Branch::Jazzy, Profile::Nav2Jazzy},
    BranchRow{Nav2Branch::Kilted, Profile::Nav2Kilted},
    BranchRow{Nav2Branch::Lyrical, Profile::Nav2Main}};
static_assert(is_indexed(kBranches, &BranchRow::branch));

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
      return py_trees_types();
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

bool PortReader::flag(std::string_view name, bool otherwise) const {
  const auto value = port(name);
  return value ? parse_bool(*value).value_or(otherwise) : otherwise;
}

NodeStatus PortReader::status(std::string_view name,
                              NodeStatus otherwise) const {
  const std::string value = text(name);
  if (value == "SUCCESS") return NodeStatus::Success;
  if (value == "FAILURE") return NodeStatus::Failure;
  if (value == "RUNNING") return NodeStatus::Running;
  if (value == "SKIPPED") return NodeStatus::Skipped;
  return otherwise;
}

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

KeyedEntry keyed_by(BtcppRelease release, std::string_view id) {
  const NodeTypeRow* row = builtin_type(release, id);
  return row != nullptr ? row->keyed : KeyedEntry::None;
}

const NodeTypeRow* nav2_type(std::string_view id) { return row_of(kNav2, id); }

std::span<const NodeTypeRow> nav2_types() { return kNav2; }

const NodeTypeRow* observer_type(const BtcppNode& node) {
  const bool is_asking = find_attribute(node.ports, "rule") != nullptr;
  return is_asking ? row_of(kObserver, node.id) : nullptr;
}

const NodeTypeRow* known_type(BtcppRelease release, std::string_view id) {
  const NodeTypeRow* row = builtin_type(release, id);
  if (row != nullptr || release == BtcppRelease::PyTrees) return row;
  return nav2_type(id);
}

const NodeTypeRow* known_type(BtcppRelease release, const BtcppNode& node) {
  const NodeTypeRow* row = known_type(release, node.id);
  if (row != nullptr || release == BtcppRelease::PyTrees) return row;
  return observer_type(node);
}

BtcppRelease dialect_of(Profile profile) {
  if (profile == Profile::PyTrees) return BtcppRelease::PyTrees;
  return is_release_3(profile) ? BtcppRelease::V3 : BtcppRelease::V4;
}

Profile profile_of_branch(Nav2Branch branch) {
  return kBranches[static_cast<std::size_t>(branch)].profile;
}

Nav2Branch branch_of(Profile profile) {
  const auto row = std::ranges::find(kBranches, profile, &BranchRow::profile);
  return row == kBranches.end() ? Nav2Branch::Lyrical : row->branch;
}

std::vector<std::string> builtin_names(BtcppRelease release) {
  std::vector<std::string> names;
  for (const auto& row : shared_in(release)) names.emplace_back(row.id);
  for (const auto& row : only_in(release)) names.emplace_back(row.id);
  return names;
}

int first_release(std::string_view id) {
  const NodeTypeRow* row = builtin_type(BtcppRelease::V4, id);
  if (row == nullptr) row = builtin_type(BtcppRelease::V3, id);
  return row != nullptr ? row->since : 0;
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

const NodeTypeRow* engine_row(BtcppRelease release, const BtcppNode& node) {
  const bool is_of_py_trees = release == BtcppRelease::PyTrees;
  // One of the project's own, whatever a later release calls so.
  const bool is_own =
      release == BtcppRelease::V3 && first_release(node.id) > kNewestRelease3;
  if (is_own || node.kind == BtcppKind::SubTree) return nullptr;
  const NodeTypeRow* row =
      known_type(is_of_py_trees ? release : BtcppRelease::V4, node);
  if (row == nullptr && !is_of_py_trees) row = row_of(kOnlyVersion3, node.id);
  if (row == nullptr) return nullptr;
  // A model may make an Action or a Condition of a leaf of Nav2. A condition
  // that may run is an Action to all but its author.
  const bool is_plain =
      std::ranges::find(kOfKind, row->type, &KindRow::type) != kOfKind.end();
  return is_plain && row->kind != node.kind ? nullptr : row;
}

NodeType engine_type(BtcppRelease release, const BtcppNode& node) {
  const NodeTypeRow* row = engine_row(release, node);
  return row != nullptr ? row->type
                        : kOfKind[static_cast<std::size_t>(node.kind)].type;
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
  if (type == nullptr) type = known_type(document.release, node);
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
