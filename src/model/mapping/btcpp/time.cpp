// SPDX-License-Identifier: MIT
//
// Nodes with a clock: Timeout, Delay, Sleep (BehaviorTree.CPP 4.10,
// src/decorators/timeout_node.cpp, delay_node.cpp, src/actions/sleep_node.cpp)
// and Nav2's RateController. Their durations are whole ticks of the root; each
// has a companion timer.
#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {
namespace {

// The timer halts the child from outside the tick; the next tick fails. Only
// when the child completes, or the node is halted, does the timer end: a child
// that was skipped when it was due then runs without a limit. In release 3 a
// halt does not end it either: it goes on into the next activation, and where
// it has halted the child in the tick in which the node is halted, that
// activation fails at once.
void draw_timeout(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  if (!draw.takes_time()) {
    draw.edge(build.body(), build.tick_only_child(build.passing()));
    return build.on_halt();
  }
  const Timer timer = draw.add_timer();
  // What the timer met when it was due: `late` is 1 when the child did not run
  // then, so that nothing is halted any more, and 2 when it did, but the node
  // was halted before it could say so.
  const bool outlives = releases::timeout_outlives_halt(build.release());
  const VariableId late = draw.local("late", 0, outlives ? 2 : 1, 0);
  const std::vector<Assignment> ends = {timer.stop(), set(late, 0)};
  Reactions reactions = build.passing(ends);
  if (build.is_in(releases::kSkippedEnds)) {
    for (Reaction& skipped : reactions.skipped) skipped.updates = ends;
  }
  const LocationId calling = build.tick_only_child(std::move(reactions));
  const Expression due = timer.is_due();
  const LocationId begin = build.at("begin");
  draw.edge(build.body(), calling, timer.is_idle(), {timer.start()},
            "starts its timer");
  draw.edge(build.body(), calling, timer.is_counting());
  draw.edge(build.body(), begin, due);
  draw.edge(begin, calling, equals(late, 1));
  const Expression first = equals(late, 0);
  const LocationId expired = build.at("expired");
  draw.edge(begin, expired, both(first, build.is_running(0)), {},
            "the time is up");
  draw.tells_why();
  draw.edge(begin, calling, both(first, negated(build.is_running(0))),
            {set(late, 1)}, "the time was up while nothing ran");
  build.reset_all(expired, build.failure(), ends);
  if (!outlives) return build.on_halt(ends);
  draw.edge(begin, build.failure(), equals(late, 2), ends,
            "the time was up when it was halted");
  const Expression meets = both(due, both(first, build.is_running(0)));
  const LocationId halt = build.at("halt");
  const LocationId halted = build.at("halted");
  const LocationId tells_later = build.at("tells_later");
  draw.edge(halt, tells_later, meets, {set(late, 2)}, "the time is up");
  build.reset_all(tells_later, halted);
  build.reset(halt, halted, build.all_children(), {}, negated(meets));
}

// Before 3.6 a Delay that is halted while it waits fails in the next tick.
// Returns where the others begin.
LocationId draw_delay_after_halt(EngineBuilder& build, const Timer& timer) {
  NodeBuilder& draw = build.draw();
  const VariableId aborted = draw.local("aborted", 0, 1, 0);
  const LocationId begin = build.at("begin");
  draw.edge(build.body(), begin, equals(aborted, 0));
  draw.edge(build.body(), build.failure(), equals(aborted, 1),
            {set(aborted, 0)}, "was halted while it waited");
  const LocationId waited = build.at("halt_waited");
  const LocationId other = build.at("halt_other");
  draw.edge(build.at("halt"), waited, timer.is_counting());
  draw.edge(build.at("halt"), other, negated(timer.is_counting()));
  build.reset_all(waited, build.at("halted"), {timer.stop(), set(aborted, 1)});
  build.reset_all(other, build.at("halted"), {timer.stop()});
  return begin;
}

// Running until the time is up, then the child. Only a completed child, or
// being halted, makes the next activation wait again. Another thread measures
// the time, so a delay of no length may end in the tick in which it begins, or
// in the next.
void draw_delay(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  constexpr Interval kNoLength{0, 1};
  const Timer timer =
      draw.takes_time() ? draw.add_timer() : draw.add_timer(kNoLength);
  const bool may_be_none = draw.node().duration->min == 0;
  const std::vector<Assignment> ends = {timer.stop()};
  // Release 3 ends with whatever is not running; the older ones end in any
  // case.
  Reactions reactions = build.passing(ends);
  if (build.is_in(releases::kDelaysEachTick)) {
    reactions.running[0].updates = ends;
  }
  if (build.is_in(releases::kSkippedEnds)) {
    for (Reaction& skipped : reactions.skipped) skipped.updates = ends;
    build.resets_skipped(reactions);
  }
  const LocationId calling = build.tick_only_child(std::move(reactions));
  const LocationId begin = build.is_in(releases::kDelayTellsHalt)
                               ? draw_delay_after_halt(build, timer)
                               : build.body();
  const LocationId look = may_be_none ? build.at("look") : begin;
  draw.edge(begin, may_be_none ? look : build.running(), timer.is_idle(),
            {timer.start()}, "starts its timer");
  if (may_be_none) {
    draw.edge(begin, look, differs(timer.location, Timer::kIdle));
  }
  draw.edge(look, build.running(), timer.is_counting());
  draw.edge(look, calling, timer.is_due());
  if (!build.is_in(releases::kDelayTellsHalt)) build.on_halt(ends);
}

// Once ended it answers the same until it is reset, also where a precondition
// has let it fail (StatefulActionNode::tick).
void draw_sleep(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const VariableId status = build.status();
  const Expression slept = equals(status, NodeStatus::Success);
  const Expression failed = equals(status, NodeStatus::Failure);
  const LocationId look = build.at("look");
  draw.edge(build.body(), build.success(), slept, {}, "has slept already");
  draw.edge(build.body(), build.failure(), failed, {}, "has failed already");
  draw.edge(build.body(), look, both(negated(slept), negated(failed)));
  if (!draw.takes_time()) {
    draw.edge(look, build.success());
    return build.on_halt();
  }
  const Timer timer = draw.add_timer();
  Expression begins = timer.is_idle();
  // One that its own `_while` has halted does not wait again.
  if (build.is_in(releases::kWhileLeavesRunning) &&
      draw.node().script(ScriptTime::While)) {
    draw.edge(look, build.success(), both(begins, build.was_running()));
    begins = both(std::move(begins), negated(build.was_running()));
  }
  if (draw.node().duration->min == 0) {
    draw.choice(look, build.running(), begins, {timer.start()},
                "starts its timer");
    draw.choice(look, build.success(), begins, {}, "has no time to wait for");
  } else {
    draw.edge(look, build.running(), begins, {timer.start()},
              "starts its timer");
  }
  draw.edge(look, build.running(), timer.is_counting());
  draw.edge(look, build.success(), timer.is_due(), {timer.stop()});
  build.on_halt({timer.stop()});
}

// Nav2: the child is ticked on activation, while it runs, and when a period has
// passed since the activation or since it last succeeded. In between the node
// answers running (nav2_behavior_tree, plugins/decorator/rate_controller.cpp).
// Only an activation sets the clock: where a precondition has answered instead,
// the time since the activation before counts; and before the first activation
// the period is uninitialized memory.
void draw_engine_rate_controller(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const auto& node = draw.node();
  const bool outlives =
      build.may_stay() && (node.script(ScriptTime::FailureIf) ||
                           node.script(ScriptTime::SuccessIf));
  const Timer timer = draw.add_timer();
  const LocationId calling = build.at("tick_child");
  const LocationId begin = build.at("look");
  // The timer starts from zero, whatever it was doing.
  const LocationId activated = build.at("activated");
  draw.edge(build.body(), activated, build.was_idle(), {timer.stop()});
  draw.edge(activated, calling, {}, {timer.start()}, "starts its timer");
  draw.edge(build.body(), begin, negated(build.was_idle()));
  const Expression has_period = differs(timer.location, Timer::kIdle);
  const Expression due = either(timer.is_due(), build.is_running(0));
  draw.edge(begin, calling, due, {}, "a period has passed, or the child runs");
  draw.edge(begin, build.running(), both(has_period, negated(due)), {},
            "not yet");
  Reactions reactions = build.passing();
  const LocationId again = build.at("succeeded");
  reactions.success = {{again, {timer.stop()}}};
  if (outlives) {
    const Expression lost = both(negated(has_period), negated(due));
    draw.choice(begin, calling, lost, {}, "its unset period has passed");
    draw.choice(begin, build.running(), lost, {}, "its unset period goes on");
    reactions.success = {{again, {timer.stop()}, has_period},
                         {build.success(), {}, negated(has_period)}};
  }
  draw.edge(calling, build.tick_only_child(std::move(reactions)));
  draw.edge(again, build.success(), {}, {timer.start()});
  build.on_halt(outlives ? std::vector<Assignment>{}
                         : std::vector<Assignment>{timer.stop()});
}

constexpr Drawing kTimeRows[] = {
    {NodeType::Timeout, draw_timeout},
    {NodeType::Delay, draw_delay},
    {NodeType::Wait, draw_sleep},
    {NodeType::RateController, draw_engine_rate_controller}};

}  // namespace

constinit const Family kTimeDrawings = kTimeRows;

}  // namespace btcheck::mapping
