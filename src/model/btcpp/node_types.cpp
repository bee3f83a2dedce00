// SPDX-License-Identifier: MIT
#include "model/btcpp/node_types.hpp"

#include <algorithm>
#include <array>

#include "model/btcpp/leaf_types.hpp"

namespace btcheck::btcpp {
namespace {

using enum BtcppKind;
using enum PortType;
using enum Need;
constexpr auto kIn = BtcppDirection::Input;
constexpr auto kOut = BtcppDirection::Output;
constexpr auto kInOut = BtcppDirection::InOut;
constexpr int kMany = kManyChildren;

constexpr std::array kSubTree = {
    PortRow{"_autoremap", kIn, Bool, Optional, "false",
            "If true, all the ports with the same name will be remapped"}};
constexpr std::array kParallel = {
    PortRow{"success_count", kIn, Int, Optional, "-1",
            "number of children that need to succeed to trigger a SUCCESS"},
    PortRow{"failure_count", kIn, Int, Optional, "1",
            "number of children that need to fail to trigger a FAILURE"}};
constexpr std::array kOldParallel = {
    PortRow{"success_threshold", kIn, Int, Mandatory},
    PortRow{"failure_threshold", kIn, Int}};
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

// `variable` and so many cases.
constexpr std::span<const PortRow> cases(std::size_t count) {
  return std::span(kSwitch).first(count + 1);
}

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

constexpr std::array kBothReleases = {
    NodeTypeRow{"Fallback", Control, 1, kMany, {}},
    NodeTypeRow{"Sequence", Control, 1, kMany, {}},
    NodeTypeRow{"ReactiveSequence", Control, 1, kMany, {}},
    NodeTypeRow{"ReactiveFallback", Control, 1, kMany, {}},
    NodeTypeRow{"IfThenElse", Control, 2, 3, {}},
    NodeTypeRow{"Inverter", Decorator, 1, 1, {}},
    NodeTypeRow{"RetryUntilSuccessful", Decorator, 1, 1, kRetry},
    NodeTypeRow{"KeepRunningUntilFailure", Decorator, 1, 1, {}},
    NodeTypeRow{"Repeat", Decorator, 1, 1, kRepeat},
    NodeTypeRow{"Timeout", Decorator, 1, 1, kTimeout},
    NodeTypeRow{"Delay", Decorator, 1, 1, kDelay},
    NodeTypeRow{"ForceSuccess", Decorator, 1, 1, {}},
    NodeTypeRow{"ForceFailure", Decorator, 1, 1, {}},
    NodeTypeRow{"AlwaysSuccess", Action, 0, 0, {}},
    NodeTypeRow{"AlwaysFailure", Action, 0, 0, {}},
    NodeTypeRow{"SetBlackboard", Action, 0, 0, kSetBlackboard},
    NodeTypeRow{"Switch2", Control, 3, 3, cases(2)},
    NodeTypeRow{"Switch3", Control, 4, 4, cases(3)},
    NodeTypeRow{"Switch4", Control, 5, 5, cases(4)},
    NodeTypeRow{"Switch5", Control, 6, 6, cases(5)},
    NodeTypeRow{"Switch6", Control, 7, 7, cases(6)}};

constexpr std::array kOnlyVersion4 = {
    NodeTypeRow{"SubTree", SubTree, 0, 0, kSubTree},
    NodeTypeRow{"AsyncFallback", Control, 1, kMany, {}},
    NodeTypeRow{"AsyncSequence", Control, 1, kMany, {}},
    NodeTypeRow{"SequenceWithMemory", Control, 1, kMany, {}},
    NodeTypeRow{"Parallel", Control, 1, kMany, kParallel},
    NodeTypeRow{"ParallelAll", Control, 1, kMany, kParallelAll},
    NodeTypeRow{"WhileDoElse", Control, 2, 3, {}},
    NodeTypeRow{"TryCatch", Control, 2, kMany, kTryCatch},
    NodeTypeRow{"RunOnce", Decorator, 1, 1, kRunOnce},
    NodeTypeRow{"Precondition", Decorator, 1, 1, kPrecondition},
    NodeTypeRow{"Script", Action, 0, 0, kScript},
    NodeTypeRow{"ScriptCondition", Condition, 0, 0, kScriptCondition},
    NodeTypeRow{"Sleep", Action, 0, 0, kSleep},
    NodeTypeRow{"UnsetBlackboard", Action, 0, 0, kUnset},
    NodeTypeRow{"LoopInt", Decorator, 1, 1, kLoop<Int>},
    NodeTypeRow{"LoopBool", Decorator, 1, 1, kLoop<Bool>},
    NodeTypeRow{"LoopDouble", Decorator, 1, 1, kLoop<Double>},
    NodeTypeRow{"LoopString", Decorator, 1, 1, kLoop<String>},
    NodeTypeRow{"WasEntryUpdated", Action, 0, 0, kEntry},
    NodeTypeRow{"SkipUnlessUpdated", Decorator, 1, 1, kEntry},
    NodeTypeRow{"WaitValueUpdate", Decorator, 1, 1, kEntry}};

constexpr std::array kOnlyVersion3 = {
    NodeTypeRow{"SubTree", SubTree, 0, 0, {}},
    NodeTypeRow{"SequenceStar", Control, 1, kMany, {}},
    NodeTypeRow{"Parallel", Control, 1, kMany, kOldParallel},
    NodeTypeRow{"WhileDoElse", Control, 3, 3, {}},
    NodeTypeRow{"SubTreePlus", SubTree, 0, 0, {}},
    NodeTypeRow{"BlackboardCheckInt", Decorator, 1, 1, kCheck},
    NodeTypeRow{"BlackboardCheckDouble", Decorator, 1, 1, kCheck},
    NodeTypeRow{"BlackboardCheckString", Decorator, 1, 1, kCheck},
    NodeTypeRow{"BlackboardCheckBool", Decorator, 1, 1, kCheck}};

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

constexpr std::array kNav2 = {
    NodeTypeRow{"RecoveryNode", Control, 2, 2, kRecovery},
    NodeTypeRow{"PipelineSequence", Control, 1, kMany, {}},
    NodeTypeRow{"RoundRobin", Control, 1, kMany, kRoundRobin},
    NodeTypeRow{"NonblockingSequence", Control, 1, kMany, {}},
    NodeTypeRow{"PersistentSequence", Control, 1, kMany, kPersistent},
    NodeTypeRow{"PauseResumeController", Control, 1, 4, {}},
    NodeTypeRow{"RateController", Decorator, 1, 1, kRate},
    NodeTypeRow{"DistanceController", Decorator, 1, 1, kDistance},
    NodeTypeRow{"SpeedController", Decorator, 1, 1, kSpeed},
    NodeTypeRow{"GoalUpdatedController", Decorator, 1, 1, {}},
    NodeTypeRow{"GoalUpdater", Decorator, 1, 1, {}},
    NodeTypeRow{"PathLongerOnApproach", Decorator, 1, 1, kApproach},
    NodeTypeRow{"SingleTrigger", Decorator, 1, 1, {}}};

const NodeTypeRow* row_of(std::span<const NodeTypeRow> rows,
                          std::string_view id) {
  const auto found = std::find_if(
      rows.begin(), rows.end(), [&](const auto& row) { return row.id == id; });
  return found == rows.end() ? nullptr : &*found;
}

std::span<const NodeTypeRow> only_in(BtcppRelease release) {
  if (release == BtcppRelease::V4) return kOnlyVersion4;
  return kOnlyVersion3;
}

std::vector<NodeTypeRow> rows_of_leaves() {
  std::vector<NodeTypeRow> rows;
  for (const LeafTypeRow& leaf : nav2_leaves())
    rows.push_back({leaf.id, leaf.kind, 0, 0, {}});
  return rows;
}

}  // namespace

std::string_view port_type_name(PortType type) {
  constexpr std::array<std::string_view, 8> kNames = {
      "any",    "int",    "unsigned int", "bool",
      "double", "string", "NodeStatus",   "script"};
  return kNames[static_cast<std::size_t>(type)];
}

const NodeTypeRow* builtin_type(BtcppRelease release, std::string_view id) {
  const NodeTypeRow* row = row_of(kBothReleases, id);
  return row != nullptr ? row : row_of(only_in(release), id);
}

const NodeTypeRow* nav2_type(std::string_view id) {
  static const std::vector<NodeTypeRow> leaves = rows_of_leaves();
  const NodeTypeRow* row = row_of(kNav2, id);
  return row != nullptr ? row : row_of(leaves, id);
}

const NodeTypeRow* known_type(BtcppRelease release, std::string_view id) {
  const NodeTypeRow* row = builtin_type(release, id);
  return row != nullptr ? row : nav2_type(id);
}

std::vector<std::string> builtin_names(BtcppRelease release) {
  std::vector<std::string> names;
  for (const auto& row : kBothReleases) names.emplace_back(row.id);
  for (const auto& row : only_in(release)) names.emplace_back(row.id);
  return names;
}

const PortRow* port_of(const NodeTypeRow& type, std::string_view name) {
  const auto found =
      std::find_if(type.ports.begin(), type.ports.end(),
                   [&](const PortRow& port) { return port.name == name; });
  return found == type.ports.end() ? nullptr : &*found;
}

std::string_view renamed_type(BtcppRelease release, std::string_view id) {
  if (release == BtcppRelease::V3) return {};
  if (id == "SubTreePlus") return "SubTree";
  if (id == "SequenceStar") return "SequenceWithMemory";
  if (id.starts_with("BlackboardCheck")) return "Precondition";
  return {};
}

}  // namespace btcheck::btcpp
