// SPDX-License-Identifier: MIT
//
// Behaviours of py_trees that answer by a rule of their own. All others are
// leaves like those of BehaviorTree.CPP that run anew on every tick.
#include <optional>

#include "model/mapping/py_trees/drawings.hpp"

namespace btcheck::mapping {
namespace {

Expression between(VariableId variable, int first, int last) {
  return both(at_least(variable, first), negated(at_least(variable, last + 1)));
}

// StatusQueue, TickCounter, Periodic, SuccessEveryN: `next` is the place in the
// queue, written out. One that begins anew whenever it has not been running is
// at its beginning when it has ended or been stopped.
void draw_py_trees_queue(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  const Node& node = draw.node();
  int length = 0;
  int goes_on = 0;
  for (std::size_t i = 0; i < node.queue.size(); ++i) {
    if (i == node.queue_goes_on) goes_on = length;
    length += node.queue[i].times;
  }
  const VariableId next = draw.local("next", 0, length - 1, 0);
  int first = 0;
  for (const QueuedAnswers& part : node.queue) {
    const int last = first + part.times - 1;
    const bool restarts = node.option && part.answer != NodeStatus::Running;
    const LocationId answer = build.answering(part.answer);
    if (first < last) {
      draw.edge(build.body(), answer, between(next, first, last - 1),
                {restarts ? set(next, 0) : count(next)});
    }
    const int then = restarts ? 0 : last + 1 < length ? last + 1 : goes_on;
    draw.edge(build.body(), answer, equals(next, last), {set(next, then)});
    first = last + 1;
  }
  build.on_stop(node.option ? std::vector<Assignment>{set(next, 0)}
                            : std::vector<Assignment>{});
}

// Timer: it runs until its time is up.
void draw_py_trees_timer(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  if (!draw.takes_time()) {
    draw.edge(build.body(), build.success());
    return build.on_stop();
  }
  const Timer timer = draw.add_timer();
  draw.edge(build.body(), build.running(), timer.is_idle(), {timer.start()},
            "starts its timer");
  draw.edge(build.body(), build.running(), timer.is_counting());
  draw.edge(build.body(), build.success(), timer.is_due(), {timer.stop()});
  build.on_stop({timer.stop()});
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
  draw.halted_by_caller(start, all_invalid(draw.context(), draw.child(0)));
}

constexpr Drawing kPyTreesLeafRows[] = {
    {NodeType::BehaviorTree, draw_py_trees_root},
    {NodeType::Action, draw_engine_leaf},
    {NodeType::Condition, draw_engine_leaf},
    {NodeType::Wait, draw_py_trees_timer},
    {NodeType::AnswerQueue, draw_py_trees_queue}};

}  // namespace

constinit const Family kPyTreesLeafDrawings = kPyTreesLeafRows;

}  // namespace btcheck::mapping
