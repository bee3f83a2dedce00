// SPDX-License-Identifier: MIT
//
// Each explanation once where it is true, and where it would not be.
#include "trace/why/why.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "model/lowering.hpp"
#include "text/findings.hpp"
#include "trace/told.hpp"

namespace btcheck::why_test {
namespace {

// Takes the next step of the script as soon as it is possible; until then the
// first step that is nobody's choice, or time.
Run led(const Lowered& model, const std::vector<std::string>& script) {
  Run run;
  run.initial = NetworkInterpreter(model.network).initial();
  std::size_t next = 0;
  for (int guard = 0; next < script.size(); ++guard) {
    INFO(script[next]);
    REQUIRE(guard < 2000);
    const Valuation& here = run.state(run.steps.size());
    const std::vector<RunStep> steps = steps_from(model, here);
    const auto wanted =
        std::find_if(steps.begin(), steps.end(), [&](const RunStep& step) {
          return script_name(model, here, step) == script[next];
        });
    const auto free_of_choice =
        std::find_if(steps.begin(), steps.end(), [&](const RunStep& step) {
          const auto event = event_of(model.tree, model.network, here, step);
          return !event || !event->is_chosen;
        });
    next += wanted != steps.end();
    const auto taken = wanted != steps.end() ? wanted : free_of_choice;
    REQUIRE(taken != steps.end());
    run.steps.push_back(*taken);
  }
  return run;
}

NodeId node_called(const Lowered& model, std::string_view name) {
  for (std::uint32_t n = 0; n < model.tree.nodes.size(); ++n) {
    if (model.tree.nodes[n].name == name) return NodeId{n};
  }
  FAIL("no such node");
  return {};
}

std::string reason(const Lowered& model, const Run& run,
                   const Subjects& subjects = {},
                   std::optional<std::size_t> trigger = std::nullopt) {
  return why(model.tree, model.network, run, subjects, trigger);
}

TEST_CASE("an action that runs for ever is told") {
  const Lowered model("(BehaviorTree :name t (Action :ID a))");
  Run run = led(model, {"a -> running", "a -> running"});
  close_loop(run);
  CHECK(reason(model, run) ==
        "a returns running for ever, and nothing says that an action must "
        "end. `--assume actions-end` leaves such runs out.");
  CHECK(running_for_ever(model.tree, model.network, run) ==
        std::vector<NodeId>{NodeId{1}});
  run.loop = kNoLoop;
  CHECK(running_for_ever(model.tree, model.network, run).empty());
}

TEST_CASE("several actions that run for ever are told together") {
  const Lowered model(
      "(BehaviorTree :name t (ParallelAll"
      " (Action :ID a) (Action :ID b) (Action :ID c)))");
  const std::vector<std::string> round = {"a -> running", "b -> running",
                                          "c -> running"};
  std::vector<std::string> twice = round;
  twice.insert(twice.end(), round.begin(), round.end());
  Run run = led(model, twice);
  close_loop(run);
  CHECK(reason(model, run).rfind("a, b and c return running for ever", 0) == 0);
}

TEST_CASE("an action that ends in the loop does not run for ever") {
  const Lowered model("(BehaviorTree :name t :loop 1 (Action :ID a))");
  Run run = led(
      model, {"a -> running", "a -> success", "a -> running", "a -> success"});
  close_loop(run);
  CHECK(running_for_ever(model.tree, model.network, run).empty());
  CHECK(reason(model, run) ==
        "Every round of the loop needs a -> running and a -> success.");
}

TEST_CASE("an action that is halted in the loop does not run for ever") {
  const Lowered model(
      "(BehaviorTree :name t :loop 1 (ReactiveSequence :halt 1"
      " (Condition :ID c) (Action :ID a)))");
  const std::vector<std::string> round = {"c -> success", "a -> running",
                                          "c -> failure", "a is halted"};
  std::vector<std::string> twice = round;
  twice.insert(twice.end(), round.begin(), round.end());
  Run run = led(model, twice);
  close_loop(run);
  CHECK(running_for_ever(model.tree, model.network, run).empty());
}

// The run goes on for ever where it is, while time passes.
Run ended_for_ever(const Lowered& model,
                   const std::vector<std::string>& script) {
  Run run = led(model, script);
  const Valuation end = run.state(run.steps.size());
  run.steps.push_back({{kTimeStep, 1, true}, end});
  run.loop = run.steps.size() - 1;
  return run;
}

TEST_CASE("a tree that has ended ticks nobody who is waited for") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence (Condition :ID c) (Action :ID a)))");
  const Run run = ended_for_ever(model, {"c -> failure", "t -> failure"});
  Subjects subjects;
  subjects.awaited = {node_called(model, "a")};
  CHECK(reason(model, run, subjects) ==
        "t has failed in tick 1, and a tree that has ended ticks no node any "
        "more.");
  subjects.awaited = {node_called(model, "t")};
  CHECK(reason(model, run, subjects) ==
        "t has failed in tick 1, and a tree that has ended stays as it is.");
  CHECK(reason(model, run) == "It takes no more than c -> failure in tick 1.");
}

