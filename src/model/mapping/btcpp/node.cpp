// SPDX-License-Identifier: MIT
#include "model/mapping/btcpp/builder.hpp"
#include "model/tree/node_types.hpp"

#include <cassert>

namespace btcheck::mapping {

Draw engine_drawing_of(NodeType type) {
  switch (type) {
    case NodeType::BehaviorTree:
      return draw_engine_root;
    case NodeType::Sequence:
    case NodeType::Fallback:
    case NodeType::AsyncSequence:
    case NodeType::AsyncFallback:
    case NodeType::SequenceWithMemory:
    case NodeType::PersistentSequence:
      return draw_engine_sequence;
    case NodeType::ReactiveSequence:
    case NodeType::ReactiveFallback:
      return draw_engine_reactive;
    case NodeType::Parallel:
      return draw_engine_parallel;
    case NodeType::ParallelAll:
      return draw_engine_parallel_all;
    case NodeType::IfThenElse:
      return draw_if_then_else;
    case NodeType::WhileDoElse:
      return draw_while_do_else;
    case NodeType::Switch:
      return draw_switch;
    case NodeType::TryCatch:
      return draw_try_catch;
    case NodeType::Repeat:
    case NodeType::RetryUntilSuccessful:
      return draw_engine_repeat;
    case NodeType::RateController:
      return draw_engine_rate_controller;
    case NodeType::Recovery:
      return draw_recovery_node;
    case NodeType::RoundRobin:
      return draw_engine_round_robin;
    case NodeType::PipelineSequence:
      return draw_engine_pipeline;
    case NodeType::NonblockingSequence:
      return draw_nonblocking_sequence;
    case NodeType::PauseResumeController:
      return draw_pause_resume;
    case NodeType::OtherControl:
    case NodeType::OtherDecorator:
      return draw_other_node;
    case NodeType::Precondition:
      return draw_precondition;
    case NodeType::Timeout:
      return draw_timeout;
    case NodeType::Delay:
      return draw_delay;
    case NodeType::RunOnce:
      return draw_run_once;
    case NodeType::Loop:
      return draw_loop;
    case NodeType::WhenUpdated:
      return draw_when_updated;
    case NodeType::WhenDue:
      return draw_when_due;
    case NodeType::PathLongerOnApproach:
      return draw_path_longer_on_approach;
    case NodeType::SingleTrigger:
      return draw_single_trigger;
    case NodeType::BlackboardCheck:
      return draw_blackboard_check;
    case NodeType::Wait:
      return draw_sleep;
    case NodeType::Script:
      return draw_script;
    case NodeType::Action:
    case NodeType::Condition:
      return draw_engine_leaf;
    case NodeType::Inverter:
    case NodeType::ForceSuccess:
    case NodeType::ForceFailure:
    case NodeType::KeepRunningUntilFailure:
    case NodeType::SubTree:
    case NodeType::GoalUpdater:
      return draw_engine_decorator;
    case NodeType::SetSV:
    case NodeType::Eval:
    case NodeType::PolicyParallel:
    case NodeType::EternalGuard:
    case NodeType::AnswerMap:
    case NodeType::AnswerQueue:
      break;  // of .btf trees and of py_trees, which have drawings of their own
  }
  assert(false);
  return nullptr;
}

}  // namespace btcheck::mapping
