// SPDX-License-Identifier: MIT
//
// Scripts of leaf results: what they say, what is wrong with them, and runs.
#include "check/simulate/script.hpp"

#include <doctest/doctest.h>

#include <string>

#include "check/checked.hpp"

namespace btcheck::simulation_script_test {
namespace {

constexpr std::string_view kMission =
    "(defsv battery :states (Good Low Critical))\n"
    "(defsv level :max 3)\n"
    "(defsv w :states (Calm Storm) :moves free)\n"
    "(defaction dock :returns (success running))\n"
    "(BehaviorTree :name t :loop 1 (Sequence :name s\n"
    " (Condition :ID ready)\n"
    " (SetSV :ID measure :sv battery)\n"
    " (Action :ID go :name first) (Action :ID go) (Action :ID dock)\n"
    " (Wait :name rest :duration 1) (Eval (:= level 2))))\n";

Result<SimulationScript> read(const Lowered& model, const std::string& text) {
  auto result =
      read_simulation_script(model.tree, model.network, "s.txt", text);
  CHECK(result.value.has_value() == !has_error(result.diagnostics));
  return result;
}

// "first: 3*2 1", by the numbers of the results.
std::string sequence_of(const SimulationScript& script,
                        std::optional<std::size_t> number) {
  if (!number) return "-";
  const ScriptedSequence& sequence = script.sequences[*number];
  std::string text = sequence.name + ":";
  for (const ScriptedResult& result : sequence.results) {
    text += " " + std::to_string(result.value);
    if (result.times == kForEver) text += "*";
    if (result.times != kForEver && result.times != 1) {
      text += "*" + std::to_string(result.times);
    }
  }
  return text;
}

NodeId node_called(const Lowered& model, const std::string& name) {
  for (std::uint32_t n = 0; n < model.tree.nodes.size(); ++n) {
    if (model.tree.nodes[n].name == name) return NodeId{n};
  }
  FAIL(name);
  return {};
}

TEST_CASE("a line is a name and what is answered in turn") {
  const Lowered model(kMission);
  const auto sound = read(model,
                          "# by hand\n"
                          "\n"
                          "ready: success*2 FAILURE   ; then for ever\n"
                          "  measure :Good low*3 Critical*\n"
                          "dock: running*\r\n"
                          "w: Calm Storm # the sky");
  REQUIRE(sound.value.has_value());
  const auto told = [&](const std::string& name) {
    return sequence_of(*sound.value,
                       sound.value->of_node[index(node_called(model, name))]);
  };
  CHECK(told("ready") == "ready: 1*2 2");
  CHECK(told("measure") == "measure: 0 1*3 2*");
  CHECK(told("dock") == "dock: 3*");
  CHECK(told("first") == "-");
  CHECK(sequence_of(*sound.value, sound.value->of_variable[2]) == "w: 0 1");
  CHECK(sequence_of(*sound.value, sound.value->of_variable[0]) == "-");
}

TEST_CASE("lines that begin with the same name are one") {
  const Lowered model(kMission);
  const auto script = read(model, "dock: running\nw: Calm\ndock: success\n");
  REQUIRE(script.value.has_value());
  CHECK(script.value->sequences.size() == 2);
  CHECK(sequence_of(*script.value, 0) == "dock: 3 1");
}

TEST_CASE("the name that fits fewer leaves goes before the other") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence (Action :ID fly)\n (Action :ID fly)))");
  for (const char* text :
       {"fly: failure\nfly@2: success\n", "fly@2: success\nfly: failure\n"}) {
    const auto script = read(model, text);
    REQUIRE(script.value.has_value());
    CHECK(sequence_of(*script.value, script.value->of_node[2]) == "fly: 2");
    CHECK(sequence_of(*script.value, script.value->of_node[3]) == "fly@2: 1");
  }
}

TEST_CASE("a name may stand in quotes, a variable behind a dollar sign") {
  const Lowered model(
      "(defsv door :states (Open Shut))"
      "(BehaviorTree :name t (Condition :ID door))");
  const auto script = read(model, "\"door\" : failure\n$door: Shut\n");
  REQUIRE(script.value.has_value());
  CHECK(sequence_of(*script.value, script.value->of_node[1]) == "door: 2");
  CHECK(sequence_of(*script.value, script.value->of_variable[0]) == "$door: 1");
}

