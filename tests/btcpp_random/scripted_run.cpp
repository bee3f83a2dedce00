// SPDX-License-Identifier: MIT
#include "btcpp_random/scripted_run.hpp"

#include <cctype>
#include <variant>

#include "check/simulate/script.hpp"
#include "check/simulate/simulation.hpp"
#include "model/automata/network.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "trace/formats/text.hpp"

namespace btcheck::reference {
namespace {

// More choices than a tick of a small tree can have: it goes round in itself.
constexpr int kMostChoices = 20'000;

bool is_open(const Simulation& simulation) {
  const auto choices = simulation.choices();
  return choices.size() > 1 && choices[0].kind != ChoiceKind::Answer;
}

std::string statuses_of(const BehaviorTree& tree, const Network& network,
                        const Valuation& state) {
  const auto words = status_names(tree.profile);
  std::string letters;
  for (std::uint32_t n = 1; n < tree.nodes.size(); ++n) {
    const Node& above = tree.node(tree.nodes[n].parent);
    const bool is_asked = above.type == NodeType::EternalGuard &&
                          above.children.front() == NodeId{n};
    const int status = state.variables[index(network.node_status[n])];
    letters += is_asked ? '?'
                        : static_cast<char>(std::toupper(
                              words[static_cast<std::size_t>(status)].front()));
  }
  return letters;
}

}  // namespace

TreeReading scripted_reading(Profile profile, const std::string& leaves) {
  TreeReading reading;
  reading.profile = profile;
  reading.loops = true;
  reading.leaves = {{"t.leaves", leaves}};
  return reading;
}

ScriptedRun scripted_run(const BehaviorTree& tree, const std::string& script,
                         int ticks) {
  const Network network = lower(tree, TickSemantics::Root);
  const auto read = read_simulation_script(tree, network, "script", script);
  if (!read.value) return {};
  const SourceText source("script", script);
  ScriptPlayer player(*read.value, source);
  Simulation simulation(tree, network, Interleaving::InOrder);
  TickLines lines(tree, network);
  ScriptedRun run{"", "", true};
  const NodeId root = tree.roots.front();
  for (int i = 0; simulation.end() == RunEnd::None; ++i) {
    const bool begins = simulation.choices()[0].kind == ChoiceKind::Tick;
    if (begins && simulation.ticks(root) >= ticks) break;
    const ScriptedChoice choice = player.choose(simulation);
    const auto* number = std::get_if<std::size_t>(&choice);
    if (is_open(simulation) || number == nullptr || i == kMostChoices) {
      return {std::move(run.lines), std::move(run.statuses), false};
    }
    simulation.take(*number);
    simulation.for_each_latest([&](const Valuation&, const RunStep& step) {
      const std::string line = lines.take(step);
      if (line.empty()) return;
      run.lines += line + '\n';
      run.statuses += statuses_of(tree, network, step.after) + '\n';
    });
  }
  run.lines += lines.rest(simulation.state());
  return run;
}

}  // namespace btcheck::reference
