// SPDX-License-Identifier: MIT
//
// The text of a run, to the letter.
#include "trace/formats/text.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "trace/told.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kTree =
    "(BehaviorTree :name t (Sequence :name s"
    " (Condition :ID c) (Action :ID a)))";

// A line with "chosen" in its column.
std::string chosen(std::string line) {
  line.resize(62, ' ');
  return line + "chosen\n";
}

std::string text_of_run(const Lowered& model, const Run& run,
                        const TextStyle& style = {}) {
  return run_text(model.tree, model.network, run, style);
}

TEST_CASE("a short run is told tick by tick") {
  const Lowered model(kTree);
  Run run = scripted(model, {"c -> success", "a -> running", "a -> success"});
  go_to_end(model, run);
  CHECK(text_of_run(model, run) == chosen("    tick 1   c -> success") +
                                       chosen("             a -> running") +
                                       chosen("    tick 2   a -> success") +
                                       "             t -> success\n");
}

TEST_CASE("under nodes time is told, not ticks") {
  const Lowered model(kTree, TickSemantics::Nodes);
  const Run run = scripted(model, {"c -> success", "a -> success"});
  CHECK(text_of_run(model, run) == chosen("    time 3   c -> success") +
                                       chosen("    time 4   a -> success"));
}

TEST_CASE("what happens before the first tick stands under start") {
  const Lowered model(
      "(defsv w :states (Calm Storm))"
      "(BehaviorTree :name t (Eval :name e (= w Calm)))");
  const Run run = scripted(model, {"w := Storm", "w := Calm"});
  CHECK(text_of_run(model, run) ==
        chosen("    start    w := Storm") + chosen("             w := Calm"));
}

TEST_CASE("a halt is told when it is done") {
  const Lowered model(
      "(BehaviorTree :name t (ReactiveSequence :halt 1"
      " (Condition :ID c) (Action :ID a)))");
  Run run = scripted(model, {"c -> success", "a -> running", "c -> failure"});
  go_to_end(model, run);
  CHECK(text_of_run(model, run) == chosen("    tick 1   c -> success") +
                                       chosen("             a -> running") +
                                       chosen("    tick 2   c -> failure") +
                                       "             a is halted\n"
                                       "             t -> failure\n");
}

TEST_CASE("a loop is marked where it begins and where it closes") {
  const Lowered model(kTree);
  Run run = scripted(
      model, {"c -> success", "a -> running", "a -> running", "a -> running"});
  close_loop(run);
  CHECK(text_of_run(model, run) == chosen("    tick 1   c -> success") +
                                       chosen("             a -> running") +
                                       chosen("    tick 2   a -> running") +
                                       "    -- the loop begins\n" +
                                       chosen("    tick 3   a -> running") +
                                       "    -- this repeats for ever\n");
}

TEST_CASE("a tree that has ended stays as it is") {
  const Lowered model(kTree);
  Run run = scripted(model, {"c -> failure"});
  go_to_end(model, run);
  go_on(model, run, 1);
  close_loop(run);
  CHECK(text_of_run(model, run) ==
        chosen("    tick 1   c -> failure") +
            "             t -> failure\n"
            "    -- the loop begins\n"
            "    -- the run stays here for ever while time passes\n");
}

TEST_CASE("the state that is not answered is marked") {
  const Lowered model(kTree);
  const Run run =
      scripted(model, {"c -> success", "a -> running", "a -> running"});
  TextStyle style;
  std::size_t asked = 0;
  while (step_text(model.network, run.steps[asked]) !=
         "a_btn3: tick_node -> running") {
    ++asked;
  }
  style.trigger_state = asked + 1;
  CHECK(text_of_run(model, run, style) ==
        chosen("    tick 1   c -> success") +
            chosen("             a -> running") +
            "             -- asked here, not answered\n" +
            chosen("    tick 2   a -> running"));
  style.trigger_state = run.steps.size();
  CHECK(text_of_run(model, run, style)
            .ends_with("chosen\n             -- asked here, not answered\n"));
}

TEST_CASE("every step can be told, with an indent of one's own") {
  const Lowered model("(BehaviorTree :name t (Action :ID a :SF))");
  const Run run = scripted(model, {"a -> success"});
  TextStyle style;
  style.detail = Detail::EveryStep;
  style.indent = "";
  CHECK(text_of_run(model, run, style) ==
        "start    t_btn0: start_ -> tick_node, t_btn0.rstatus := "
        "no_ret_status\n"
        "tick 1   time passes\n"
        "         t_btn0: tick_node -> a_btn1\n"
        "         t_btn0: a_btn1 -> a_btn1_done, a_btn1.caller := t_btn0\n"
        "         a_btn1: start_ -> tick_node, a_btn1.rstatus := "
        "no_ret_status\n" +
            chosen("         a -> success"));
}

TEST_CASE("a run of no steps has no text") {
  const Lowered model(kTree);
  Run run;
  run.initial = NetworkInterpreter(model.network).initial();
  CHECK(text_of_run(model, run) == "");
}

std::ptrdiff_t lines_in(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST_CASE("a run is cut after four hundred events, not steps") {
  const Lowered model("(BehaviorTree :name t (Action :ID a))");
  const Run short_run =
      scripted(model, std::vector<std::string>(400, "a -> running"));
  CHECK(short_run.steps.size() > 2000);
  CHECK(lines_in(text_of_run(model, short_run)) == 400);
  CHECK(text_of_run(model, short_run).find("more") == std::string::npos);
  const Run long_run =
      scripted(model, std::vector<std::string>(402, "a -> running"));
  const std::string text = text_of_run(model, long_run);
  CHECK(lines_in(text) == 401);
  CHECK(text.ends_with("    -- 2 more steps\n"));
}

}  // namespace
}  // namespace btcheck
