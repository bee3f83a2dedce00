// SPDX-License-Identifier: MIT
#include "model/tree/node_types.hpp"

#include <array>

namespace btcheck {

std::span<const NodeTypeInfo, kNodeTypeCount> node_types() {
  static constexpr std::array<NodeTypeInfo, kNodeTypeCount> kTypes = {{
      {NodeType::BehaviorTree, "BehaviorTree", 1, 1},
      {NodeType::Sequence, "Sequence", 1, kAnyNumber, Beside::None, "→"},
      {NodeType::Fallback, "Fallback", 1, kAnyNumber, Beside::None, "?"},
      {NodeType::SequenceWithMemory, "SequenceWithMemory", 1, kAnyNumber,
       Beside::None, "→"},
      {NodeType::ReactiveSequence, "ReactiveSequence", 1, kAnyNumber,
       Beside::TheLeft, "→"},
      {NodeType::ReactiveFallback, "ReactiveFallback", 1, kAnyNumber,
       Beside::TheLeft, "?"},
      {NodeType::Parallel, "Parallel", 1, kAnyNumber, Beside::Any, "⇉"},
      {NodeType::ParallelAll, "ParallelAll", 1, kAnyNumber, Beside::Any, "⇉"},
      {NodeType::Inverter, "Inverter", 1, 1},
      {NodeType::ForceSuccess, "ForceSuccess", 1, 1},
      {NodeType::ForceFailure, "ForceFailure", 1, 1},
      {NodeType::KeepRunningUntilFailure, "KeepRunningUntilFailure", 1, 1},
      {NodeType::Repeat, "Repeat", 1, 1},
      {NodeType::RetryUntilSuccessful, "RetryUntilSuccessful", 1, 1},
      {NodeType::RateController, "RateController", 1, 1},
      {NodeType::Recovery, "Recovery", 2, 2, Beside::None, "?"},
      {NodeType::RoundRobin, "RoundRobin", 1, kAnyNumber, Beside::None, "↻"},
      {NodeType::PipelineSequence, "PipelineSequence", 1, kAnyNumber,
       Beside::TheLeft, "→"},
      {NodeType::SubTree, "SubTree", 1, 1},
      {NodeType::Action, "Action", 0, 0},
      {NodeType::Condition, "Condition", 0, 0},
      {NodeType::SetSV, "SetSV", 0, 0},
      {NodeType::Eval, "Eval", 0, 0},
      {NodeType::Wait, "Wait", 0, 0},
      {NodeType::AsyncSequence, "AsyncSequence", 1, kAnyNumber, Beside::None,
       "→"},
      {NodeType::AsyncFallback, "AsyncFallback", 1, kAnyNumber, Beside::None,
       "?"},
      {NodeType::IfThenElse, "IfThenElse", 2, 3, Beside::None, "◇"},
      {NodeType::WhileDoElse, "WhileDoElse", 2, 3, Beside::TheLeft, "◇"},
      {NodeType::Switch, "Switch", 1, kAnyNumber, Beside::Any, "◇"},
      {NodeType::TryCatch, "TryCatch", 2, kAnyNumber, Beside::None, "?"},
      {NodeType::NonblockingSequence, "NonblockingSequence", 1, kAnyNumber,
       Beside::Any, "⇉"},
      {NodeType::PersistentSequence, "PersistentSequence", 1, kAnyNumber,
       Beside::Any, "→"},
      {NodeType::PauseResumeController, "PauseResumeController", 1, 4,
       Beside::Any, "◇"},
      {NodeType::OtherControl, "Control", 1, kAnyNumber},
      {NodeType::Precondition, "Precondition", 1, 1},
      {NodeType::Timeout, "Timeout", 1, 1},
      {NodeType::Delay, "Delay", 1, 1},
      {NodeType::RunOnce, "RunOnce", 1, 1},
      {NodeType::Loop, "Loop", 1, 1},
      {NodeType::WhenUpdated, "WhenUpdated", 1, 1},
      {NodeType::WhenDue, "WhenDue", 1, 1},
      {NodeType::GoalUpdater, "GoalUpdater", 1, 1},
      {NodeType::PathLongerOnApproach, "PathLongerOnApproach", 1, 1},
      {NodeType::SingleTrigger, "SingleTrigger", 1, 1},
      {NodeType::BlackboardCheck, "BlackboardCheck", 1, 1},
      {NodeType::OtherDecorator, "Decorator", 1, 1},
      {NodeType::Script, "Script", 0, 0},
  }};
  return kTypes;
}

std::span<const NodeTypeInfo, kBtfTypeCount> btf_node_types() {
  return node_types().first<kBtfTypeCount>();
}

std::string_view type_name(NodeType type) {
  return node_types()[static_cast<std::size_t>(type)].name;
}

Beside ticked_beside(NodeType type) {
  return node_types()[static_cast<std::size_t>(type)].beside;
}

bool is_leaf(NodeType type) {
  return node_types()[static_cast<std::size_t>(type)].max_children == 0;
}

}  // namespace btcheck
