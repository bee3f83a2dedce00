// SPDX-License-Identifier: MIT
//
// Control nodes and decorators of Nav2 (nav2_behavior_tree/plugins/control and
// …/decorator, branches galactic, humble, jazzy and main); RateController is in
// time.cpp.
// Their retries and turns survive a reset that finds them not running, because
// the engine calls halt() on running nodes only.
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {
namespace {

// The updates of a node that has halted itself: it is idle when it answers
// skipped.
std::vector<Assignment> halted(EngineBuilder& build,
                               std::vector<Assignment> updates) {
  updates.push_back(set(build.status(), NodeStatus::NoRetStatus));
  return updates;
}

// Child 1 is the work, child 2 the recovery; `retry` counts the recoveries
// done, `next` is the child to be ticked.
void draw_recovery_node(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const int retries = draw.node().repetitions;
  constexpr std::size_t kWork = 0;
  constexpr std::size_t kRecovery = 1;
  std::optional<VariableId> retry;
  if (retries > 0) retry = draw.rounds("retry", retries);
  const VariableId next = draw.local("next", 1, 2, 1);
  const std::vector<Assignment> fresh =
      joined({set(next, 1)}, set_if_there(retry, 0));
  const LocationId passes = build.resetting("passes", build.success(), fresh);
  const LocationId fails = build.resetting("fails", build.failure(), fresh);

  const LocationId again = build.at("again");
  const LocationId recover = build.at("recover");
  Reactions work;
  work.success = {{passes}};
  if (build.may_skip(kWork)) {
    work.skipped = {
        {build.resetting("skips", build.at("skipped"), halted(build, fresh))}};
  }
  if (retry) {
    work.failure = {{recover, {}, negated(at_least(*retry, retries))},
                    {fails, {}, at_least(*retry, retries)}};
  } else {
    work.failure = {{fails}};
  }
  const LocationId working = build.tick(kWork, std::move(work));
  Reactions recovery;
  recovery.success = {{again}};
  recovery.failure = {{fails}};
  if (build.may_skip(kRecovery)) {
    // A recovery that was skipped while it ran is halted; that is no retry.
    const LocationId gives_up = build.at("gives_up");
    build.reset(gives_up, build.failure(), {kRecovery}, {set(next, 1)});
    recovery.skipped = {{gives_up}};
  }
  const LocationId recovering = build.tick(kRecovery, std::move(recovery));
  build.reset(recover, recovering, {kWork}, {set(next, 2)});
  std::vector<Assignment> counted = {set(next, 1)};
  if (retry) counted.push_back(count(*retry));
  build.reset(again, working, {kRecovery}, counted);
  draw.edge(build.body(), working, equals(next, 1));
  draw.edge(build.body(), recovering, equals(next, 2));
  build.on_halt(fresh);
}

// Ticks its children in turn. `next` is the child whose turn it is, which the
// node keeps when it succeeds; `failed` is how many have failed in a row. On
// main, without wrap_around, the node ends after its last child, even one that
// has succeeded.
void draw_engine_round_robin(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const int children = static_cast<int>(draw.child_count());
  const bool wraps = draw.node().option;
  const VariableId next = draw.local("next", 1, children, 1);
  const VariableId failed = draw.local("failed", 0, children, 0);
  std::optional<VariableId> skipped;
  if (build.some_child_may_skip())
    skipped = draw.local("skipped", 0, children, 0);
  const std::vector<Assignment> fresh =
      joined({set(next, 1), set(failed, 0)}, set_if_there(skipped, 0));

  const LocationId over = build.at("over");
  const LocationId turn = build.at("turn");
  const LocationId passes =
      build.resetting("passes", build.success(), {set(failed, 0)});
  // All others have not succeeded in this round.
  const Expression is_last_tried = Expression::binary(
      Operation::GreaterEqual,
      skipped ? Expression::binary(Operation::Add, read(failed), read(*skipped))
              : read(failed),
      Expression::constant(children - 1));
  draw.edge(build.body(), turn, {}, set_if_there(skipped, 0));
  for (int i = 1; i <= children; ++i) {
    const std::size_t child = static_cast<std::size_t>(i - 1);
    const bool breaks = i == children && !wraps;
    const std::vector<Assignment> moves = {
        set(next, i == children ? 1 : i + 1)};
    // Goes on, or is over when this was the last to be tried.
    const auto counted = [&](VariableId counter) {
      const std::vector<Assignment> updates = joined(moves, {count(counter)});
      return std::vector<Reaction>{{turn, updates, negated(is_last_tried)},
                                   {over, updates, is_last_tried}};
    };
    Reactions reactions;
    if (breaks) {
      reactions.success = reactions.failure = {{over}};
      if (skipped) reactions.skipped = {{over, {count(*skipped)}}};
    } else {
      reactions.success = {{passes, moves}};
      reactions.failure = counted(failed);
      if (skipped) reactions.skipped = counted(*skipped);
    }
    draw.edge(turn, build.tick(child, std::move(reactions)), equals(next, i));
  }
  if (build.every_child_may_skip()) {
    build.reset(over, build.failure(), build.all_children(), fresh,
                differs(*skipped, children));
    build.reset(over, build.at("skipped"), build.all_children(),
                halted(build, fresh), equals(*skipped, children));
  } else {
    build.reset_all(over, build.failure(), fresh);
  }
  build.on_halt(fresh);
}

// Every tick goes from child 1 up to the furthest that has been reached; a
// running child before that one lets the next be ticked. Children keep their
// status until the pipeline ends, so that a stateful one that has ended
// answers the same until then.
void draw_engine_pipeline(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const int children = static_cast<int>(draw.child_count());
  const VariableId furthest = draw.local("furthest", 1, children, 1);
  std::optional<VariableId> all_skipped;
  if (build.every_child_may_skip()) {
    all_skipped = draw.local("all_skipped", 0, 1, 1);
  }
  const auto noted = [&](int value) {
    return set_if_there(all_skipped, value);
  };
  const std::vector<Assignment> fresh = {set(furthest, 1)};
  const LocationId fails = build.resetting("fails", build.failure(), fresh);
  const LocationId end = build.at("end");
  draw.edge(build.body(), build.turn(0), {}, noted(1));
  for (int i = 1; i <= children; ++i) {
    const std::size_t child = static_cast<std::size_t>(i - 1);
    const LocationId next = build.turn(child + 1);
    const Expression is_furthest = Expression::binary(
        Operation::LessEqual, read(furthest), Expression::constant(i));
    Reactions reactions{.success = {{next, noted(0)}},
                        .failure = {{fails}},
                        .running = {{build.running(), {set(furthest, i)}}},
                        .skipped = {{next}}};
    if (i < children) {
      reactions.running[0].guard = is_furthest;
      reactions.running.push_back({next, noted(0), negated(is_furthest)});
    }
    draw.edge(build.turn(child), build.tick(child, std::move(reactions)));
  }
  if (all_skipped) {
    build.end(end, build.success(), fresh, equals(*all_skipped, 0),
              equals(*all_skipped, 1));
  } else {
    build.reset_all(end, build.success(), fresh);
  }
  build.on_halt(fresh);
}

// All children in every tick, ended ones as well; one that is skipped is an
// exception.
void draw_nonblocking_sequence(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const std::size_t count = draw.child_count();
  const VariableId open = draw.local("open", 0, 1, 0);
  const LocationId fails = build.resetting("fails", build.failure());
  const LocationId confused = build.at("child_skipped");
  draw.edge(build.body(), build.turn(0), {}, {set(open, 0)});
  for (std::size_t i = 0; i < count; ++i) {
    const LocationId next = build.turn(i + 1);
    draw.edge(build.turn(i), build.tick(i, {.success = {{next}},
                                            .failure = {{fails}},
                                            .running = {{next, {set(open, 1)}}},
                                            .skipped = {{confused}}}));
  }
  const LocationId end = build.turn(count);
  draw.edge(end, build.running(), equals(open, 1));
  build.reset(end, build.success(), build.all_children(), {}, equals(open, 0));
  if (build.some_child_may_skip()) {
    build.throws(confused, {}, "a child is skipped");
  }
  build.on_halt();
}

// Children: while resumed, while paused, on pausing, on resuming. Requests may
// come before any tick, several at once: to pause whatever it does, to resume
// while it is paused. Only they reset its children; those that have ended
// otherwise keep their status.
void draw_pause_resume(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  constexpr int kResumed = 0;
  constexpr int kPaused = 1;
  constexpr int kOnPause = 2;
  constexpr int kOnResume = 3;
  const int count = static_cast<int>(draw.child_count());
  const VariableId state = draw.local("state", 0, 3, kResumed);
  // What each state leads to when its child has ended.
  constexpr std::array<int, 4> kFollows = {kResumed, kPaused, kPaused,
                                           kResumed};
  const LocationId listens = build.at("listens");
  build.start_anew(listens, {set(state, kResumed)});
  const auto enter = [&](int now) {
    return build.at("state_" + std::to_string(now));
  };
  for (int now = kResumed; now <= kOnResume; ++now) {
    draw.edge(listens, enter(now), equals(state, now));
    const std::vector<Assignment> follows = {
        set(state, kFollows[static_cast<std::size_t>(now)])};
    if (now >= count) {
      draw.edge(enter(now), build.running(), {}, follows);
      continue;
    }
    const Reaction ends = now == kResumed ? Reaction{build.success()}
                                          : Reaction{build.running(), follows};
    draw.edge(enter(now), build.tick(static_cast<std::size_t>(now),
                                     {.success = {ends},
                                      .failure = {{build.failure()}},
                                      .skipped = {ends}}));
  }
  const LocationId pausing = build.at("pausing");
  const LocationId resuming = build.at("resuming");
  draw.choice(listens, pausing, differs(state, kPaused), {},
              "is asked to pause");
  draw.choice(listens, pausing, equals(state, kPaused), {},
              "is asked to resume, and to pause");
  draw.choice(listens, resuming, equals(state, kPaused), {},
              "is asked to resume");
  build.reset_all(pausing, enter(kOnPause), {set(state, kOnPause)});
  build.reset_all(resuming, enter(kOnResume), {set(state, kOnResume)});
  build.on_halt({set(state, kResumed)});
}

// DistanceController, SpeedController, GoalUpdatedController: the child is
// ticked on activation, while it runs, and whenever the world says so. Of the
// SpeedController of galactic only the first activation counts.
void draw_when_due(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  std::optional<VariableId> fresh;
  if (draw.node().option) fresh = draw.local("fresh", 0, 1, 1);
  const Expression begins = fresh ? equals(*fresh, 1) : build.was_idle();
  const Expression must = either(begins, build.is_running(0));
  Reactions reactions = build.passing();
  if (draw.node().contract.may_fail) {
    const LocationId ended = build.at("child_succeeded");
    reactions.success = {{ended}};
    draw.choice(ended, build.success(), {}, {}, "knows its pose");
    draw.choice(ended, build.failure(), {}, {}, "knows no pose");
  }
  draw.choice(build.body(), build.tick_only_child(std::move(reactions)), {},
              set_if_there(fresh, 0), "it is due");
  draw.choice(build.body(), build.running(), negated(must), {}, "not yet");
  // The robot's pose may be unknown.
  if (draw.node().contract.may_fail) {
    draw.choice(build.body(), build.failure(), {}, {}, "knows no pose");
  }
  build.on_halt();
}

// Success without a tick of the child unless the path has become longer; a
// child that runs is then left as it is.
void draw_path_longer_on_approach(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const VariableId first = draw.local("first", 0, 1, 1);
  draw.choice(build.body(), build.tick_only_child(build.passing()),
              equals(first, 0), {}, "the path has become longer");
  draw.choice(build.body(), build.success(), {}, {set(first, 0)},
              "the path is no longer than before");
  build.on_halt();
}

// Until its child has ended once; then failure, until the node is reset.
void draw_single_trigger(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const VariableId done = draw.local("done", 0, 1, 0);
  const LocationId look = build.at("look");
  Reactions reactions = build.passing({set(done, 1)});
  build.start_anew(look, {set(done, 0)});
  draw.edge(look, build.tick_only_child(std::move(reactions)), equals(done, 0));
  draw.edge(look, build.failure(), equals(done, 1));
  build.on_halt();
}

constexpr Drawing kNav2Rows[] = {
    {NodeType::Recovery, draw_recovery_node},
    {NodeType::RoundRobin, draw_engine_round_robin},
    {NodeType::PipelineSequence, draw_engine_pipeline},
    {NodeType::NonblockingSequence, draw_nonblocking_sequence},
    {NodeType::PauseResumeController, draw_pause_resume},
    {NodeType::WhenDue, draw_when_due},
    {NodeType::PathLongerOnApproach, draw_path_longer_on_approach},
    {NodeType::SingleTrigger, draw_single_trigger}};

}  // namespace

constinit const Family kNav2Drawings = kNav2Rows;

}  // namespace btcheck::mapping
