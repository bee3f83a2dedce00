// SPDX-License-Identifier: MIT
#include "model/tree/node_types.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace btcheck {

namespace {

// A row without one of its columns does not compile.
constexpr std::array<NodeTypeInfo, kNodeTypeCount> kTypes = {{
    {NodeType::BehaviorTree, "BehaviorTree", In::Both, 1, 1, Flow::AsChild,
     Beside::Any, Ended::None, Skips::Some, ""},
    {NodeType::Sequence, "Sequence", In::Both, 1, kAnyNumber, Flow::OnSuccess,
     Beside::None, Ended::None, Skips::AllOrCounting, "→"},
    {NodeType::Fallback, "Fallback", In::Both, 1, kAnyNumber, Flow::OnFailure,
     Beside::None, Ended::None, Skips::AllOrCounting, "?"},
    {NodeType::SequenceWithMemory, "SequenceWithMemory", In::Both, 1,
     kAnyNumber, Flow::OnSuccess, Beside::None, Ended::None,
     Skips::AllOrCounting, "→"},
    {NodeType::ReactiveSequence, "ReactiveSequence", In::Both, 1, kAnyNumber,
     Flow::OnSuccess, Beside::TheLeft, Ended::None, Skips::All, "→"},
    {NodeType::ReactiveFallback, "ReactiveFallback", In::Both, 1, kAnyNumber,
     Flow::OnFailure, Beside::TheLeft, Ended::None, Skips::All, "?"},
    {NodeType::Parallel, "Parallel", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::Counted, Ended::None, Skips::All, "⇉"},
    {NodeType::ParallelAll, "ParallelAll", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::Counted, Ended::None, Skips::All, "⇉"},
    {NodeType::Inverter, "Inverter", In::Both, 1, 1, Flow::Inverts, Beside::Any,
     Ended::None, Skips::Some, ""},
    {NodeType::ForceSuccess, "ForceSuccess", In::Both, 1, 1, Flow::Succeeds,
     Beside::Any, Ended::None, Skips::Some, ""},
    {NodeType::ForceFailure, "ForceFailure", In::Both, 1, 1, Flow::Fails,
     Beside::Any, Ended::None, Skips::Some, ""},
    {NodeType::KeepRunningUntilFailure, "KeepRunningUntilFailure", In::Both, 1,
     1, Flow::UntilFailure, Beside::Any, Ended::None, Skips::Never, ""},
    {NodeType::Repeat, "Repeat", In::Both, 1, 1, Flow::Repeats, Beside::Any,
     Ended::None, Skips::Some, ""},
    {NodeType::RetryUntilSuccessful, "RetryUntilSuccessful", In::Both, 1, 1,
     Flow::Retries, Beside::Any, Ended::None, Skips::Some, ""},
    {NodeType::RateController, "RateController", In::Both, 1, 1, Flow::AsChild,
     Beside::Any, Ended::None, Skips::Some, ""},
    {NodeType::Recovery, "Recovery", In::Both, 2, 2, Flow::Recovers,
     Beside::None, Ended::None, Skips::First, "?"},
    {NodeType::RoundRobin, "RoundRobin", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::None, Ended::All, Skips::All, "↻"},
    {NodeType::PipelineSequence, "PipelineSequence", In::Both, 1, kAnyNumber,
     Flow::OnSuccess, Beside::TheLeft, Ended::All, Skips::All, "→"},
    {NodeType::SubTree, "SubTree", In::Both, 1, 1, Flow::AsChild, Beside::Any,
     Ended::None, Skips::Some, ""},
    {NodeType::Action, "Action", In::Both, 0, 0, Flow::Leaf, Beside::Any,
     Ended::None, Skips::AsContract, ""},
    {NodeType::Condition, "Condition", In::Both, 0, 0, Flow::Leaf, Beside::Any,
     Ended::None, Skips::AsContract, ""},
    {NodeType::SetSV, "SetSV", In::Btf, 0, 0, Flow::Leaf, Beside::Any,
     Ended::None, Skips::Never, ""},
    {NodeType::Eval, "Eval", In::Btf, 0, 0, Flow::Leaf, Beside::Any,
     Ended::None, Skips::Never, ""},
    {NodeType::Wait, "Wait", In::Both, 0, 0, Flow::Leaf, Beside::Any,
     Ended::None, Skips::Never, ""},
    {NodeType::AsyncSequence, "AsyncSequence", In::Xml, 1, kAnyNumber,
     Flow::OnSuccess, Beside::None, Ended::None, Skips::AllOrCounting, "→"},
    {NodeType::AsyncFallback, "AsyncFallback", In::Xml, 1, kAnyNumber,
     Flow::OnFailure, Beside::None, Ended::None, Skips::AllOrCounting, "?"},
    {NodeType::IfThenElse, "IfThenElse", In::Xml, 2, 3, Flow::Chooses,
     Beside::None, Ended::FirstOfTwo, Skips::SomeBranch, "◇"},
    {NodeType::WhileDoElse, "WhileDoElse", In::Xml, 2, 3, Flow::Chooses,
     Beside::TheLeft, Ended::First, Skips::SomeBranch, "◇"},
    {NodeType::Switch, "Switch", In::Xml, 1, kAnyNumber, Flow::Cases,
     Beside::Any, Ended::None, Skips::Some, "◇"},
    {NodeType::TryCatch, "TryCatch", In::Xml, 2, kAnyNumber, Flow::Tries,
     Beside::None, Ended::None, Skips::AllTried, "?"},
    {NodeType::NonblockingSequence, "NonblockingSequence", In::Xml, 1,
     kAnyNumber, Flow::Any, Beside::Any, Ended::All, Skips::Never, "⇉"},
    {NodeType::PersistentSequence, "PersistentSequence", In::Xml, 1, kAnyNumber,
     Flow::Any, Beside::Any, Ended::All, Skips::Never, "→"},
    {NodeType::PauseResumeController, "PauseResumeController", In::Xml, 1, 4,
     Flow::Any, Beside::Any, Ended::All, Skips::Never, "◇"},
    {NodeType::OtherControl, "Control", In::Xml, 1, kAnyNumber, Flow::Any,
     Beside::Any, Ended::All, Skips::Never, ""},
    {NodeType::Precondition, "Precondition", In::Xml, 1, 1, Flow::Any,
     Beside::Any, Ended::None, Skips::SomeOrOtherwise, ""},
    {NodeType::Timeout, "Timeout", In::Xml, 1, 1, Flow::Any, Beside::Any,
     Ended::None, Skips::Some, ""},
    {NodeType::Delay, "Delay", In::Xml, 1, 1, Flow::AsChild, Beside::Any,
     Ended::None, Skips::Some, ""},
    {NodeType::RunOnce, "RunOnce", In::Xml, 1, 1, Flow::AsChild, Beside::Any,
     Ended::None, Skips::SomeOrOption, ""},
    {NodeType::Loop, "Loop", In::Xml, 1, 1, Flow::Any, Beside::Any, Ended::None,
     Skips::SomeOrOtherwise, ""},
    {NodeType::WhenUpdated, "WhenUpdated", In::Xml, 1, 1, Flow::Any,
     Beside::Any, Ended::None, Skips::SomeOrOtherwise, ""},
    {NodeType::WhenDue, "WhenDue", In::Xml, 1, 1, Flow::Any, Beside::Any,
     Ended::None, Skips::Some, ""},
    {NodeType::GoalUpdater, "GoalUpdater", In::Xml, 1, 1, Flow::AsChild,
     Beside::Any, Ended::None, Skips::Some, ""},
    {NodeType::PathLongerOnApproach, "PathLongerOnApproach", In::Xml, 1, 1,
     Flow::Any, Beside::Any, Ended::None, Skips::Some, ""},
    {NodeType::SingleTrigger, "SingleTrigger", In::Xml, 1, 1, Flow::Any,
     Beside::Any, Ended::None, Skips::Some, ""},
    {NodeType::BlackboardCheck, "BlackboardCheck", In::Xml, 1, 1, Flow::Any,
     Beside::Any, Ended::None, Skips::SomeOrOtherwise, ""},
    {NodeType::OtherDecorator, "Decorator", In::Xml, 1, 1, Flow::Any,
     Beside::Any, Ended::None, Skips::Never, ""},
    {NodeType::Script, "Script", In::Xml, 0, 0, Flow::Leaf, Beside::Any,
     Ended::None, Skips::Never, ""},
}};

std::vector<NodeTypeInfo> types_of_btf() {
  std::vector<NodeTypeInfo> found;
  std::copy_if(kTypes.begin(), kTypes.end(), std::back_inserter(found),
               [](const NodeTypeInfo& info) { return info.in != In::Xml; });
  return found;
}

}  // namespace

std::span<const NodeTypeInfo, kNodeTypeCount> node_types() { return kTypes; }

const std::vector<NodeTypeInfo>& btf_node_types() {
  static const std::vector<NodeTypeInfo> found = types_of_btf();
  return found;
}

const NodeTypeInfo& info_of(NodeType type) {
  return kTypes[static_cast<std::size_t>(type)];
}

std::string_view type_name(NodeType type) { return info_of(type).name; }

bool is_leaf(NodeType type) { return info_of(type).max_children == 0; }

}  // namespace btcheck