TEST_CASE("an empty script says nothing about anybody") {
  const Lowered model(kMission);
  for (const char* text : {"", "\n\n", "# nothing\r\n", "\xEF\xBB\xBF"}) {
    const auto script = read(model, text);
    REQUIRE(script.value.has_value());
    CHECK(script.value->sequences.empty());
  }
}

TEST_CASE("numbers are values of a number") {
  const Lowered model(
      "(defsv height :min -5 :max 5)"
      "(BehaviorTree :name t (SetSV :ID look :sv height))");
  const auto script = read(model, "look: -5 5*2\n");
  REQUIRE(script.value.has_value());
  CHECK(sequence_of(*script.value, 0) == "look: -5 5*2");
  CHECK(codes_of(read(model, "look: 6\nlook: high\n").diagnostics) ==
        "BT1403 BT1403");
}

TEST_CASE("every mistake is shown where it is") {
  const Lowered model(kMission);
  CHECK(shown(read(model, "docks: success\n").diagnostics) ==
        "error[BT1401]: unknown leaf `docks`\n"
        "  --> s.txt:1:1\n"
        "  |\n"
        "1 | docks: success\n"
        "  | ^^^^^ no node or variable has this name\n"
        "  |\n"
        "  = help: did you mean `dock` (line 8)?\n");
  CHECK(shown(read(model, "\n s: success\n").diagnostics) ==
        "error[BT1402]: `s` cannot be scripted\n"
        "  --> s.txt:2:2\n"
        "  |\n"
        "2 |  s: success\n"
        "  |  ^ this Sequence answers by what its children answer\n"
        "  |\n"
        "  = help: write about actions, conditions, SetSV nodes and variables "
        "that move by themselves\n");
  CHECK(shown(read(model, "level: 2\n").diagnostics) ==
        "error[BT1402]: `level` cannot be scripted\n"
        "  --> s.txt:1:1\n"
        "  |\n"
        "1 | level: 2\n"
        "  | ^^^^^ only the tree changes it\n"
        "  |\n"
        "  = help: write about the leaves that change it, or leave it out\n");
  CHECK(shown(read(model, "dock: running succes\n").diagnostics) ==
        "error[BT1403]: `succes` is no answer of `dock`\n"
        "  --> s.txt:1:15\n"
        "  |\n"
        "1 | dock: running succes\n"
        "  |               ^^^^^^ this Action answers success or running\n"
        "  |\n"
        "  = help: did you mean `success`?\n");
  CHECK(shown(read(model, "w: Clam\n").diagnostics) ==
        "error[BT1403]: `Clam` is no value of `w`\n"
        "  --> s.txt:1:4\n"
        "  |\n"
        "1 | w: Clam\n"
        "  |    ^^^^ it can be Calm or Storm\n"
        "  |\n"
        "  = help: did you mean `Calm`?\n");
  CHECK(shown(read(model, "dock success\n").diagnostics) ==
        "error[BT1404]: a line is a name, a colon and results\n"
        "  --> s.txt:1:1\n"
        "  |\n"
        "1 | dock success\n"
        "  | ^^^^^^^^^^^^ no colon\n"
        "  |\n"
        "  = help: write for instance `land: running*3 success`\n");
  CHECK(shown(read(model, "dock: running* success\n").diagnostics) ==
        "error[BT1404]: nothing comes after what is repeated for ever\n"
        "  --> s.txt:1:16\n"
        "  |\n"
        "1 | dock: running* success\n"
        "  |                ^^^^^^^ never reached\n"
        "  |\n"
        "  = help: write how often, for instance `running*3`\n");
}

