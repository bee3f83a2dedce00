// SPDX-License-Identifier: MIT
//
// Decorators of BehaviorTree.CPP without a clock (src/decorators and
// include/…/decorators of 4.10 and 3.8.8). After a tick in which its child has
// ended, the child is idle.
#include <optional>
#include <string>
#include <utility>

#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {
namespace {

void draw_engine_decorator(NodeBuilder& draw) {
  const NodeType type = draw.node().type;
  EngineBuilder build(draw, type == NodeType::GoalUpdater ? Begins::Silently
                            : type == NodeType::SubTree ? Begins::RunningIfIdle
                                                        : Begins::Running);
  // SubTree and GoalUpdater pass all answers on.
  Reactions reactions = build.passing();
  if (type == NodeType::Inverter) {
    std::swap(reactions.success, reactions.failure);
  } else if (type == NodeType::ForceSuccess) {
    reactions.failure = reactions.success;
  } else if (type == NodeType::ForceFailure) {
    reactions.success = reactions.failure;
  } else if (type == NodeType::KeepRunningUntilFailure) {
    reactions.success = reactions.skipped = reactions.running;
  }
  if (build.is_in(releases::kSkippedEnds) && build.may_skip(0)) {
    if (type == NodeType::SubTree) build.resets_skipped(reactions);
    if (type == NodeType::ForceSuccess || type == NodeType::ForceFailure) {
      reactions.skipped = reactions.running;
    }
  }
  draw.edge(build.body(), build.tick_only_child(std::move(reactions)));
  build.on_halt();
}

// Repeat and RetryUntilSuccessful. `count` counts the rounds that are done; in
// 4.10 the node yields to others before the next round if its child was idle
// before it ended, in release 3 never. Before 3.5.3 the child is not reset for
// the next round.
void draw_engine_repeat(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const bool repeats = draw.node().type == NodeType::Repeat;
  const int rounds = draw.node().repetitions;
  const bool yields = !is_release_3(build.profile());
  const LocationId over = repeats ? build.success() : build.failure();
  const LocationId stop = repeats ? build.failure() : build.success();
  if (rounds == 0) {
    draw.edge(build.body(), build.is_in(releases::kNoRoundIsSkipped)
                                ? build.skipped()
                                : over);
    build.on_halt();
    return;
  }
  std::optional<VariableId> done;
  if (rounds > 1) done = draw.rounds("count", rounds - 1);
  const std::vector<Assignment> clear = set_if_there(done, 0);

  const LocationId next = build.at("next");
  // Where the next round begins; of an unknown number over an edge of its own.
  const auto again = [&](std::string_view name, LocationId to) {
    if (rounds != kOpenRounds) return to;
    return build.once(name, [&](LocationId from) {
      draw.edge(from, to);
      draw.is_like_time();
    });
  };
  const auto draw_child = [&](std::string_view occasion, LocationId then) {
    std::vector<Reaction> counted;
    if (!done) {
      if (rounds < 0) counted.push_back({then});
      if (rounds == 1 || rounds == kOpenRounds) counted.push_back({over});
    } else {
      counted = {{then, {count(*done)}, negated(at_least(*done, rounds - 1))},
                 {over, clear, at_least(*done, rounds - 1)}};
    }
    Reactions reactions = build.passing();
    const std::vector<Reaction> stops = {{stop, clear}};
    reactions.success = repeats ? counted : stops;
    reactions.failure = repeats ? stops : counted;
    if (build.may_skip(0)) {
      reactions.skipped = {{build.resetting("reset_skipped", build.skipped())}};
    }
    std::optional<LocationId> kept;
    if (build.is_in(releases::kRoundsKeepChild)) kept = then;
    return build.tick_only_child(std::move(reactions), occasion, kept);
  };
  if (yields) {
    draw.edge(next, draw_child("_new", again("again_new", build.yielding())),
              build.is_idle(0));
    draw.edge(next, draw_child("", again("again", next)),
              negated(build.is_idle(0)));
  } else {
    draw.edge(next, draw_child("", again("again", next)));
  }
  draw.edge(build.body(), next);
  build.on_halt(clear);
}

// Once its script has been true, it is not asked again until the child has
// ended; being halted does not end that (`active` stays). Before 4.7 it was
// asked on every tick, and a child that ran was left as it was.
void draw_precondition(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  if (build.is_in(releases::kPreconditionAsksAlways)) {
    build.evaluate(build.body(), draw.node().own_scripts.at(0),
                   build.tick_only_child(build.passing()),
                   build.answering(draw.node().otherwise));
    return build.on_halt();
  }
  const VariableId active = draw.local("active", 0, 1, 0);
  const LocationId calling =
      build.tick_only_child(build.passing({set(active, 0)}));
  const LocationId passed = build.at("passed");
  draw.edge(passed, calling, {}, {set(active, 1)});
  draw.edge(build.body(), calling, equals(active, 1));
  build.evaluate(build.body(), draw.node().own_scripts.at(0), passed,
                 build.answering(draw.node().otherwise), equals(active, 0));
  build.on_halt();
}

// The child's first answer is kept for ever, whatever resets the node.
void draw_run_once(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const bool skips = draw.node().option;
  // 1: has run and skips, or has succeeded; 2: has failed.
  const VariableId ran = draw.local("ran", 0, skips ? 1 : 2, 0);
  Reactions reactions = build.passing({set(ran, 1)});
  if (!skips) reactions.failure[0].updates = {set(ran, 2)};
  draw.edge(build.body(), build.tick_only_child(std::move(reactions)),
            equals(ran, 0));
  draw.edge(build.body(), skips ? build.at("skipped") : build.success(),
            equals(ran, 1), {}, "it has run once");
  if (!skips) draw.edge(build.body(), build.failure(), equals(ran, 2));
  build.on_halt();
}

// One element of the queue for each tick of the child. A queue that is written
// in the tree has `repetitions` elements; any other may be empty at any time.
// It is loaded in a tick that finds the node idle, and is empty before the
// first one: where a precondition has answered, the node is not idle.
void draw_loop(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const int elements = draw.node().repetitions;
  const LocationId empty = build.answering(draw.node().otherwise);
  const LocationId next = build.at("next");
  const VariableId active = draw.local("active", 0, 1, 0);
  std::optional<VariableId> taken;
  // Behind the elements: one that only the first activation fills.
  const bool refills = !build.is_in(releases::kQueueIsUsedUp);
  const int unfilled = refills ? elements : elements + 1;
  if (elements > 0) taken = draw.local("taken", 0, unfilled, unfilled);
  Reactions reactions = build.passing({set(active, 0)});
  reactions.success[0].to = build.running();
  reactions.running[0].updates = {set(active, 1)};
  reactions.skipped = reactions.success;
  const LocationId calling = build.tick_only_child(std::move(reactions));
  if (refills || !taken) {
    build.start_anew(next, joined({set(active, 0)}, set_if_there(taken, 0)));
  } else {
    const LocationId begin = build.at("begin");
    build.start_anew(begin, {set(active, 0)});
    const Expression fills = both(build.was_idle(), equals(*taken, unfilled));
    draw.edge(begin, next, fills, {set(*taken, 0)});
    draw.edge(begin, next, negated(fills));
  }
  draw.edge(next, calling, equals(active, 1));
  if (taken) {
    draw.edge(next, calling,
              both(equals(active, 0), negated(at_least(*taken, elements))),
              {count(*taken)}, "takes an element");
    draw.edge(next, empty, both(equals(active, 0), at_least(*taken, elements)),
              {}, "the queue is empty");
  } else {
    if (elements == kOpenRounds) {
      draw.choice(next, calling, equals(active, 0), {}, "takes an element");
    }
    draw.choice(next, empty, equals(active, 0), {}, "the queue is empty");
  }
  build.on_halt();
}

// SkipUnlessUpdated and WaitValueUpdate: whether the entry has been written is
// left open. A child that runs is ticked on without looking; before 4.9 it runs
// on when the node is halted.
void draw_when_updated(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const VariableId active = draw.local("active", 0, 1, 0);
  Reactions reactions = build.passing({set(active, 0)});
  reactions.running[0].updates = {set(active, 1)};
  for (Reaction& reaction : reactions.skipped) {
    reaction.updates = {set(active, 0)};
  }
  const LocationId calling = build.tick_only_child(std::move(reactions));
  draw.choice(build.body(), calling, {}, {}, "the entry has been written");
  draw.choice(build.body(), build.answering(draw.node().otherwise),
              equals(active, 0), {}, "the entry is as it was");
  if (build.is_in(releases::kUpdatedKeepsChild)) {
    draw.edge(build.at("halt"), build.at("halted"), {}, {set(active, 0)});
  } else {
    build.on_halt({set(active, 0)});
  }
}

// BlackboardCheckInt, … of release 3: the values are compared on every tick.
void draw_blackboard_check(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const LocationId calling = build.tick_only_child(build.passing());
  const LocationId differ = build.at("differ");
  build.choose(build.body(), draw.node().own_scripts.at(0), calling, differ);
  build.reset_all(differ, build.answering(draw.node().otherwise));
  build.on_halt();
}

// A control node or decorator of the user's program. On each tick, from left to
// right, each child may be ticked, with or without a reset before, only reset,
// or left out. The node may then answer anything; with any answer but running
// it resets its children. A decorator's child that has ended is idle, as with
// all decorators.
void draw_other_node(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const std::size_t count = draw.child_count();
  const auto turn = [&](std::size_t i) {
    return i < count ? build.turn(i) : build.at("decide");
  };
  draw.edge(build.body(), turn(0));
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<Reaction> next = {{turn(i + 1)}};
    const Reactions on{next, next, next, next};
    if (draw.node().type == NodeType::OtherDecorator) {
      draw.edge(turn(i), build.tick_only_child(on));
    } else {
      const LocationId calling = build.tick(i, on);
      draw.edge(turn(i), calling);
      const Expression ended =
          both(negated(build.is_idle(i)), negated(build.is_running(i)));
      draw.choice(turn(i), calling, ended,
                  {set(build.status(i), NodeStatus::NoRetStatus)},
                  "ticks a child anew");
    }
    if (draw.context().answers[index(draw.child(i))].runs) {
      const LocationId resets = build.at("reset_" + std::to_string(i + 1));
      draw.choice(turn(i), resets, build.is_running(i), {}, "halts a child");
      build.reset(resets, turn(i), {i});
    }
    draw.choice(turn(i), turn(i + 1), {}, {}, "leaves out a child");
  }
  const LocationId end = turn(count);
  draw.choice(end, build.running(), {}, {}, "answers running");
  draw.choice(end, build.resetting("end_success", build.success()), {}, {},
              "answers success");
  draw.choice(end, build.resetting("end_failure", build.failure()), {}, {},
              "answers failure");
  build.on_halt();
}

constexpr Drawing kEngineDecoratorRows[] = {
    {NodeType::Inverter, draw_engine_decorator},
    {NodeType::ForceSuccess, draw_engine_decorator},
    {NodeType::ForceFailure, draw_engine_decorator},
    {NodeType::KeepRunningUntilFailure, draw_engine_decorator},
    {NodeType::SubTree, draw_engine_decorator},
    {NodeType::GoalUpdater, draw_engine_decorator},
    {NodeType::Repeat, draw_engine_repeat},
    {NodeType::RetryUntilSuccessful, draw_engine_repeat},
    {NodeType::Precondition, draw_precondition},
    {NodeType::RunOnce, draw_run_once},
    {NodeType::Loop, draw_loop},
    {NodeType::WhenUpdated, draw_when_updated},
    {NodeType::BlackboardCheck, draw_blackboard_check},
    {NodeType::OtherControl, draw_other_node},
    {NodeType::OtherDecorator, draw_other_node}};

}  // namespace

constinit const Family kEngineDecoratorDrawings = kEngineDecoratorRows;

}  // namespace btcheck::mapping
