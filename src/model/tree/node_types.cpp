// SPDX-License-Identifier: MIT
#include "model/tree/node_types.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace btcheck {

namespace {

constexpr NodeTypeInfo leaf(NodeType type, std::string_view name, In in,
                            Skips skips, SetsRunning sets_running) {
  return {type,        name,  in,           0, 0, Flow::Leaf, Beside::Any,
          Ended::None, skips, sets_running, ""};
}

constexpr NodeTypeInfo decorator(NodeType type, std::string_view name, In in,
                                 Flow flow, Skips skips,
                                 SetsRunning sets_running) {
  return {type,        name,  in,           1, 1, flow, Beside::Any,
          Ended::None, skips, sets_running, ""};
}

// A row without one of its columns does not compile.
constexpr std::array<NodeTypeInfo, kNodeTypeCount> kTypes = {{
    decorator(NodeType::BehaviorTree, "BehaviorTree", In::Both, Flow::AsChild,
              Skips::Some, SetsRunning::Never),
    {NodeType::Sequence, "Sequence", In::Both, 1, kAnyNumber, Flow::OnSuccess,
     Beside::None, Ended::None, Skips::AllOrCounting, SetsRunning::First, "→"},
    {NodeType::Fallback, "Fallback", In::Both, 1, kAnyNumber, Flow::OnFailure,
     Beside::None, Ended::None, Skips::AllOrCounting, SetsRunning::First, "?"},
    {NodeType::SequenceWithMemory, "SequenceWithMemory", In::Both, 1,
     kAnyNumber, Flow::OnSuccess, Beside::None, Ended::None,
     Skips::AllOrCounting, SetsRunning::First, "→"},
    {NodeType::ReactiveSequence, "ReactiveSequence", In::Both, 1, kAnyNumber,
     Flow::OnSuccess, Beside::TheLeft, Ended::None, Skips::All,
     SetsRunning::First, "→"},
    {NodeType::ReactiveFallback, "ReactiveFallback", In::Both, 1, kAnyNumber,
     Flow::OnFailure, Beside::TheLeft, Ended::None, Skips::All,
     SetsRunning::First, "?"},
    {NodeType::Parallel, "Parallel", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::Counted, Ended::None, Skips::All, SetsRunning::First, "⇉"},
    {NodeType::ParallelAll, "ParallelAll", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::Counted, Ended::None, Skips::All, SetsRunning::First, "⇉"},
    decorator(NodeType::Inverter, "Inverter", In::Both, Flow::Inverts,
              Skips::Some, SetsRunning::First),
    decorator(NodeType::ForceSuccess, "ForceSuccess", In::Both, Flow::Succeeds,
              Skips::Some, SetsRunning::First),
    decorator(NodeType::ForceFailure, "ForceFailure", In::Both, Flow::Fails,
              Skips::Some, SetsRunning::First),
    decorator(NodeType::KeepRunningUntilFailure, "KeepRunningUntilFailure",
              In::Both, Flow::UntilFailure, Skips::Never, SetsRunning::First),
    decorator(NodeType::Repeat, "Repeat", In::Both, Flow::Repeats, Skips::Some,
              SetsRunning::First),
    decorator(NodeType::RetryUntilSuccessful, "RetryUntilSuccessful", In::Both,
              Flow::Retries, Skips::Some, SetsRunning::First),
    decorator(NodeType::RateController, "RateController", In::Both,
              Flow::AsChild, Skips::Some, SetsRunning::First),
    {NodeType::Recovery, "Recovery", In::Both, 2, 2, Flow::Recovers,
     Beside::None, Ended::None, Skips::First, SetsRunning::FirstMayHalt, "?"},
    {NodeType::RoundRobin, "RoundRobin", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::None, Ended::All, Skips::All, SetsRunning::FirstMayHalt, "↻"},
    {NodeType::PipelineSequence, "PipelineSequence", In::Both, 1, kAnyNumber,
     Flow::OnSuccess, Beside::TheLeft, Ended::All, Skips::All,
     SetsRunning::Never, "→"},
    decorator(NodeType::SubTree, "SubTree", In::Both, Flow::AsChild,
              Skips::Some, SetsRunning::FromIdle),
    leaf(NodeType::Action, "Action", In::Both, Skips::AsContract,
         SetsRunning::AsProgrammed),
    leaf(NodeType::Condition, "Condition", In::Both, Skips::AsContract,
         SetsRunning::AsProgrammed),
    leaf(NodeType::SetSV, "SetSV", In::Btf, Skips::Never, SetsRunning::Never),
    leaf(NodeType::Eval, "Eval", In::Btf, Skips::Never, SetsRunning::Never),
    leaf(NodeType::Wait, "Wait", In::Both, Skips::Never, SetsRunning::Never),
    {NodeType::AsyncSequence, "AsyncSequence", In::Xml, 1, kAnyNumber,
     Flow::OnSuccess, Beside::None, Ended::None, Skips::AllOrCounting,
     SetsRunning::First, "→"},
    {NodeType::AsyncFallback, "AsyncFallback", In::Xml, 1, kAnyNumber,
     Flow::OnFailure, Beside::None, Ended::None, Skips::AllOrCounting,
     SetsRunning::First, "?"},
    {NodeType::IfThenElse, "IfThenElse", In::Xml, 2, 3, Flow::Chooses,
     Beside::None, Ended::FirstOfTwo, Skips::SomeBranch, SetsRunning::First,
     "◇"},
    {NodeType::WhileDoElse, "WhileDoElse", In::Xml, 2, 3, Flow::Chooses,
     Beside::TheLeft, Ended::First, Skips::SomeBranch, SetsRunning::First, "◇"},
    {NodeType::Switch, "Switch", In::Xml, 1, kAnyNumber, Flow::Cases,
     Beside::Any, Ended::None, Skips::Some, SetsRunning::Never, "◇"},
    {NodeType::TryCatch, "TryCatch", In::Xml, 2, kAnyNumber, Flow::Tries,
     Beside::None, Ended::None, Skips::AllTried, SetsRunning::First, "?"},
    {NodeType::NonblockingSequence, "NonblockingSequence", In::Xml, 1,
     kAnyNumber, Flow::Any, Beside::Any, Ended::All, Skips::Never,
     SetsRunning::Never, "⇉"},
    {NodeType::PersistentSequence, "PersistentSequence", In::Xml, 1, kAnyNumber,
     Flow::Any, Beside::Any, Ended::All, Skips::Never, SetsRunning::First, "→"},
    {NodeType::PauseResumeController, "PauseResumeController", In::Xml, 1, 4,
     Flow::Any, Beside::Any, Ended::All, Skips::Never, SetsRunning::First, "◇"},
    {NodeType::OtherControl, "Control", In::Xml, 1, kAnyNumber, Flow::Any,
     Beside::Any, Ended::All, Skips::Never, SetsRunning::AsProgrammed, ""},
    decorator(NodeType::Precondition, "Precondition", In::Xml, Flow::Any,
              Skips::SomeOrOtherwise, SetsRunning::Never),
    decorator(NodeType::Timeout, "Timeout", In::Both, Flow::Any, Skips::Some,
              SetsRunning::First),
    decorator(NodeType::Delay, "Delay", In::Xml, Flow::AsChild, Skips::Some,
              SetsRunning::First),
    decorator(NodeType::RunOnce, "RunOnce", In::Xml, Flow::AsChild,
              Skips::SomeOrOption, SetsRunning::WithChild),
    decorator(NodeType::Loop, "Loop", In::Xml, Flow::Any,
              Skips::SomeOrOtherwise, SetsRunning::WithChildFromIdle),
    decorator(NodeType::WhenUpdated, "WhenUpdated", In::Xml, Flow::Any,
              Skips::SomeOrOtherwise, SetsRunning::Never),
    decorator(NodeType::WhenDue, "WhenDue", In::Xml, Flow::Any, Skips::Some,
              SetsRunning::WithChild),
    decorator(NodeType::GoalUpdater, "GoalUpdater", In::Xml, Flow::AsChild,
              Skips::Some, SetsRunning::Never),
    decorator(NodeType::PathLongerOnApproach, "PathLongerOnApproach", In::Xml,
              Flow::Any, Skips::Some, SetsRunning::First),
    decorator(NodeType::SingleTrigger, "SingleTrigger", In::Xml, Flow::Any,
              Skips::Some, SetsRunning::First),
    decorator(NodeType::BlackboardCheck, "BlackboardCheck", In::Xml, Flow::Any,
              Skips::SomeOrOtherwise, SetsRunning::First),
    decorator(NodeType::OtherDecorator, "Decorator", In::Xml, Flow::Any,
              Skips::Never, SetsRunning::AsProgrammed),
    leaf(NodeType::Script, "Script", In::Xml, Skips::Never, SetsRunning::Never),
    {NodeType::PolicyParallel, "PolicyParallel", In::Xml, 1, kAnyNumber,
     Flow::Any, Beside::Any, Ended::All, Skips::Never, SetsRunning::Never, "⇉"},
    {NodeType::EternalGuard, "EternalGuard", In::Xml, 2, 2, Flow::OnSuccess,
     Beside::TheLeft, Ended::All, Skips::Never, SetsRunning::Never, "◇"},
    decorator(NodeType::AnswerMap, "AnswerMap", In::Xml, Flow::Maps,
              Skips::Never, SetsRunning::Never),
    leaf(NodeType::AnswerQueue, "AnswerQueue", In::Xml, Skips::Never,
         SetsRunning::Never),
}};

}  // namespace

std::span<const NodeTypeInfo, kNodeTypeCount> node_types() { return kTypes; }

const std::vector<NodeTypeInfo>& btf_node_types() {
  static const std::vector<NodeTypeInfo> found = [] {
    std::vector<NodeTypeInfo> types;
    std::copy_if(kTypes.begin(), kTypes.end(), std::back_inserter(types),
                 [](const NodeTypeInfo& info) { return info.in != In::Xml; });
    return types;
  }();
  return found;
}

const NodeTypeInfo& info_of(NodeType type) {
  return kTypes[static_cast<std::size_t>(type)];
}

std::string_view type_name(NodeType type) { return info_of(type).name; }

bool is_leaf(NodeType type) { return info_of(type).max_children == 0; }

}  // namespace btcheck