TEST_CASE("the end of a tree that begins again explains nothing") {
  const Lowered model(
      "(BehaviorTree :name t :loop 1 (Sequence (Condition :ID c)"
      " (Action :ID a)))");
  const Run run = led(model, {"c -> failure", "t -> failure"});
  Subjects subjects;
  subjects.awaited = {node_called(model, "a")};
  CHECK(reason(model, run, subjects).find("has ended") == std::string::npos);
}

// A condition before an action that runs into a second tick. The trigger is
// the state after the first.
std::string second_look(const std::string& sequence,
                        const std::vector<std::string>& second_tick) {
  const Lowered model("(BehaviorTree :name t :loop 1 (" + sequence +
                      " :name s (Condition :ID c) (Action :ID a)))");
  std::vector<std::string> script = {"c -> success", "a -> running"};
  const std::size_t trigger = led(model, script).steps.size();
  script.insert(script.end(), second_tick.begin(), second_tick.end());
  Subjects subjects;
  subjects.nodes = subjects.awaited = {node_called(model, "c")};
  return reason(model, led(model, script), subjects, trigger);
}

TEST_CASE("a sequence that resumes its child passes over what is awaited") {
  const std::string sentence =
      "s goes on with a, which was running, and does not tick c again.";
  CHECK(second_look("Sequence", {"a -> running"}) == sentence);
  CHECK(second_look("SequenceWithMemory", {"a -> running"}) == sentence);
}

TEST_CASE("who begins anew passes over nothing") {
  CHECK(second_look("ReactiveSequence", {"c -> success", "a -> running"})
            .find("goes on") == std::string::npos);
  // It goes on with a, which was ticked last, but c is ticked afterwards.
  CHECK(second_look("Sequence", {"a -> success", "c -> success"})
            .find("goes on") == std::string::npos);
}

TEST_CASE("a memory of what failed is not one of what was running") {
  const Lowered model(
      "(BehaviorTree :name t :loop 1 (SequenceWithMemory :name s"
      " (Condition :ID c) (Action :ID a)))");
  std::vector<std::string> script = {"c -> success", "a -> failure"};
  const std::size_t trigger = led(model, script).steps.size();
  script.push_back("a -> failure");
  Subjects subjects;
  subjects.awaited = {node_called(model, "c")};
  CHECK(reason(model, led(model, script), subjects, trigger) ==
        "The last choice is a -> failure in tick 2.");
}

TEST_CASE("a measurement of a variable the property names is missed, too") {
  const Lowered model(
      "(defsv w :states (Calm Storm) :transitions :all)"
      "(BehaviorTree :name t (Sequence :name s"
      " (SetSV :ID look :sv w) (Action :ID a)))");
  const Run run =
      led(model, {"look: w := Calm", "a -> running", "a -> running"});
  Subjects subjects;
  CHECK(reason(model, run, subjects).find("goes on") == std::string::npos);
  subjects.variables = {StateVariableId{0}};
  CHECK(reason(model, run, subjects) ==
        "s goes on with a, which was running, and does not tick look again.");
}

constexpr std::string_view kHalting =
    "(BehaviorTree :name t (ReactiveSequence :name r :halt 1"
    " (Condition :ID c) (Sequence :name s (Action :ID a))))";

