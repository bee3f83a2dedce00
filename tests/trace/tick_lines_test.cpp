// SPDX-License-Identifier: MIT
//
// One line for each tick, to the letter.
#include "trace/run/tick_lines.hpp"

#include <doctest/doctest.h>

#include <string>

#include "check/simulate/simulation.hpp"
#include "trace/told.hpp"

namespace btcheck {
namespace {

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
  constexpr std::string_view kTree =
      "(BehaviorTree :name t (Sequence :name s (Action :ID a)))";
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
        TickSemantics::None}) {
    const Lowered model(kTree, ticks);
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
}  // namespace btcheck