TEST_CASE("one file shows all of its mistakes") {
  const Lowered model(kMission);
  CHECK(
      codes_of(read(model,
                    "dock: failure\n"     // never fails
                    "rest: success\n"     // a Wait
                    "ready: running\n"    // a Condition
                    "first: success*0\n"  // no number of times
                    "go:\n"               // nothing
                    ": success\n"         // no name
                    "\"go: success\n"     // no second quote
                    "$go: success\n"      // no variable
                    "nobody: success failure\n"
                    "nobody: success\n"  // reported once
                    "s.txt: x\n")
                   .diagnostics) ==
      "BT1403 BT1402 BT1403 BT1404 BT1404 BT1404 BT1404 BT1401 BT1401 BT1401");
  CHECK(codes_of(read(model, std::string("dock: \0", 7)).diagnostics) ==
        "BT1000");
  std::string many;
  for (int i = 0; i < 100; ++i) many += "x" + std::to_string(i) + ": success\n";
  CHECK(read(model, many).diagnostics.size() == 20);
}

TEST_CASE("a leaf has its results under one name") {
  const Lowered model(kMission);
  CHECK(shown(read(model, "dock: success\ndock_btn6: running\n").diagnostics) ==
        "error[BT1404]: `dock_btn6` has its results as `dock`\n"
        "  --> s.txt:2:1\n"
        "  |\n"
        "2 | dock_btn6: running\n"
        "  | ^^^^^^^^^ the same once more\n"
        "  |\n"
        "  = help: use one of the two names\n");
}

TEST_CASE("leaves of several kinds do not answer together") {
  const Lowered model(
      "(defsv x :states (A B))\n"
      "(BehaviorTree :name t (Sequence (Action :ID look)\n"
      " (SetSV :ID look :sv x)))");
  CHECK(shown(read(model, "look: success\n").diagnostics) ==
        "error[BT1402]: `look` names leaves of several kinds\n"
        "  --> s.txt:1:1\n"
        "  |\n"
        "1 | look: success\n"
        "  | ^^^^ which one is meant?\n"
        "  |\n"
        "  = help: write `look@2` or `look@3`\n");
}

TEST_CASE("columns count characters, also in a long line") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence (Action :ID gehöft) (Action :ID b)))");
  const auto wrong = read(model, "gehöft: success fäil success failur\n");
  REQUIRE(wrong.diagnostics.size() == 2);
  CHECK(wrong.diagnostics[0].span.column == 17);
  CHECK(wrong.diagnostics[0].span.length == 4);
  CHECK(wrong.diagnostics[1].span.column == 30);
}

// --- Runs ----------------------------------------------------------------

// What the state variables are at the end of each tick, and how it ends.
struct Played {
  Played(const Lowered& model, const std::string& text, int ticks) {
    auto script = read(model, text);
    INFO(shown(script.diagnostics));
    REQUIRE(script.value.has_value());
    const SourceText source("s.txt", text);
    ScriptPlayer player(*script.value, source);
    Simulation simulation(model.tree, model.network, Interleaving::InOrder);
    const NodeId root = model.tree.roots[0];
    while (simulation.end() == RunEnd::None &&
           (simulation.choices()[0].kind != ChoiceKind::Tick ||
            simulation.ticks(root) < ticks)) {
      auto choice = player.choose(simulation);
      if (auto* refused = std::get_if<Diagnostic>(&choice)) {
        refusal = render(*refused);
        break;
      }
      const auto chosen = simulation.choices()[std::get<std::size_t>(choice)];
      if (chosen.kind == ChoiceKind::Answer) {
        const Automaton& mover = model.network.owner_of_edge(chosen.step.edge);
        const Edge& edge = model.network.edge(chosen.step.edge);
        answers += model.tree.node(mover.node).name + " " +
                   (edge.label.empty() ? mover.target(edge).name : edge.label) +
                   "\n";
      }
      if (chosen.kind == ChoiceKind::Move) {
        answers += model.network.edge(chosen.step.edge).label + "\n";
      }
      simulation.take(std::get<std::size_t>(choice));
    }
  }

  std::string answers;
  std::string refusal;
};

TEST_CASE("each node goes through its results by itself, the last repeats") {
  const Lowered model(
      "(BehaviorTree :name t :loop 1 (ParallelAll (Action :ID go :name a)"
      " (Action :ID go :name b) (Action :ID c :SF 1)))");
  const Played run(model, "go: running*2 success\nb: running success failure\n",
                   4);
  CHECK(run.refusal == "");
  CHECK(run.answers ==
        "a running\nb running\nc success\n"
        "a running\nb success\n"
        "a success\n"
        "a success\nb failure\nc success\n");
}