TEST_CASE("who halts whom, and after which answer") {
  const Lowered model(kHalting);
  Run run = led(
      model, {"c -> success", "a -> running", "c -> failure", "a is halted"});
  Subjects subjects;
  CHECK(reason(model, run, subjects).find("halts") == std::string::npos);
  subjects.nodes = {node_called(model, "a")};
  CHECK(reason(model, run, subjects) ==
        "r halts a because c returned failure.");
}

TEST_CASE("a halt in an earlier tick explains nothing") {
  std::string text(kHalting);
  text.insert(text.find("t (") + 1, " :loop 1");
  const Lowered model(text);
  const Run run = led(model, {"c -> success", "a -> running", "c -> failure",
                              "a is halted", "c -> success", "a -> running"});
  Subjects subjects;
  subjects.nodes = {node_called(model, "a")};
  CHECK(reason(model, run, subjects).find("halts") == std::string::npos);
}

TEST_CASE("a parallel node halts when enough, or too many, have answered") {
  const Lowered model(
      "(BehaviorTree :name t (Parallel :name p :success 1 :halt 1"
      " (Action :ID a) (Action :ID b)))");
  Subjects subjects;
  subjects.nodes = {node_called(model, "b")};
  CHECK(reason(model,
               led(model, {"a -> success", "b -> running", "b is halted"}),
               subjects) ==
        "p halts b because enough of its children have succeeded.");
  const Lowered all(
      "(BehaviorTree :name t (ParallelAll :name p :halt 1"
      " (Action :ID a) (Action :ID b)))");
  CHECK(reason(all, led(all, {"a -> failure", "b -> running", "b is halted"}),
               subjects) ==
        "p halts b because too many of its children have failed.");
}

constexpr std::string_view kWeather =
    "(defsv w :states (Calm Storm) :transitions :all)"
    "(BehaviorTree :name t (Sequence (Eval :name e (= w Calm))"
    " (Action :ID a)))";

std::string weather(const std::vector<std::string>& script) {
  const Lowered model(kWeather);
  Subjects subjects;
  subjects.variables = {StateVariableId{0}};
  return reason(model, led(model, script), subjects);
}

TEST_CASE("a variable that moves between the look and the deed is told") {
  CHECK(weather({"e -> success", "w := Storm", "a -> success"}) ==
        "w changes from Calm to Storm after e has looked at it and before a "
        "is ticked.");
  CHECK(weather({"e -> success", "w := Storm"}) ==
        "w changes from Calm to Storm after e has looked at it.");
}

TEST_CASE("a variable that is looked at afterwards, or back, is not told") {
  CHECK(
      weather({"w := Storm", "e -> failure", "t -> failure"}).find("changes") ==
      std::string::npos);
  CHECK(weather({"e -> success", "w := Storm", "w := Calm", "a -> success"})
            .find("changes") == std::string::npos);
  const Lowered model(kWeather);
  CHECK(reason(model, led(model, {"e -> success", "w := Storm"}))
            .find("changes") == std::string::npos);
}

TEST_CASE("the action that the property names makes its guard a matter") {
  const Lowered model(kWeather);
  Subjects subjects;
  subjects.nodes = {node_called(model, "a")};
  CHECK(reason(model,
               led(model, {"e -> success", "w := Storm", "a -> success"}),
               subjects)
            .find("w changes from Calm to Storm") == 0);
}

std::string fault(std::string_view text,
                  const std::vector<std::string>& script) {
  const Lowered model(text);
  return reason(model, led(model, script));
}

TEST_CASE("a fault is told with the value that does not fit") {
  CHECK(fault("(defsv v :max 2)(BehaviorTree :name t (Eval :name up"
              " (:= v (+ v 3))))",
              {"up: leaves the range of a variable"}) ==
        "up would set v to 3, outside its range 0 to 2; the run ends there.");
  CHECK(fault("(defsv v :max 2)(BehaviorTree :name t (Eval :name half"
              " (= (/ 1 v) 0)))",
              {"half: divides by zero"}) ==
        "half divides by zero; the run ends there.");
  CHECK(fault("(defsv v :max 2)(BehaviorTree :name t (Eval :name half"
              " (:= v (/ 1 v))))",
              {"half: divides by zero or leaves a range"}) ==
        "half divides by zero to set v; the run ends there.");
}

