// SPDX-License-Identifier: MIT
//
// What each node type of .btf files does (docs/semantics.md, section 4).
#pragma once

#include <cassert>

#include "model/automata/builder.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::mapping {

// One per family; each draws the automaton of one node, frame included.
void draw_action(NodeBuilder& draw);
void draw_condition(NodeBuilder& draw);
void draw_set_state_variable(NodeBuilder& draw);
void draw_eval(NodeBuilder& draw);
void draw_wait(NodeBuilder& draw);
void draw_sequence(NodeBuilder& draw);
void draw_reactive(NodeBuilder& draw);
void draw_parallel(NodeBuilder& draw);
void draw_decorator(NodeBuilder& draw);
void draw_counting_decorator(NodeBuilder& draw);
void draw_rate_controller(NodeBuilder& draw);
void draw_time_limit(NodeBuilder& draw);
void draw_recovery(NodeBuilder& draw);
void draw_round_robin(NodeBuilder& draw);
void draw_pipeline_sequence(NodeBuilder& draw);
void draw_root(NodeBuilder& draw);

// No drawing is forgotten: the switch has no default.
inline Draw drawing_of(NodeType type) {
  switch (type) {
    case NodeType::BehaviorTree:
      return draw_root;
    case NodeType::Sequence:
    case NodeType::Fallback:
    case NodeType::SequenceWithMemory:
      return draw_sequence;
    case NodeType::ReactiveSequence:
    case NodeType::ReactiveFallback:
      return draw_reactive;
    case NodeType::Parallel:
    case NodeType::ParallelAll:
      return draw_parallel;
    case NodeType::Repeat:
    case NodeType::RetryUntilSuccessful:
      return draw_counting_decorator;
    case NodeType::RateController:
      return draw_rate_controller;
    case NodeType::Timeout:
      return draw_time_limit;
    case NodeType::Recovery:
      return draw_recovery;
    case NodeType::RoundRobin:
      return draw_round_robin;
    case NodeType::PipelineSequence:
      return draw_pipeline_sequence;
    case NodeType::Action:
      return draw_action;
    case NodeType::Condition:
      return draw_condition;
    case NodeType::SetSV:
      return draw_set_state_variable;
    case NodeType::Eval:
      return draw_eval;
    case NodeType::Wait:
      return draw_wait;
    case NodeType::Inverter:
    case NodeType::ForceSuccess:
    case NodeType::ForceFailure:
    case NodeType::KeepRunningUntilFailure:
    case NodeType::SubTree:
      return draw_decorator;
    case NodeType::AsyncSequence:
    case NodeType::AsyncFallback:
    case NodeType::IfThenElse:
    case NodeType::WhileDoElse:
    case NodeType::Switch:
    case NodeType::TryCatch:
    case NodeType::NonblockingSequence:
    case NodeType::PersistentSequence:
    case NodeType::PauseResumeController:
    case NodeType::OtherControl:
    case NodeType::Precondition:
    case NodeType::Delay:
    case NodeType::RunOnce:
    case NodeType::Loop:
    case NodeType::WhenUpdated:
    case NodeType::WhenDue:
    case NodeType::GoalUpdater:
    case NodeType::PathLongerOnApproach:
    case NodeType::SingleTrigger:
    case NodeType::BlackboardCheck:
    case NodeType::OtherDecorator:
    case NodeType::Script:
    case NodeType::PolicyParallel:
    case NodeType::EternalGuard:
    case NodeType::AnswerMap:
    case NodeType::AnswerQueue:
      break;  // of XML trees, drawn by engine_drawing_of
  }
  assert(false);
  return nullptr;
}

}  // namespace btcheck::mapping
