// SPDX-License-Identifier: MIT
#include "trace/logs/engine_records.hpp"

#include "model/tree/node_types.hpp"

namespace btcheck {

EngineRecords engine_records(NodeType type, Profile profile) {
  switch (type) {
    case NodeType::Parallel:
      // src/controls/parallel_node.cpp of 3.8.8 does not.
      if (is_release_3(profile)) return {};
      return {SetsRunning::First};
    case NodeType::Sequence:
    case NodeType::Fallback:
    case NodeType::SequenceWithMemory:
    case NodeType::ReactiveSequence:
    case NodeType::ReactiveFallback:
    case NodeType::ParallelAll:
    case NodeType::Inverter:
    case NodeType::ForceSuccess:
    case NodeType::ForceFailure:
    case NodeType::KeepRunningUntilFailure:
    case NodeType::Repeat:
    case NodeType::RetryUntilSuccessful:
    case NodeType::RateController:
    case NodeType::AsyncSequence:
    case NodeType::AsyncFallback:
    case NodeType::IfThenElse:
    case NodeType::WhileDoElse:
    case NodeType::TryCatch:
    case NodeType::PersistentSequence:
    case NodeType::PauseResumeController:
    case NodeType::Timeout:
    case NodeType::Delay:
    case NodeType::PathLongerOnApproach:
    case NodeType::SingleTrigger:
    case NodeType::BlackboardCheck:
      return {SetsRunning::First};
    case NodeType::Recovery:
    case NodeType::RoundRobin:
      return {SetsRunning::First, true};
    case NodeType::SubTree:
      return {SetsRunning::FromIdle};
    case NodeType::RunOnce:
    case NodeType::WhenDue:
      return {SetsRunning::WithChild};
    case NodeType::Loop:
      return {SetsRunning::WithChildFromIdle};
    case NodeType::Action:
    case NodeType::Condition:
    case NodeType::OtherControl:
    case NodeType::OtherDecorator:
      return {SetsRunning::AsProgrammed};
    case NodeType::PipelineSequence:
    case NodeType::NonblockingSequence:
    case NodeType::Switch:
    case NodeType::Precondition:
    case NodeType::WhenUpdated:
    case NodeType::GoalUpdater:
    case NodeType::Script:
    case NodeType::Wait:  // it answers running
    case NodeType::BehaviorTree:
    case NodeType::SetSV:
    case NodeType::Eval:
    case NodeType::PolicyParallel:
    case NodeType::EternalGuard:
    case NodeType::AnswerMap:
    case NodeType::AnswerQueue:
      break;
  }
  return {};
}

bool is_from_idle(SetsRunning when) {
  return when == SetsRunning::FromIdle ||
         when == SetsRunning::WithChildFromIdle ||
         when == SetsRunning::AsProgrammed;
}

bool sets_running(SetsRunning when, std::string_view from, std::string_view to,
                  bool is_call) {
  if (when == SetsRunning::Never) return false;
  if (when == SetsRunning::WithChild ||
      when == SetsRunning::WithChildFromIdle) {
    return is_call;
  }
  if (when == SetsRunning::AsProgrammed && is_call) return true;
  if (to == "tick") return true;
  return from == "tick_node" && to != "conditions" && to != "still";
}

}  // namespace btcheck
