// SPDX-License-Identifier: MIT
//
// Which drawing a node of an XML tree has, and which answers it can give.
#include "model/mapping/btcpp/builder.hpp"
#include "model/tree/node_types.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>

namespace btcheck::mapping {
namespace {

bool has_skipping_condition(const Node& node) {
  return node.script(ScriptTime::SkipIf) || node.script(ScriptTime::While);
}

// Whether the node may tick child i again after it has ended, and has not reset
// it.
bool leaves_ended(const Node& node, std::size_t i) {
  switch (info_of(node.type).ended) {
    case Ended::None:
      return false;
    case Ended::First:
      return i == 0;
    case Ended::FirstOfTwo:
      return i == 0 && node.children.size() == 2;
    case Ended::All:
      return true;
  }
  assert(false);
  return true;
}

// Whether the node may answer skipped, given which children may. A node that
// counts skipped children goes on counting where it stays.
bool may_skip(const Node& node, const std::vector<bool>& known, bool stays) {
  if (has_skipping_condition(node)) return true;
  const auto skips = [&](NodeId child) { return known[index(child)]; };
  using Children = std::span<const NodeId>;
  const auto some = [&](Children of) { return std::ranges::any_of(of, skips); };
  const auto all = [&](Children of) { return std::ranges::all_of(of, skips); };
  const Children children(node.children);
  switch (info_of(node.type).skips) {
    case Skips::Never:
      return false;
    case Skips::AsContract:
      return node.contract.may_skip;
    case Skips::Some:
      return some(children);
    case Skips::All:
      return all(children);
    case Skips::AllOrCounting:
      return all(children) || (some(children) && stays);
    case Skips::AllTried:
      return all(children.first(children.size() - 1)) ||
             (some(children.first(children.size() - 1)) && stays);
    case Skips::First:
      return skips(children[0]);
    case Skips::SomeBranch:
      return some(children.subspan(1));
    case Skips::SomeOrOption:
      return some(children) || node.option;
    case Skips::SomeOrOtherwise:
      return some(children) || node.otherwise == NodeStatus::Skipped;
  }
  assert(false);
  return true;
}

bool may_run(const Node& node) {
  const bool is_leaf =
      node.type == NodeType::Action || node.type == NodeType::Condition;
  return is_leaf ? node.contract.may_run : node.type != NodeType::Script;
}

}  // namespace

void find_answers(Context& context) {
  const BehaviorTree& tree = context.tree;
  context.may_skip.assign(tree.nodes.size(), false);
  context.may_run.assign(tree.nodes.size(), true);
  context.may_stay.assign(tree.nodes.size(), false);
  for (const Node& node : tree.nodes) {
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      context.may_stay[index(node.children[i])] = leaves_ended(node, i);
    }
  }
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    context.may_skip[i] =
        may_skip(tree.nodes[i], context.may_skip, context.may_stay[i]);
    context.may_run[i] = may_run(tree.nodes[i]);
  }
}

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
      break;  // of .btf trees, drawn by drawing_of
  }
  assert(false);
  return nullptr;
}

}  // namespace btcheck::mapping