TEST_CASE("a fault in a later effect counts with what the first has set") {
  CHECK(fault("(defsv v :max 2)"
              "(defaction drop :on-success ((:= v 2) (:= v (+ v 1))))"
              "(BehaviorTree :name t (Action :ID drop))",
              {"drop: leaves the range of a variable"}) ==
        "drop would set v to 3, outside its range 0 to 2; the run ends there.");
}

TEST_CASE("an assignment in range is no fault") {
  CHECK(fault("(defsv v :max 2)(BehaviorTree :name t (Eval :name up"
              " (:= v (+ v 1))))",
              {"up: v := 1", "t -> success"}) == "");
}

// No tree that can be read is stuck, so one is made so.
TEST_CASE("who gives no answer where nothing can happen is told") {
  const BehaviorTree tree =
      tree_of("(BehaviorTree :name t (Sequence :name s (Action :ID a)))");
  Network network = lower(tree, TickSemantics::Root);
  for (Edge& edge : network.automata[0].edges) {
    if (edge.source == network.automata[0].find_location("tick_node")) {
      edge.guard = Expression::constant(0);
    }
  }
  const NetworkInterpreter interpreter(network);
  Run run;
  run.initial = interpreter.initial();
  while (!interpreter.is_dead(run.state(run.steps.size()))) {
    const Valuation& here = run.state(run.steps.size());
    std::uint32_t edge = 0;
    while (edge < network.edge_count() && !interpreter.may_fire(here, edge)) {
      ++edge;
    }
    if (edge < network.edge_count()) {
      const Step step{edge, 0, true};
      run.steps.push_back({step, interpreter.after(here, step)});
    } else {
      run.steps.push_back({kIdleStep, interpreter.after(here, kIdleStep)});
    }
  }
  run.loop = run.steps.size();
  run.steps.push_back({kIdleStep, run.state(run.loop)});
  CHECK(why(tree, network, run, {}, std::nullopt) ==
        "a has been ticked and gives no answer; nothing can happen any more.");
}

TEST_CASE("a tree that has ended is not stuck") {
  const Lowered model("(BehaviorTree :name t (Eval :name e (= 1 1)))");
  Run run = led(model, {"t -> success"});
  go_to_end(model, run);
  run.loop = run.steps.size();
  run.steps.push_back({kIdleStep, run.state(run.loop)});
  CHECK(reason(model, run) == "Nothing is chosen: the tree goes so by itself.");
}

TEST_CASE("one answer of the world is all it takes") {
  const Lowered model("(BehaviorTree :name t (Action :ID a))");
  const Run run = led(model, {"a -> failure", "t -> failure"});
  CHECK(reason(model, run) == "It takes no more than a -> failure in tick 1.");
  const Lowered timeless("(BehaviorTree :name t (Action :ID a))",
                         TickSemantics::None);
  CHECK(reason(timeless, led(timeless, {"a -> failure"})) ==
        "It takes no more than a -> failure.");
}

TEST_CASE("a time that is up is a choice where it has some play") {
  const Lowered model("(BehaviorTree :name t (Wait :name w :duration (1 2)))");
  CHECK(reason(model, led(model, {"the time of w is up"})) ==
        "It takes no more than that the time of w is up in tick 2.");
}

TEST_CASE("of several answers the last is told, unless they go on") {
  const Lowered model("(BehaviorTree :name t :loop 1 (Action :ID a))");
  Run run = led(model, {"a -> running", "a -> failure", "t -> failure"});
  CHECK(reason(model, run) ==
        "The last choice is a -> failure in tick 2; the rest the tree does "
        "by itself.");
  run = led(model, {"a -> failure", "a -> failure"});
  close_loop(run);
  CHECK(reason(model, run) == "Every round of the loop needs a -> failure.");
}

TEST_CASE("a run of no steps needs no reason") {
  const Lowered model("(BehaviorTree :name t (Action :ID a))");
  CHECK(reason(model, led(model, {})) == "");
}

TEST_CASE("names are enumerated as people do") {
  CHECK(enumerated({}) == "");
  CHECK(enumerated({"a"}) == "a");
  CHECK(enumerated({"a", "b"}) == "a and b");
  CHECK(enumerated({"a", "b", "c"}) == "a, b and c");
}

}  // namespace
}  // namespace btcheck::why_test
