// SPDX-License-Identifier: MIT
//
// What every node is doing in every state of a run.
#include "trace/run/record.hpp"

#include <doctest/doctest.h>

#include "trace/told.hpp"

namespace btcheck {
namespace {

RecordedRun record_of(const Lowered& model, const Run& run) {
  return recorded(model.tree, model.network, run, {"p", "P", "VIOLATED"});
}

// The first state after the step, from a state on.
std::size_t after(const RecordedRun& run, const std::string& step,
                  std::size_t from = 0) {
  for (std::size_t i = from; i < run.states.size(); ++i) {
    if (run.states[i].step.rfind(step, 0) == 0) return i;
  }
  FAIL("no such step: " << step);
  return 0;
}

constexpr std::string_view kTree =
    "(BehaviorTree :name t (Sequence :name s\n"
    "  (Action :ID a) (Action :ID b)))";

TEST_CASE("a node is here, waits, and is left with what it returned") {
  const Lowered model(kTree);
  const RecordedRun run = record_of(
      model, scripted(model, {"a -> success", "b -> running", "b -> success"}));
  const auto phases = [&](std::size_t state) {
    return run.states[state].phases;
  };
  CHECK(phases(0) == std::vector<Phase>(4, Phase::Unvisited));
  const std::size_t ticked = after(run, "a_btn2: start_ -> tick_node");
  CHECK(phases(ticked) == std::vector<Phase>{Phase::Waiting, Phase::Waiting,
                                             Phase::Here, Phase::Unvisited});
  CHECK(run.states[ticked].tick == 1);
  CHECK(run.states[ticked].mover == 2);
  const std::size_t second = after(run, "b_btn3: start_ -> tick_node");
  CHECK(phases(second) == std::vector<Phase>{Phase::Waiting, Phase::Waiting,
                                             Phase::Success, Phase::Here});
  CHECK(!run.states[second].is_stale[2]);
  // In the second tick a is not ticked again: what it returned is old.
  const std::size_t again =
      after(run, "b_btn3: start_ -> tick_node", second + 1);
  CHECK(run.states[again].tick == 2);
  CHECK(phases(again)[2] == Phase::Success);
  CHECK(run.states[again].is_stale ==
        std::vector<bool>{false, false, true, false});
  CHECK(phases(again)[3] == Phase::Here);
}

TEST_CASE("between two ticks nobody is ticked, and b runs") {
  const Lowered model(kTree);
  const RecordedRun run = record_of(
      model, scripted(model, {"a -> success", "b -> running", "b -> success"}));
  const std::size_t passes = after(run, "t_btn0: start_ -> tick_node", 5);
  CHECK(run.states[passes - 1].phases ==
        std::vector<Phase>{Phase::Running, Phase::Running, Phase::Success,
                           Phase::Running});
}

TEST_CASE("a tree that has ended is left with what it returned") {
  const Lowered model(kTree);
  Run run = scripted(model, {"a -> success", "b -> success"});
  go_on(model, run, 6);
  const RecordedRun record = record_of(model, run);
  CHECK(record.states.back().locations[0] == "success");
  CHECK(record.states.back().phases == std::vector<Phase>(4, Phase::Success));
}

TEST_CASE("who is halted is halting first") {
  const Lowered model(
      "(BehaviorTree :name t (ReactiveSequence :name r :halt 1\n"
      "  (Condition :ID c) (Action :ID a)))");
  Run run = scripted(model, {"c -> success", "a -> running", "c -> failure"});
  go_on(model, run, 12);
  const RecordedRun record = record_of(model, run);
  const std::size_t halted = after(record, "a_btn3: halt -> halted");
  CHECK(record.states[halted].event == "a is halted");
  CHECK(record.states[halted - 1].phases[3] == Phase::Halting);
  CHECK(record.states[halted].phases[3] == Phase::Halting);
  const std::size_t done = after(record, "a_btn3: halted -> done");
  CHECK(record.states[done].phases[3] == Phase::Halting);
  CHECK(record.states.back().phases[3] == Phase::Halted);
  CHECK(!record.states.back().is_stale[3]);
}

TEST_CASE("a loop ends with the state before it closes") {
  const Lowered model(kTree);
  Run run = scripted(
      model, {"a -> success", "b -> running", "b -> running", "b -> running"});
  close_loop(run);
  const RecordedRun record = record_of(model, run);
  CHECK(record.states.size() == run.steps.size());
  CHECK(record.loop == run.loop);
  CHECK(!record.back.empty());
  CHECK(record.trigger == kNoState);
  CHECK(record.lost == kNoState);
}

TEST_CASE("what is watched is told state by state") {
  const Lowered model(kTree);
  const Run run = scripted(model, {"a -> success"});
  RunHeading heading{"p", "P", "VIOLATED"};
  std::vector<bool> truth(run.state_count());
  truth.back() = true;
  heading.watched = {{"a.success", truth}};
  heading.lost = run.steps.size();
  const RecordedRun record = recorded(model.tree, model.network, run, heading);
  CHECK(record.atoms == std::vector<std::string>{"a.success"});
  CHECK(record.states.back().atoms == std::vector<bool>{true});
  CHECK(record.states.front().atoms == std::vector<bool>{false});
  CHECK(record.lost == run.steps.size());
}

}  // namespace
}  // namespace btcheck