TEST_CASE("what a script does not speak of takes its first choice") {
  const Lowered model(
      "(defsv b :states (Good Low) :init Low)"
      "(BehaviorTree :name t (Sequence (SetSV :ID m :sv b) (Action :ID a)))");
  CHECK(Played(model, "", 3).answers == "m b := Low\na success\n");
}

TEST_CASE("a measured variable takes its values wherever it is measured") {
  const Lowered model(
      "(defsv b :states (Good Low Bad))"
      "(BehaviorTree :name t :loop 1 (Sequence (SetSV :ID m :sv b)"
      " (SetSV :ID n :sv b)))");
  CHECK(Played(model, "b: Good Low Bad\n", 2).answers ==
        "m b := Good\nn b := Low\nm b := Bad\nn b := Bad\n");
  CHECK(Played(model, "b: Good Low Bad\nn: Good\n", 2).answers ==
        "m b := Good\nn b := Good\nm b := Low\nn b := Good\n");
}

TEST_CASE("a free variable takes one value for each tick") {
  const Lowered model(
      "(defsv w :states (Calm Rain Storm) :transitions ((Calm Rain)"
      " (Rain Storm) (Storm Calm)))"
      "(BehaviorTree :name t (Sequence (Action :ID a) (Eval (= w Calm))))");
  CHECK(Played(model, "w: Calm Rain Rain Storm\na: running*\n", 5).answers ==
        "a running\nw := Rain\na running\na running\nw := Storm\na running\n"
        "a running\n");
  CHECK(Played(model, "w: Calm Storm\na: running*\n", 5).refusal ==
        "error[BT1405]: in tick 2 `w` cannot become Storm\n"
        "  --> s.txt:1:9\n"
        "  |\n"
        "1 | w: Calm Storm\n"
        "  |         ^^^^^ result 2 of `w`\n"
        "  |\n"
        "  = help: there it can stay Calm or become Rain\n");
}

TEST_CASE("the time of an action is up when it has another result") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence (Action :ID a :duration [1,3])"
      " (Action :ID b)))");
  CHECK(Played(model, "a: running*2 success\n", 9).answers ==
        "a running\na running\na success\nb success\n");
  CHECK(Played(model, "a: running failure\n", 9).answers ==
        "a running\na failure\n");
  CHECK(Played(model, "", 9).answers ==
        "a running\na running\na running\na success\nb success\n");
  CHECK(Played(model, "a: success\n", 9).refusal ==
        "error[BT1405]: in tick 1 `a` cannot answer success\n"
        "  --> s.txt:1:4\n"
        "  |\n"
        "1 | a: success\n"
        "  |    ^^^^^^^ result 1 of `a`\n"
        "  |\n"
        "  = help: there it can answer running\n");
  CHECK(Played(model, "a: running*\n", 9)
            .refusal.find("in tick 4 `a` cannot answer running") !=
        std::string::npos);
}

TEST_CASE("an answer that a contract rules out ends the run") {
  const Lowered model(
      "(defsv x :max 2) (defaction a :requires (< x 1))"
      "(BehaviorTree :name t :loop 1 (Sequence (Action :ID a)"
      " (Eval (:= x (+ x 1)))))");
  CHECK(Played(model, "a: success\n", 9).refusal ==
        "error[BT1405]: in tick 2 `a` cannot answer success\n"
        "  --> s.txt:1:4\n"
        "  |\n"
        "1 | a: success\n"
        "  |    ^^^^^^^ result 2 of `a`\n"
        "  |\n"
        "  = help: there it can answer failure\n");
  CHECK(Played(model, "a: success failure\n", 3).refusal == "");
}

TEST_CASE("an answer whose effects are a fault is taken") {
  const Lowered model(
      "(defsv x :max 1) (defaction a :on-success ((:= x (+ x 1))))"
      "(BehaviorTree :name t :loop 1 (Action :ID a))");
  const Played run(model, "a: success*5\n", 9);
  CHECK(run.refusal == "");
  CHECK(run.answers == "a success\na leaves the range of a variable\n");
}

}  // namespace
}  // namespace btcheck::simulation_script_test
