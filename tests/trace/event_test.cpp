// SPDX-License-Identifier: MIT
//
// Which steps are told, in which words, and which of them the world chose.
#include "trace/run/event.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "trace/told.hpp"

namespace btcheck {
namespace {

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

}  // namespace
}  // namespace btcheck
