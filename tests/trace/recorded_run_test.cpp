// SPDX-License-Identifier: MIT
//
// Going along a run: its loop, its ticks, the state worth showing.
#include "trace/run/recorded_run.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "trace/recorded_run_maker.hpp"

namespace btcheck::recorded_run_test {
namespace {

// A run of one root with these phases and ticks.
RecordedRun run_of(const std::vector<std::pair<Phase, int>>& states) {
  RecordedRun run;
  run.nodes.emplace_back();
  for (const auto& [phase, tick] : states) {
    RecordedState state;
    state.phases = {phase};
    state.is_stale = {false};
    state.tick = tick;
    run.states.push_back(state);
  }
  return run;
}

std::vector<int> ticks_of(const std::vector<Passing>& passings) {
  std::vector<int> ticks;
  for (const Passing& passing : passings) ticks.push_back(passing.tick);
  return ticks;
}

TEST_CASE("the step back begins a tick where it wakes a root") {
  RecordedRun run = run_of({{Phase::Unvisited, 0},
                            {Phase::Here, 1},
                            {Phase::Running, 1},
                            {Phase::Here, 2},
                            {Phase::Running, 2}});
  run.loop = 1;
  CHECK(ticks_of(unrolled(run, 2)) ==
        std::vector<int>{0, 1, 1, 2, 2, 3, 3, 4, 4});
  run.loop = 2;  // from the root at rest to the root at rest
  CHECK(ticks_of(unrolled(run, 3)) ==
        std::vector<int>{0, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4});
  CHECK(unrolled(run, 2).back().state == 4);
  run.loop = kNoState;
  CHECK(ticks_of(unrolled(run, 3)) == std::vector<int>{0, 1, 1, 2, 2});
}

TEST_CASE("each tick has its last state") {
  CHECK(tick_ends(run_of({{Phase::Unvisited, 0},
                          {Phase::Here, 1},
                          {Phase::Running, 1},
                          {Phase::Here, 2}})) ==
        std::vector<std::size_t>{2, 3});
  CHECK(tick_ends(run_of({{Phase::Unvisited, 0}, {Phase::Unvisited, 0}})) ==
        std::vector<std::size_t>{1});
}

TEST_CASE("one picture shows where the property is lost, else the end") {
  RecordedRun run = looping_run();
  CHECK(shown_state(run) == run.lost);
  CHECK(run.lost + 1 < run.states.size());
  run.lost = kNoState;
  CHECK(shown_state(run) == run.states.size() - 1);
}

}  // namespace
}  // namespace btcheck::recorded_run_test
