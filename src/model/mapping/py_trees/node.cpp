// SPDX-License-Identifier: MIT
#include "model/mapping/py_trees/drawings.hpp"
#include "model/tree/node_types.hpp"

#include <cassert>
#include <utility>

namespace btcheck::mapping {

LocationId PyTreesBuilder::answering(NodeStatus answer) {
  return answer == NodeStatus::Success   ? success()
         : answer == NodeStatus::Failure ? failure()
                                         : running();
}

std::vector<Assignment> PyTreesBuilder::invalid(std::size_t child) {
  const Context& context = draw().context();
  const BehaviorTree& tree = context.tree;
  std::vector<Assignment> updates;
  std::vector<NodeId> open = {draw().child(child)};
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    updates.push_back(set(context.status(node), NodeStatus::NoRetStatus));
    const auto& below = tree.node(node).children;
    open.insert(open.end(), below.begin(), below.end());
  }
  return updates;
}

std::vector<Assignment> PyTreesBuilder::invalid(
    const std::vector<std::size_t>& of) {
  std::vector<Assignment> updates;
  for (const std::size_t child : of) {
    updates = joined(std::move(updates), invalid(child));
  }
  return updates;
}

void PyTreesBuilder::stop(LocationId from, LocationId then,
                          const std::vector<std::size_t>& children,
                          std::vector<Assignment> updates) {
  halt(from, then, children, joined(std::move(updates), invalid(children)));
}

std::vector<std::size_t> PyTreesBuilder::behind(std::size_t child) const {
  std::vector<std::size_t> others = all_children();
  others.erase(others.begin(),
               others.begin() + static_cast<std::ptrdiff_t>(child + 1));
  return others;
}

void PyTreesBuilder::on_stop(std::vector<Assignment> updates) {
  stop(at("halt"), at("halted"), all_children(), std::move(updates));
}

// BehaviourTree.tick_tock: the root is ticked again and again, and nothing is
// stopped in between.
void draw_py_trees_root(NodeBuilder& draw) {
  const VariableId status = draw.context().status(draw.id());
  const LocationId start = draw.at("start_");
  const LocationId tick = draw.at("tick_node");
  draw.edge(start, tick, {}, {set(status, NodeStatus::NoRetStatus)});
  draw.timed_edge(tick, draw.call(0), {1, 1}, "tick");
  const auto ends = [&](NodeStatus answer, std::string_view location) {
    draw.on_answer(0, answer, draw.at(location), {set(status, answer)});
    draw.edge(draw.at(location), start);
  };
  ends(NodeStatus::Success, "success");
  ends(NodeStatus::Failure, "failure");
  ends(NodeStatus::Running, "running");
}

Draw py_trees_drawing_of(NodeType type) {
  switch (type) {
    case NodeType::BehaviorTree:
      return draw_py_trees_root;
    case NodeType::Sequence:
    case NodeType::ReactiveSequence:
      return draw_py_trees_sequence;
    case NodeType::Fallback:
    case NodeType::ReactiveFallback:
      return draw_py_trees_selector;
    case NodeType::PolicyParallel:
      return draw_py_trees_parallel;
    case NodeType::SubTree:
    case NodeType::Inverter:
    case NodeType::ForceSuccess:
    case NodeType::ForceFailure:
    case NodeType::KeepRunningUntilFailure:
    case NodeType::AnswerMap:
      return draw_py_trees_map;
    case NodeType::Repeat:
    case NodeType::RetryUntilSuccessful:
      return draw_py_trees_rounds;
    case NodeType::RunOnce:
      return draw_py_trees_one_shot;
    case NodeType::Timeout:
      return draw_py_trees_timeout;
    case NodeType::EternalGuard:
      return draw_py_trees_guard;
    case NodeType::AnswerQueue:
      return draw_py_trees_queue;
    case NodeType::Wait:
      return draw_py_trees_timer;
    case NodeType::Action:
    case NodeType::Condition:
      return draw_engine_leaf;
    case NodeType::SequenceWithMemory:
    case NodeType::Parallel:
    case NodeType::ParallelAll:
    case NodeType::RateController:
    case NodeType::Recovery:
    case NodeType::RoundRobin:
    case NodeType::PipelineSequence:
    case NodeType::SetSV:
    case NodeType::Eval:
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
    case NodeType::Loop:
    case NodeType::WhenUpdated:
    case NodeType::WhenDue:
    case NodeType::GoalUpdater:
    case NodeType::PathLongerOnApproach:
    case NodeType::SingleTrigger:
    case NodeType::BlackboardCheck:
    case NodeType::OtherDecorator:
    case NodeType::Script:
      break;  // refused by the reader (BT1660)
  }
  assert(false);
  return nullptr;
}

}  // namespace btcheck::mapping
