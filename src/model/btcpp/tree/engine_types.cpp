// SPDX-License-Identifier: MIT
#include "model/btcpp/tree/engine_types.hpp"
#include "model/tree/node_types.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace btcheck::btcpp {
namespace {

struct TypeOfId {
  std::string_view id;
  NodeType type;
};
constexpr auto kTypes = std::to_array<TypeOfId>({
    {"Sequence", NodeType::Sequence},
    {"Fallback", NodeType::Fallback},
    {"AsyncSequence", NodeType::AsyncSequence},
    {"AsyncFallback", NodeType::AsyncFallback},
    {"SequenceWithMemory", NodeType::SequenceWithMemory},
    {"SequenceStar", NodeType::SequenceWithMemory},
    {"ReactiveSequence", NodeType::ReactiveSequence},
    {"ReactiveFallback", NodeType::ReactiveFallback},
    {"Parallel", NodeType::Parallel},
    {"ParallelAll", NodeType::ParallelAll},
    {"IfThenElse", NodeType::IfThenElse},
    {"WhileDoElse", NodeType::WhileDoElse},
    {"Switch2", NodeType::Switch},
    {"Switch3", NodeType::Switch},
    {"Switch4", NodeType::Switch},
    {"Switch5", NodeType::Switch},
    {"Switch6", NodeType::Switch},
    {"TryCatch", NodeType::TryCatch},
    {"Inverter", NodeType::Inverter},
    {"ForceSuccess", NodeType::ForceSuccess},
    {"ForceFailure", NodeType::ForceFailure},
    {"Repeat", NodeType::Repeat},
    {"RetryUntilSuccessful", NodeType::RetryUntilSuccessful},
    {"KeepRunningUntilFailure", NodeType::KeepRunningUntilFailure},
    {"Timeout", NodeType::Timeout},
    {"Delay", NodeType::Delay},
    {"RunOnce", NodeType::RunOnce},
    {"Precondition", NodeType::Precondition},
    {"LoopInt", NodeType::Loop},
    {"LoopBool", NodeType::Loop},
    {"LoopDouble", NodeType::Loop},
    {"LoopString", NodeType::Loop},
    {"SkipUnlessUpdated", NodeType::WhenUpdated},
    {"WaitValueUpdate", NodeType::WhenUpdated},
    {"BlackboardCheckInt", NodeType::BlackboardCheck},
    {"BlackboardCheckDouble", NodeType::BlackboardCheck},
    {"BlackboardCheckString", NodeType::BlackboardCheck},
    {"BlackboardCheckBool", NodeType::BlackboardCheck},
    {"Script", NodeType::Script},
    {"ScriptCondition", NodeType::Script},
    {"SetBlackboard", NodeType::Script},
    {"UnsetBlackboard", NodeType::Script},
    {"Sleep", NodeType::Wait},
    {"RecoveryNode", NodeType::Recovery},
    {"PipelineSequence", NodeType::PipelineSequence},
    {"RoundRobin", NodeType::RoundRobin},
    {"NonblockingSequence", NodeType::NonblockingSequence},
    {"PersistentSequence", NodeType::PersistentSequence},
    {"PauseResumeController", NodeType::PauseResumeController},
    {"RateController", NodeType::RateController},
    {"DistanceController", NodeType::WhenDue},
    {"SpeedController", NodeType::WhenDue},
    {"GoalUpdatedController", NodeType::WhenDue},
    {"GoalUpdater", NodeType::GoalUpdater},
    {"PathLongerOnApproach", NodeType::PathLongerOnApproach},
    {"SingleTrigger", NodeType::SingleTrigger},
});

}  // namespace

NodeType engine_type(const BtcppNode& node) {
  if (node.kind == BtcppKind::SubTree) return NodeType::SubTree;
  const auto found =
      std::find_if(kTypes.begin(), kTypes.end(),
                   [&](const TypeOfId& row) { return row.id == node.id; });
  if (found != kTypes.end()) return found->type;
  switch (node.kind) {
    case BtcppKind::Condition:
      return NodeType::Condition;
    case BtcppKind::Control:
      return NodeType::OtherControl;
    case BtcppKind::Decorator:
      return NodeType::OtherDecorator;
    default:
      return NodeType::Action;
  }
}

}  // namespace btcheck::btcpp
