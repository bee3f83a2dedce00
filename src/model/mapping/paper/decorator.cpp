// SPDX-License-Identifier: MIT
//
// Nodes with one child: decorators, which pass its answer on, change or count
// it (paper, section 3.7, figure 10), and the root, which makes the ticks
// (section 3.8.2). Decorators always pass running on; halting one halts the
// child if it runs and clears the counter. SubTree passes everything on.
#include "model/mapping/paper/drawings.hpp"

namespace btcheck::mapping {
namespace {

using enum NodeStatus;

// What it answers when its child succeeds, and when it fails.
template <NodeStatus on_success, NodeStatus on_failure>
void draw_decorator(NodeBuilder& draw) {
  const auto answering = [&](NodeStatus answer) {
    return draw.at(kStatusNames[static_cast<int>(answer)]);
  };
  draw.frame();
  draw.edge(draw.decide(), draw.call(0));
  draw.on_answer(0, NodeStatus::Success, answering(on_success));
  draw.on_answer(0, NodeStatus::Failure, answering(on_failure));
  draw.on_answer(0, NodeStatus::Running, draw.at("running"));
  draw.on_halt();
}

// Repeat and RetryUntilSuccessful: the answer that goes round again is counted
// in `count`; the next round starts in the same tick.
void draw_counting_decorator(NodeBuilder& draw) {
  const bool repeats = draw.node().type == NodeType::Repeat;
  const NodeStatus again = repeats ? NodeStatus::Success : NodeStatus::Failure;
  const NodeStatus stops = repeats ? NodeStatus::Failure : NodeStatus::Success;
  const int rounds = draw.node().repetitions;

  draw.frame();
  VariableId count = draw.rounds("count", rounds - 1);
  draw.edge(draw.decide(), draw.call(0));
  for (int done = 0; done + 1 < rounds; ++done) {
    draw.on_answer(0, again, draw.call(0), {set(count, done + 1)},
                   equals(count, done));
  }
  draw.on_answer(0, again, draw.at(repeats ? "success" : "failure"),
                 {set(count, 0)},
                 rounds > 1 ? equals(count, rounds - 1) : Expression{});
  draw.on_answer(0, stops, draw.at(repeats ? "failure" : "success"),
                 {set(count, 0)});
  draw.on_answer(0, NodeStatus::Running, draw.at("running"));
  draw.on_halt({set(count, 0)});
}

// RateController: an activation of the child starts the companion timer; a
// child that does not run is activated again only when the timer is not
// counting. In between the node answers running, as in Nav2.
void draw_rate_controller(NodeBuilder& draw) {
  draw.frame();
  Timer timer = draw.add_timer();
  LocationId from = draw.decide();
  Expression runs = equals(draw.status(0), NodeStatus::Running);
  draw.edge(from, draw.call(0), runs, {}, "the child still runs");
  draw.edge(from, draw.call(0),
            both(negated(runs), differs(timer.location, Timer::kCounting)),
            {timer.start()}, "a period begins");
  draw.edge(from, draw.at("running"), both(negated(runs), timer.is_counting()),
            {}, "the period is not over");
  draw.on_answer(0, NodeStatus::Success, draw.at("success"));
  draw.on_answer(0, NodeStatus::Failure, draw.at("failure"));
  draw.on_answer(0, NodeStatus::Running, draw.at("running"));
  draw.on_halt({timer.stop()});
}

// Timeout: its first tick starts the companion timer. A child that still runs
// when the timer is due is halted at the next tick instead of ticked, and the
// node fails.
void draw_time_limit(NodeBuilder& draw) {
  draw.frame();
  const Timer timer = draw.add_timer();
  const std::vector<Assignment> stop = {timer.stop()};
  const LocationId from = draw.decide();
  const LocationId expired = draw.at("expired");
  draw.edge(from, draw.call(0), timer.is_idle(), {timer.start()},
            "starts its timer");
  draw.edge(from, draw.call(0), timer.is_counting());
  draw.edge(from, expired, timer.is_due(), {}, "the time is up");
  draw.halt_children(expired, draw.at("failure"), stop);
  draw.on_answer(0, NodeStatus::Success, draw.at("success"), stop);
  draw.on_answer(0, NodeStatus::Failure, draw.at("failure"), stop);
  draw.on_answer(0, NodeStatus::Running, draw.at("running"));
  draw.on_halt(stop);
}

// BehaviorTree: each tick takes one unit of time; while the child answers
// running the next one follows, and success or failure is for ever unless :loop
// starts the tree again.
void draw_root(NodeBuilder& draw) {
  VariableId status = draw.context().status(draw.id());
  LocationId start = draw.at("start_");
  LocationId tick = draw.at("tick_node");
  draw.edge(start, tick, {}, {set(status, NodeStatus::NoRetStatus)});
  draw.timed_edge(tick, draw.call(0), {1, 1}, "tick");
  auto ends = [&](NodeStatus answer, bool again) {
    std::string_view word = kStatusNames[static_cast<int>(answer)];
    draw.on_answer(0, answer, draw.at(word), {set(status, answer)});
    if (again) draw.edge(draw.at(word), start);
  };
  ends(NodeStatus::Running, true);
  ends(NodeStatus::Success, draw.node().loop);
  ends(NodeStatus::Failure, draw.node().loop);
  draw.halted_by_caller(start);
}

constexpr Drawing kDecoratorRows[] = {
    {NodeType::BehaviorTree, draw_root},
    {NodeType::Inverter, draw_decorator<Failure, Success>},
    {NodeType::ForceSuccess, draw_decorator<Success, Success>},
    {NodeType::ForceFailure, draw_decorator<Failure, Failure>},
    {NodeType::KeepRunningUntilFailure, draw_decorator<Running, Failure>},
    {NodeType::Repeat, draw_counting_decorator},
    {NodeType::RetryUntilSuccessful, draw_counting_decorator},
    {NodeType::RateController, draw_rate_controller},
    {NodeType::SubTree, draw_decorator<Success, Failure>},
    {NodeType::Timeout, draw_time_limit}};

}  // namespace

constinit const Family kDecoratorDrawings = kDecoratorRows;

}  // namespace btcheck::mapping
