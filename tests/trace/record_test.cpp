// SPDX-License-Identifier: MIT
//
// Which steps are told, in which words, and which of them the world chose; and
// what every node is doing in every state of a run.
#include "trace/run/record.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "trace/told.hpp"

namespace btcheck::record_test {
namespace {

// --- Steps ------------------------------------------------------------------

// The events of a run; those chosen by the world end in " *".
std::vector<std::string> events_of(const Lowered& model, const Run& run) {
  std::vector<std::string> events;
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const auto event =
        event_of(model.tree, model.network, run.state(i), run.steps[i]);
    if (event) events.push_back(event->text + (event->is_chosen ? " *" : ""));
  }
  return events;
}

using Events = std::vector<std::string>;

TEST_CASE("leaves answer, and the root ends; the rest is not told") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence (Condition :ID c) (Action :ID a)))");
  Run run = scripted(model, {"c -> success", "a -> running", "a -> failure"});
  go_to_end(model, run);
  CHECK(events_of(model, run) == Events{"c -> success *", "a -> running *",
                                        "a -> failure *", "t -> failure"});
}

TEST_CASE("nodes of the same name are told by their lines") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence (Action :ID a :SF)\n"
      " (Action :ID a :SF)))");
  const Run run = scripted(model, {"a@1 -> success", "a@2 -> success"});
  CHECK(events_of(model, run) ==
        Events{"a@1 -> success *", "a@2 -> success *"});
}

TEST_CASE("a halted leaf is told, not its parents") {
  const Lowered model(
      "(BehaviorTree :name t (ReactiveSequence :halt 1"
      " (Condition :ID c) (Inverter (Action :ID a))))");
  Run run = scripted(model, {"c -> success", "a -> running", "c -> failure"});
  go_to_end(model, run);
  CHECK(events_of(model, run) == Events{"c -> success *", "a -> running *",
                                        "c -> failure *", "a is halted",
                                        "t -> failure"});
}

TEST_CASE("a measurement is chosen, an assignment is not") {
  const Lowered model(
      "(defsv b :states (Good Low)) (defsv k :max 3)"
      "(BehaviorTree :name t (Sequence (SetSV :ID measure :sv b)"
      " (Eval :name up (:= k (+ k 1))) (Eval :name same (:= k 1))"
      " (Eval :name full (= b Good))))");
  Run run = scripted(model, {"measure: b := Low"});
  go_to_end(model, run);
  CHECK(events_of(model, run) == Events{"measure: b := Low *", "up: k := 1",
                                        "same: k := 1", "full -> failure",
                                        "t -> failure"});
}

TEST_CASE("a measurement that finds nothing new is told as well") {
  const Lowered model(
      "(defsv b :states (Good Low))"
      "(BehaviorTree :name t (SetSV :ID measure :sv b))");
  const Run run = scripted(model, {"measure: b := Good"});
  CHECK(events_of(model, run) == Events{"measure: b := Good *"});
}

TEST_CASE("the weather moves by itself") {
  const Lowered model(
      "(defsv w :states (Calm Storm))"
      "(BehaviorTree :name t (Eval :name e (= w Calm)))");
  CHECK(events_of(model, scripted(model, {"w := Storm"})) ==
        Events{"w := Storm *"});
}

TEST_CASE("the effects of an answer are told with it") {
  const Lowered model(
      "(defsv k :max 3) (defsv b :states (Good Low))"
      "(defaction a :on-success ((:= k 2) (:= b Low)))"
      "(BehaviorTree :name t (Action :ID a :SF))");
  CHECK(events_of(model, scripted(model, {"a -> success: k := 2, b := Low"})) ==
        Events{"a -> success: k := 2, b := Low *"});
}

TEST_CASE("a fault says what went wrong") {
  const Lowered model(
      "(defsv k :max 3)"
      "(BehaviorTree :name t (Sequence (Action :ID a :SF)"
      " (Eval :name e (:= k (+ k 9)))))");
  Run run = scripted(model, {"a -> success"});
  go_on(model, run, 12);
  CHECK(events_of(model, run) ==
        Events{"a -> success *", "e: leaves the range of a variable"});
}

TEST_CASE("a timer is told when it is up; only a free length is chosen") {
  const Lowered fixed("(BehaviorTree :name t (Wait :name w :duration 1))");
  Run run;
  run.initial = NetworkInterpreter(fixed.network).initial();
  go_to_end(fixed, run);
  CHECK(events_of(fixed, run) == Events{"w -> running", "the time of w is up",
                                        "w -> success", "t -> success"});
  const Lowered open("(BehaviorTree :name t (Action :ID a :duration [1,2]))");
  const Run early = scripted(open, {"the time of a is up"});
  CHECK(events_of(open, early).back() == "the time of a is up *");
}

TEST_CASE("any step at all has a text") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence :name s"
      " (Action :ID a)))");
  const Run run = scripted(model, {"a -> success"});
  REQUIRE(run.steps.size() >= 6);
  const auto text = [&](std::size_t i) {
    return step_text(model.network, run.steps[i]);
  };
  CHECK(text(0) ==
        "t_btn0: start_ -> tick_node, t_btn0.rstatus := no_ret_status");
  CHECK(text(1) == "time passes");
  CHECK(text(2) == "t_btn0: tick_node -> s_btn1");
  CHECK(text(3) == "t_btn0: s_btn1 -> s_btn1_done, s_btn1.caller := t_btn0");
  CHECK(text(run.steps.size() - 1) == "a_btn2: tick_node -> success");
  CHECK(!event_of(model.tree, model.network, run.state(1), run.steps[1]));
}

// --- Runs -------------------------------------------------------------------

RecordedRun record_of(const Lowered& model, const Run& run) {
  return recorded(model.tree, model.network, run, {{"p", "P", "VIOLATED"}});
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
  CHECK(!record.back.step.empty());
  CHECK(record.trigger == kNoState);
  CHECK(record.lost == kNoState);
}

TEST_CASE("what is watched is told state by state") {
  const Lowered model(kTree);
  const Run run = scripted(model, {"a -> success"});
  RunHeading heading{{"p", "P", "VIOLATED"}};
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
}  // namespace btcheck::record_test
