// SPDX-License-Identifier: MIT
//
// What is asked in a simulation, what is not, and what becomes of the answers.
#include "check/simulate/simulation.hpp"

#include <doctest/doctest.h>

#include <map>
#include <string>
#include <vector>

#include "check/checked.hpp"

namespace btcheck::simulation_test {
namespace {

Simulation simulation_of(const Lowered& model,
                         Interleaving interleaving = Interleaving::Open) {
  return Simulation(model.tree, model.network, interleaving);
}

std::string choice_text(const Lowered& model, const SimulationChoice& choice) {
  if (choice.kind == ChoiceKind::Time) return "time";
  const Automaton& mover = model.network.owner_of_edge(choice.step.edge);
  const Edge& edge = model.network.edge(choice.step.edge);
  switch (choice.kind) {
    case ChoiceKind::Tick:
      return "tick of " + model.tree.node(mover.node).name;
    case ChoiceKind::Due:
      return "due " + model.tree.node(mover.node).name;
    case ChoiceKind::Move:
      return "move " + edge.label;
    default:
      break;
  }
  const std::string text =
      model.tree.node(mover.node).name + " " + mover.target(edge).name;
  return edge.label.empty() || choice.kind == ChoiceKind::Tree
             ? text
             : text + " " + edge.label;
}

// The choices, by their texts.
std::string asked(const Lowered& model, const Simulation& simulation) {
  std::string text;
  for (const SimulationChoice& choice : simulation.choices()) {
    text += (text.empty() ? "" : "; ") + choice_text(model, choice);
  }
  return text;
}

// Takes the choices that are so called, one after the other.
void take(const Lowered& model, Simulation& simulation,
          const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    INFO(text);
    INFO(asked(model, simulation));
    std::size_t number = 0;
    while (number < simulation.choices().size() &&
           choice_text(model, simulation.choices()[number]) != text) {
      ++number;
    }
    REQUIRE(number < simulation.choices().size());
    simulation.take(number);
  }
}

// The steps since the last choice, each from where the one before led to.
std::vector<RunStep> latest_of(const Simulation& simulation) {
  std::vector<RunStep> steps;
  simulation.for_each_latest([&](const Valuation& before, const RunStep& step) {
    if (!steps.empty()) CHECK(steps.back().after == before);
    steps.push_back(step);
  });
  return steps;
}

int value(const Lowered& model, const Simulation& simulation,
          std::uint32_t variable) {
  return simulation.state()
      .variables[index(model.network.state_variable[variable])];
}

TEST_CASE("a run begins with a tick, and asks for the answers of leaves") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence (Action :ID a) (Condition :ID c)))");
  Simulation simulation = simulation_of(model);
  CHECK(asked(model, simulation) == "tick of t");
  CHECK(simulation.ticks(model.tree.roots[0]) == 0);
  simulation.take(0);
  CHECK(asked(model, simulation) == "a success; a failure; a running");
  CHECK(simulation.ticks(model.tree.roots[0]) == 1);
  take(model, simulation, {"a success"});
  CHECK(asked(model, simulation) == "c success; c failure");
  CHECK(simulation.end() == RunEnd::None);
  take(model, simulation, {"c failure"});
  CHECK(simulation.choices().empty());
  CHECK(simulation.end() == RunEnd::Ended);
}

TEST_CASE("an answer is offered where it is the only one") {
  const Lowered model(
      "(defaction a :returns (success))"
      "(BehaviorTree :name t (Action :ID a))");
  Simulation simulation = simulation_of(model);
  take(model, simulation, {"tick of t"});
  CHECK(asked(model, simulation) == "a success");
}

TEST_CASE("a measurement that finds nothing new comes first") {
  const Lowered model(
      "(defsv b :states (Good Low Bad) :init Low :transitions ((Low Bad)"
      " (Bad Good)))"
      "(BehaviorTree :name t :loop 1 (SetSV :ID m :sv b))");
  Simulation simulation = simulation_of(model);
  take(model, simulation, {"tick of t"});
  CHECK(asked(model, simulation) == "m success b := Low; m success b := Bad");
  take(model, simulation, {"m success b := Bad", "tick of t"});
  CHECK(value(model, simulation, 0) == 2);
  CHECK(asked(model, simulation) == "m success b := Bad; m success b := Good");
}

