// SPDX-License-Identifier: MIT
#include "check/simulate/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "check/simulate/script.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace {

// A root is about to begin a tick that was not asked for.
bool is_past(const Simulation& simulation, int ticks) {
  const auto choices = simulation.choices();
  if (choices[0].kind != ChoiceKind::Tick) return false;
  const Automaton& mover =
      simulation.network().owner_of_edge(choices[0].step.edge);
  return simulation.ticks(mover.node) >= ticks;
}

bool goes_on(const Simulation& simulation, const Course& course) {
  if (!course.may_go_on() || simulation.end() != RunEnd::None) return false;
  const bool only_moves = simulation.choices()[0].kind == ChoiceKind::Move;
  return (!only_moves || simulation.must_move()) &&
         !is_past(simulation, course.ticks);
}

template <class Chooser>
Result<Simulation> simulated(const BehaviorTree& tree, const Network& network,
                             Interleaving interleaving, const Course& course,
                             Chooser choose) {
  Simulation simulation(tree, network, interleaving);
  std::vector<Diagnostic> findings;
  while (findings.empty() && goes_on(simulation, course)) {
    ScriptedChoice choice = choose(simulation);
    if (auto* refusal = std::get_if<Diagnostic>(&choice)) {
      findings.push_back(std::move(*refusal));
      continue;
    }
    simulation.take(std::get<std::size_t>(choice));
    simulation.for_each_latest(course.told);
  }
  return {std::move(simulation), std::move(findings)};
}

std::string how_trees_ended(const Simulation& simulation) {
  const BehaviorTree& tree = simulation.tree();
  std::string text;
  for (const NodeId root : tree.roots) {
    const VariableId status = simulation.network().node_status[index(root)];
    const auto answer =
        static_cast<std::size_t>(simulation.state().variables[index(status)]);
    text +=
        fmt::format("{}{} ended with {} in tick {}", text.empty() ? "" : ", ",
                    tree.node(root).name, status_names(tree.profile)[answer],
                    simulation.ticks(root));
  }
  return text;
}

}  // namespace

Result<Simulation> simulated_at_random(const BehaviorTree& tree,
                                       const Network& network,
                                       std::uint64_t seed,
                                       const Course& course) {
  SplitMix64 random(seed);
  return simulated(
      tree, network, Interleaving::Open, course,
      [&](const Simulation& simulation) {
        return ScriptedChoice(random_choice(simulation.choices(), random));
      });
}

Result<Simulation> simulated_by_script(const BehaviorTree& tree,
                                       const Network& network,
                                       const SourceText& script,
                                       const Course& course) {
  auto read =
      read_simulation_script(tree, network, script.name(), script.text());
  if (!read.value) return {std::nullopt, std::move(read.diagnostics)};
  ScriptPlayer player(*read.value, script);
  return simulated(
      tree, network, Interleaving::InOrder, course,
      [&](const Simulation& simulation) { return player.choose(simulation); });
}

int most_ticks(const Simulation& simulation) {
  int most = 0;
  for (const NodeId root : simulation.tree().roots) {
    most = std::max(most, simulation.ticks(root));
  }
  return most;
}

std::string ending_text(const Simulation& simulation, int ticks) {
  const int last = most_ticks(simulation);
  switch (simulation.end()) {
    case RunEnd::Ended:
      return how_trees_ended(simulation);
    case RunEnd::Fault:
      return fmt::format(
          "a fault ended the run in tick {}: an assignment out of range, or a "
          "division by zero",
          last);
    case RunEnd::Stuck:
      return fmt::format("the tree is stuck in tick {}: no node can go on",
                         last);
    case RunEnd::None:
      break;
  }
  return last >= ticks
             ? fmt::format("stopped after {} tick{}; {} asks for more", ticks,
                           ticks == 1 ? "" : "s", word(Choice::Ticks))
             : fmt::format("stopped in tick {}", last);
}

}  // namespace btcheck
