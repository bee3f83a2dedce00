// SPDX-License-Identifier: MIT
//
// A run told, a tree with what its nodes do, one line for each tick: to the
// letter.
#include "trace/formats/text.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "check/simulate/simulation.hpp"
#include "trace/run/record.hpp"
#include "trace/told.hpp"

namespace btcheck::text_test {
namespace {

// --- A run ------------------------------------------------------------------

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

TEST_CASE("on a wide terminal what was chosen stands behind long events") {
  const std::string name(70, 'a');
  const Lowered model("(BehaviorTree :name t (Action :ID " + name + " :SF))");
  const Run run = scripted(model, {name + " -> success"});
  const std::string event = "    tick 1   " + name + " -> success";
  const auto told = [&](std::size_t width) {
    return text_of_run(model, run, TextStyle({Detail::Events, width}));
  };
  CHECK(told(80).starts_with(event + " chosen\n"));
  CHECK(told(200).starts_with(event + " chosen\n"));
  const Lowered both(
      "(BehaviorTree :name t (Sequence (Action :ID b :SF) "
      "(Action :ID " +
      name + " :SF)))");
  const Run two = scripted(both, {"b -> success", name + " -> success"});
  const std::string wide =
      text_of_run(both, two, TextStyle({Detail::Events, 200}));
  const std::string narrow = text_of_run(both, two, {});
  const std::size_t line = wide.find('\n');
  CHECK(wide.substr(0, line).find("chosen") == event.size() + 1);
  CHECK(narrow.substr(0, narrow.find('\n')).find("chosen") == 62);
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

// --- A tree -----------------------------------------------------------------

constexpr std::string_view kFoldedTree =
    "(BehaviorTree :name t (Sequence :name s (Action :ID a)\n"
    " (Inverter :name i (Sequence :name j (Action :ID b) (Action :ID c)))))";

std::string text_after(const std::vector<std::string>& script,
                       Folding folding) {
  const Lowered model(kFoldedTree);
  const RecordedRun run =
      recorded(model.tree, model.network, scripted(model, script), {});
  return tree_text(run, run.states.size() - 1, folding);
}

TEST_CASE("a tree that nobody has ticked is its names") {
  const Lowered model(kFoldedTree);
  Run run;
  run.initial = NetworkInterpreter(model.network).initial();
  const RecordedRun record = recorded(model.tree, model.network, run, {});
  CHECK(tree_text(record, 0, Folding::None) ==
        "t\n"
        "  s\n"
        "    a\n"
        "    i\n"
        "      j\n"
        "        b\n"
        "        c\n");
  CHECK(tree_text(record, 0, Folding::Unvisited) == "t and 6 below it\n");
}

TEST_CASE("beside each node stands what it does") {
  CHECK(text_after({"a -> running"}, Folding::Unvisited) ==
        "t      waiting\n"
        "  s    waiting\n"
        "    a  here\n"
        "    i and 3 below it\n");
  CHECK(text_after({"a -> success", "b -> running"}, Folding::None) ==
        "t          waiting\n"
        "  s        waiting\n"
        "    a      success\n"
        "    i      waiting\n"
        "      j    waiting\n"
        "        b  here\n"
        "        c\n");
}

TEST_CASE("what is of an earlier tick stands in parentheses") {
  CHECK(text_after({"a -> success", "b -> running", "b -> success"},
                   Folding::Unvisited) ==
        "t          waiting\n"
        "  s        waiting\n"
        "    a      (success)\n"
        "    i      waiting\n"
        "      j    waiting\n"
        "        b  here\n"
        "        c\n");
}

// --- Ticks ------------------------------------------------------------------

std::string lines_of(const Lowered& model,
                     const std::vector<std::string>& script) {
  Run run = scripted(model, script);
  const NetworkInterpreter interpreter(model.network);
  // To the end of what leaves no choice, for forty steps at most.
  for (int i = 0; i < 40; ++i) {
    const Valuation& here = run.state(run.steps.size());
    const auto steps = steps_from(model, here);
    if (steps.size() != 1 || steps[0].after == here) break;
    run.steps.push_back(steps[0]);
  }
  return tick_lines(model.tree, model.network, run);
}

TEST_CASE("a line has the answer, the variables, and who was ticked") {
  const Lowered model(
      "(defsv battery :states (Good Low)) (defsv level :max 3)\n"
      "(BehaviorTree :name t (Sequence :name s\n"
      "  (SetSV :ID measure :sv battery) (Eval :name up (:= level 2))\n"
      "  (Action :ID a) (Action :ID never)))");
  CHECK(lines_of(model,
                 {"measure: battery := Low", "a -> running", "a -> failure"}) ==
        "tick 1: root=running battery=Low level=2 s=running measure=success "
        "up=success a=running\n"
        "tick 2: root=failure battery=Low level=2 s=failure a=failure\n");
}

TEST_CASE("a node that answers twice in a tick has both answers") {
  const Lowered model(
      "(BehaviorTree :name t (RetryUntilSuccessful :name again"
      " :num_attempts 3 (Action :ID a)))");
  CHECK(lines_of(model, {"a -> failure", "a -> failure", "a -> success"}) ==
        "tick 1: root=success again=success a=failure,failure,success\n");
}

TEST_CASE("who is halted is in the line") {
  const Lowered model(
      "(BehaviorTree :name t (ReactiveSequence :name r :halt 1"
      " (Condition :ID c) (Action :ID a)))");
  CHECK(lines_of(model, {"c -> success", "a -> running", "c -> failure"}) ==
        "tick 1: root=running r=running c=success a=running\n"
        "tick 2: root=failure r=failure c=failure a=halted\n");
}

TEST_CASE("a run that ends within a tick says what has no answer") {
  const Lowered faulty(
      "(defsv x :max 1) (BehaviorTree :name t :loop 1 (Sequence :name s"
      " (Action :ID a) (Eval :name e (:= x (+ x 1)))))");
  CHECK(lines_of(faulty, {"a -> success", "a -> success"}) ==
        "tick 1: root=success x=1 s=success a=success e=success\n"
        "tick 2: root=none x=1 s=none a=success e=error\n");
  const Lowered model(
      "(BehaviorTree :name t (Sequence :name s (Action :ID a) (Action :ID b))"
      ")");
  CHECK(lines_of(model, {"a -> success"}) ==
        "tick 1: root=none s=none a=success b=none\n");
}

TEST_CASE("a run without a step has no line") {
  const Lowered model("(BehaviorTree :name t (Action :ID a))");
  Run run;
  run.initial = NetworkInterpreter(model.network).initial();
  CHECK(tick_lines(model.tree, model.network, run) == "");
}

TEST_CASE("every node has a name of its own") {
  Lowered model(
      "(defsv charge :max 1)\n"
      "(BehaviorTree :name t (Sequence :name s (Action :ID charge)\n"
      " (Action :ID fly) (Action :ID fly) (Action :ID root)\n"
      " (Action :ID land)\n"
      " (Action :ID land) (Action :ID c)))");
  model.tree.nodes[8].name = "go \"home\"";  // as XML may have it
  const std::vector<std::string> keys = tick_line_keys(model.tree);
  REQUIRE(keys.size() == 9);
  CHECK(keys[0] == "t");
  CHECK(keys[1] == "s");
  CHECK(keys[2] == "charge_btn2");
  CHECK(keys[3] == "fly_btn3");
  CHECK(keys[4] == "fly_btn4");
  CHECK(keys[5] == "root_btn5");
  CHECK(keys[6] == "land@4");
  CHECK(keys[7] == "land@5");
  CHECK(keys[8] == "\"go \\\"home\\\"\"");
}

TEST_CASE("with several trees each has its lines") {
  const Lowered model(
      "(BehaviorTree :name one :loop 1 (Action :ID a :SF 1))"
      "(BehaviorTree :name two :loop 1 (Action :ID b :SF 1))"
      "(Trees one two)");
  Simulation simulation(model.tree, model.network, Interleaving::InOrder);
  while (simulation.ticks(model.tree.roots[1]) < 2 ||
         simulation.choices()[0].kind != ChoiceKind::Tick) {
    simulation.take(0);
  }
  CHECK(tick_lines(model.tree, model.network, simulation.run()) ==
        "tick 1 of one: root=success a=success\n"
        "tick 1 of two: root=success b=success\n"
        "tick 2 of one: root=success a=success\n"
        "tick 2 of two: root=success b=success\n");
}

TEST_CASE("the rounds of the root are ticks, whatever takes time") {
  constexpr std::string_view kSmallTree =
      "(BehaviorTree :name t (Sequence :name s (Action :ID a)))";
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
        TickSemantics::None}) {
    const Lowered model(kSmallTree, ticks);
    CHECK(lines_of(model, {"a -> running", "a -> success"}) ==
          "tick 1: root=running s=running a=running\n"
          "tick 2: root=success s=success a=success\n");
  }
}

// The events of a run that are called chosen are what a simulation asks for.
TEST_CASE("what an event calls chosen is a choice of the simulation") {
  for (const std::string_view example :
       {"drone3.btf", "mars_rover.btf", "nav2.btf", "train.btf"}) {
    const Lowered model(btcheck::example(example));
    Simulation simulation(model.tree, model.network, Interleaving::Open);
    SplitMix64 random(5);
    for (int i = 0; i < 200 && simulation.end() == RunEnd::None; ++i) {
      const auto number = random_choice(simulation.choices(), random);
      const SimulationChoice choice = simulation.choices()[number];
      simulation.take(number);
      bool is_first = true;
      simulation.for_each_latest([&](const Valuation& before,
                                     const RunStep& step) {
        const auto event = event_of(model.tree, model.network, before, step);
        const bool is_chosen = event && event->is_chosen;
        CHECK(is_chosen == (is_first && choice.kind != ChoiceKind::Tick &&
                            choice.kind != ChoiceKind::Tree &&
                            choice.kind != ChoiceKind::Time));
        is_first = false;
      });
    }
  }
}

}  // namespace
}  // namespace btcheck::text_test
