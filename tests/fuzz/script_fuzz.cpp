// SPDX-License-Identifier: MIT
//
// Any bytes as a script of leaf results: an answer or errors, never both, never
// a crash; and what was read can be run.
#include <cstddef>
#include <string_view>
#include <variant>

#include "check/simulate/script.hpp"
#include "check/simulate/simulation.hpp"
#include "fuzzed.hpp"
#include "model/automata/network.hpp"
#include "model/lowering.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {
namespace {

struct Model {
  Model() {
    auto read = read_btf(
        "fuzz.btf",
        "(defsv battery :states (Good Low Critical))\n"
        "(defsv height :min -2 :max 9)\n"
        "(defsv w :states (Calm Storm) :transitions :all :moves free)\n"
        "(defaction dock :requires (= w Calm) :duration [1,3])\n"
        "(BehaviorTree :name t :loop 1 (ReactiveSequence :name r :halt 1\n"
        " (Condition :ID ready) (ParallelAll (SetSV :ID measure :sv battery)\n"
        "  (SetSV :ID look :sv height) (Eval :name calm (= w Calm)))\n"
        " (Action :ID go :name first) (Action :ID go) (Action :ID dock)\n"
        " (Wait :name rest :duration 1)))");
    require(read.value.has_value());
    tree = std::move(*read.value);
    network = lower(tree, TickSemantics::Root);
  }
  BehaviorTree tree;
  Network network;
};

void check_script(const Model& model, const SimulationScript& script) {
  require(script.of_node.size() == model.tree.nodes.size());
  require(script.of_variable.size() == model.tree.variables.size());
  for (const auto* owners : {&script.of_node, &script.of_variable}) {
    for (const auto& sequence : *owners) {
      require(!sequence || *sequence < script.sequences.size());
    }
  }
  for (const ScriptedSequence& sequence : script.sequences) {
    require(!sequence.name.empty());
    require(!sequence.results.empty());
    for (const ScriptedResult& result : sequence.results) {
      require(result.times >= 1);
      require(result.begin < result.end);
    }
  }
}

void run(const Model& model, const SimulationScript& script,
         const SourceText& source) {
  Simulation simulation(model.tree, model.network, Interleaving::InOrder);
  ScriptPlayer player(script, source);
  for (int i = 0; i < 60 && simulation.end() == RunEnd::None; ++i) {
    const ScriptedChoice choice = player.choose(simulation);
    if (const auto* refusal = std::get_if<Diagnostic>(&choice)) {
      require(!render(*refusal).empty());
      return;
    }
    require(std::get<std::size_t>(choice) < simulation.choices().size());
    simulation.take(std::get<std::size_t>(choice));
  }
}

}  // namespace

void check_bytes(std::string_view text) {
  static const Model model;
  const auto read =
      read_simulation_script(model.tree, model.network, "fuzz.txt", text);
  require_sound(read);
  require(read.diagnostics.size() <= 20);
  if (!read.value) return;
  check_script(model, *read.value);
  run(model, *read.value, SourceText("fuzz.txt", text));
}

}  // namespace btcheck
