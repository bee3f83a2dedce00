// SPDX-License-Identifier: MIT
//
// Decorators of py_trees. Each ticks its child first; when it ends while its
// child runs, it stops that. A child that has ended keeps its status.
#include <optional>
#include <utility>

#include "model/mapping/py_trees/drawings.hpp"

namespace btcheck::mapping {
namespace {

using enum NodeStatus;

// Stops its child, which runs, and answers.
LocationId stopping(PyTreesBuilder& build, LocationId answer,
                    const std::vector<Assignment>& updates = {}) {
  return build.once("stops", [&](LocationId from) {
    build.stop(from, answer, {0}, updates);
  });
}

// Answers as the table says, by what its child answers.
void draw_map(NodeBuilder& draw, const AnswerTable& becomes) {
  PyTreesBuilder build(draw);
  const LocationId of_running = build.answering(becomes.of_running);
  draw.edge(
      build.body(),
      build.tick(0, {.success = {{build.answering(becomes.of_success)}},
                     .failure = {{build.answering(becomes.of_failure)}},
                     .running = {{becomes.of_running == NodeStatus::Running
                                      ? of_running
                                      : stopping(build, of_running)}}}));
  build.on_stop();
}

void draw_answer_map(NodeBuilder& draw) { draw_map(draw, draw.node().becomes); }
template <NodeStatus on_success, NodeStatus on_failure>
void draw_map(NodeBuilder& draw) {
  draw_map(draw, {on_success, on_failure});
}

// Repeat and Retry: one round a tick. `count` counts the rounds that are done.
void draw_py_trees_rounds(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  const bool repeats = draw.node().type == NodeType::Repeat;
  const int rounds = draw.node().repetitions;
  const LocationId over = repeats ? build.success() : build.failure();
  std::optional<VariableId> done;
  if (rounds > 1) done = draw.rounds("count", rounds - 1);
  const std::vector<Assignment> clear = set_if_there(done, 0);
  std::vector<Reaction> counted = {{rounds < 0 ? build.running() : over}};
  if (done) {
    const Expression is_last = at_least(*done, rounds - 1);
    counted = {{build.running(), {count(*done)}, negated(is_last)},
               {over, clear, is_last}};
  }
  const std::vector<Reaction> stops = {
      {repeats ? build.failure() : build.success(), clear}};
  draw.edge(build.body(), build.tick(0, {repeats ? counted : stops,
                                         repeats ? stops : counted}));
  build.on_stop(clear);
}

// The first answer that its policy asks for is kept for ever. `option`: a
// failure is one, too.
void draw_py_trees_one_shot(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  const bool keeps_failure = draw.node().option;
  // 1: has succeeded; 2: has failed.
  const VariableId ended = draw.local("ended", 0, keeps_failure ? 2 : 1, 0);
  Reaction failed{build.failure()};
  if (keeps_failure) failed.updates = {set(ended, 2)};
  draw.edge(build.body(),
            build.tick(0, {.success = {{build.success(), {set(ended, 1)}}},
                           .failure = {failed}}),
            equals(ended, 0));
  draw.edge(build.body(), build.success(), equals(ended, 1), {},
            "has succeeded once");
  if (keeps_failure) {
    draw.edge(build.body(), build.failure(), equals(ended, 2), {},
              "has failed once");
  }
  build.on_stop();
}

// Fails where its child still runs when the time is up, which it looks at
// behind each tick of the child.
void draw_py_trees_timeout(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  std::optional<Timer> timer;
  if (draw.takes_time()) timer = draw.add_timer();
  const std::vector<Assignment> ends =
      timer ? std::vector<Assignment>{timer->stop()}
            : std::vector<Assignment>{};
  Reactions reactions{.success = {{build.success(), ends}},
                      .failure = {{build.failure(), ends}}};
  const LocationId expired = stopping(build, build.failure(), ends);
  if (timer) {
    reactions.running = {{expired, {}, timer->is_due()},
                         {build.running(), {}, negated(timer->is_due())}};
  } else {
    reactions.running = {{expired}};
  }
  const LocationId calling = build.tick(0, std::move(reactions));
  if (timer) {
    draw.edge(build.body(), calling, timer->is_idle(), {timer->start()},
              "starts its timer");
    draw.edge(build.body(), calling, negated(timer->is_idle()));
  } else {
    draw.edge(build.body(), calling);
  }
  build.on_stop(ends);
}

constexpr Drawing kPyTreesDecoratorRows[] = {
    {NodeType::Inverter, draw_map<Failure, Success>},
    {NodeType::ForceSuccess, draw_map<Success, Success>},
    {NodeType::ForceFailure, draw_map<Failure, Failure>},
    {NodeType::KeepRunningUntilFailure, draw_map<Running, Failure>},
    {NodeType::SubTree, draw_map<Success, Failure>},
    {NodeType::AnswerMap, draw_answer_map},
    {NodeType::Repeat, draw_py_trees_rounds},
    {NodeType::RetryUntilSuccessful, draw_py_trees_rounds},
    {NodeType::RunOnce, draw_py_trees_one_shot},
    {NodeType::Timeout, draw_py_trees_timeout}};

}  // namespace

constinit const Family kPyTreesDecoratorDrawings = kPyTreesDecoratorRows;

}  // namespace btcheck::mapping