TEST_CASE("a free variable moves before a tick, and before it is looked at") {
  const Lowered model(
      "(defsv w :states (Calm Storm))"
      "(BehaviorTree :name t (Sequence (Action :ID a) (Eval :name e (= w Calm))"
      " (Eval :name f (= w Calm)) (Action :ID b)))");
  Simulation simulation = simulation_of(model);
  CHECK(asked(model, simulation) == "tick of t; move w := Storm");
  take(model, simulation, {"move w := Storm"});
  CHECK(asked(model, simulation) == "tick of t; move w := Calm");
  take(model, simulation, {"tick of t"});
  CHECK(asked(model, simulation) == "a success; a failure; a running");
  take(model, simulation, {"a success"});
  CHECK(asked(model, simulation) == "e failure; move w := Calm");
  take(model, simulation, {"move w := Calm", "e success"});
  CHECK(asked(model, simulation) == "f success; move w := Storm");
  take(model, simulation, {"f success"});
  CHECK(asked(model, simulation) == "b success; b failure; b running");
}

TEST_CASE("in order, free variables move before a tick and never in one") {
  const Lowered model(
      "(defsv w :states (Calm Storm))"
      "(BehaviorTree :name t (Sequence (Action :ID a)"
      " (Eval (= w Calm)) (Action :ID b)))");
  Simulation simulation = simulation_of(model, Interleaving::InOrder);
  CHECK(asked(model, simulation) == "tick of t; move w := Storm");
  take(model, simulation, {"tick of t", "a success"});
  CHECK(asked(model, simulation) == "b success; b failure; b running");
}

TEST_CASE("after the end free variables still move") {
  const Lowered model(
      "(defsv w :states (Calm Storm))"
      "(BehaviorTree :name t (Action :ID a :SF 1))");
  Simulation simulation = simulation_of(model);
  take(model, simulation, {"tick of t", "a success"});
  CHECK(simulation.end() == RunEnd::Ended);
  CHECK(asked(model, simulation) == "move w := Storm");
  take(model, simulation, {"move w := Storm"});
  CHECK(asked(model, simulation) == "move w := Calm");
  CHECK(simulation.end() == RunEnd::Ended);
}

TEST_CASE("children of a Parallel that share nothing answer one by one") {
  const Lowered model(
      "(BehaviorTree :name t (ParallelAll (Action :ID a) (Action :ID b)))");
  Simulation simulation = simulation_of(model);
  take(model, simulation, {"tick of t"});
  CHECK(asked(model, simulation) == "a success; a failure; a running");
  take(model, simulation, {"a running"});
  CHECK(asked(model, simulation) == "b success; b failure; b running");
}

constexpr std::string_view kRace =
    "(defsv x :max 1)"
    "(defaction a :returns (success) :on-success ((:= x 1)))"
    "(BehaviorTree :name t (ParallelAll (Sequence (Action :ID before)"
    " (Eval :name e (= x 0))) (Action :ID a)))";

TEST_CASE("who comes first is asked where it makes a difference") {
  const Lowered model(kRace);
  Simulation simulation = simulation_of(model);
  take(model, simulation, {"tick of t"});
  CHECK(asked(model, simulation) ==
        "before success; before failure; before running");
  take(model, simulation, {"before success"});
  CHECK(asked(model, simulation) == "e success; a success");
  take(model, simulation, {"a success"});
  CHECK(simulation.end() == RunEnd::Ended);
  REQUIRE(simulation.back());
  CHECK(asked(model, simulation) == "e success; a success");
}

TEST_CASE("in order nobody is asked who comes first") {
  const Lowered model(kRace);
  Simulation simulation = simulation_of(model, Interleaving::InOrder);
  take(model, simulation, {"tick of t", "before success"});
  CHECK(asked(model, simulation) == "a success");
  CHECK(value(model, simulation, 0) == 0);
}

TEST_CASE("two trees tick in turns, and share their variables") {
  const Lowered model(
      "(defsv x :max 1)"
      "(BehaviorTree :name one :loop 1 (Eval (:= x 1)))"
      "(BehaviorTree :name two :loop 1 (Sequence (Eval (= x 1)) (Action :ID a)"
      "))(Trees one two)");
  Simulation open = simulation_of(model);
  CHECK(asked(model, open) == "tick of one");
  open.take(0);
  CHECK(asked(model, open) == "tick of two");
  open.take(0);
  CHECK(asked(model, open) == "Eval1 success; Eval1 failure");
}

TEST_CASE("a time that may be up is offered where the action is asked") {
  const Lowered model("(BehaviorTree :name t (Action :ID a :duration [1,3]))");
  Simulation simulation = simulation_of(model);
  take(model, simulation, {"tick of t"});
  CHECK(asked(model, simulation) == "a running");
  take(model, simulation, {"a running", "tick of t"});
  CHECK(asked(model, simulation) == "a running; due a");
  take(model, simulation, {"a running", "tick of t", "due a"});
  CHECK(asked(model, simulation) == "a success; a failure");
  REQUIRE(simulation.back());
  take(model, simulation, {"a running", "tick of t"});
  CHECK(asked(model, simulation) == "a success; a failure");
}

TEST_CASE("back is where the last choice among several was") {
  const Lowered model(
      "(BehaviorTree :name t :loop 1 (Sequence (Action :ID a) (Action :ID "
      "b)))");
  Simulation simulation = simulation_of(model);
  CHECK(!simulation.back());
  take(model, simulation, {"tick of t"});
  CHECK(!simulation.back());
  const Valuation at_a = simulation.state();
  take(model, simulation, {"a success"});
  const Valuation at_b = simulation.state();
  take(model, simulation, {"b success", "tick of t"});
  CHECK(simulation.ticks(model.tree.roots[0]) == 2);
  REQUIRE(simulation.back());
  CHECK(simulation.state() == at_b);
  CHECK(simulation.ticks(model.tree.roots[0]) == 1);
  CHECK(asked(model, simulation) == "b success; b failure; b running");
  CHECK(latest_of(simulation).empty());
  REQUIRE(simulation.back());
  CHECK(simulation.state() == at_a);
  CHECK(!simulation.back());
  take(model, simulation, {"a failure"});
  CHECK(simulation.run().state(simulation.run().steps.size()) ==
        simulation.state());
}

TEST_CASE("a run has every step, and each leads where it says") {
  const Lowered model(kWaitingTree);
  Simulation simulation = simulation_of(model);
  std::vector<RunStep> told = latest_of(simulation);
  SplitMix64 random(3);
  while (simulation.end() == RunEnd::None) {
    simulation.take(random_choice(simulation.choices(), random));
    for (const RunStep& step : latest_of(simulation)) told.push_back(step);
  }
  const Run run = simulation.run();
  const NetworkInterpreter interpreter(model.network);
  CHECK(run.initial == interpreter.initial());
  REQUIRE(run.steps.size() == told.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    CHECK(run.steps[i].step == told[i].step);
    CHECK(run.steps[i].after == told[i].after);
    const auto after = interpreter.taken(run.state(i), run.steps[i].step);
    REQUIRE(after.has_value());
    CHECK(*after == run.steps[i].after);
  }
}

TEST_CASE("a fault is the end") {
  const Lowered model(
      "(defsv x :max 1)"
      "(BehaviorTree :name t :loop 1 (Eval (:= x (+ x 1))))");
  Simulation simulation = simulation_of(model);
  simulation.take(0);
  CHECK(asked(model, simulation) == "tick of t");
  simulation.take(0);
  CHECK(simulation.choices().empty());
  CHECK(simulation.end() == RunEnd::Fault);
  CHECK(simulation.ticks(model.tree.roots[0]) == 2);
}

TEST_CASE("without clocks the same is asked") {
  const Lowered model(kWaitingTree, TickSemantics::None);
  Simulation simulation = simulation_of(model);
  CHECK(asked(model, simulation) == "tick of t; move w := Storm");
  take(model, simulation, {"tick of t"});
  CHECK(asked(model, simulation) == "z running; due z");
  take(model, simulation, {"due z"});
  CHECK(asked(model, simulation) == "e success; move w := Storm");
  take(model, simulation, {"e success", "a success"});
  CHECK(simulation.end() == RunEnd::Ended);
}

TEST_CASE("where every node takes its time the same is asked") {
  const Lowered model(kWaitingTree, TickSemantics::Nodes);
  Simulation simulation = simulation_of(model);
  take(model, simulation, {"tick of t", "tick of t"});
  CHECK(asked(model, simulation) == "e success; move w := Storm");
}

TEST_CASE("random numbers are those of SplitMix64") {
  SplitMix64 random(1234567);
  CHECK(random.next() == 6457827717110365317u);
  CHECK(random.next() == 3203168211198807973u);
  CHECK(random.next() == 9817491932198370423u);
  CHECK(SplitMix64(0).next() == 0xE220A8397B1DCDAFu);
  SplitMix64 same(7);
  std::map<std::size_t, int> drawn;
  for (int i = 0; i < 3000; ++i) ++drawn[same.below(3)];
  REQUIRE(drawn.size() == 3);
  for (const auto& [number, times] : drawn) {
    CHECK(number < 3);
    CHECK(times > 900);
  }
  CHECK(same.below(1) == 0);
}

TEST_CASE("one choice in four is a move where variables may move") {
  std::vector<SimulationChoice> choices(5);
  choices[0].kind = ChoiceKind::Tick;
  for (std::size_t i = 1; i < 5; ++i) choices[i].kind = ChoiceKind::Move;
  SplitMix64 random(1);
  int ticks = 0;
  for (int i = 0; i < 4000; ++i) {
    ticks += random_choice(choices, random) == 0 ? 1 : 0;
  }
  CHECK(ticks > 2850);
  CHECK(ticks < 3150);
}

}  // namespace
}  // namespace btcheck::simulation_test
