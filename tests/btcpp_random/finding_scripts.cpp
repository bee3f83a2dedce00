// SPDX-License-Identifier: MIT
#include "btcpp_random/finding_scripts.hpp"

#include <fmt/format.h>

#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "btcpp_random/scripted_run.hpp"
#include "check/questions/defaults.hpp"
#include "explore/state/step.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "trace/formats/text.hpp"

namespace btcheck::reference {
namespace {

// Larger trees are not searched.
constexpr std::size_t kMostStates = 20'000;

// What the leaves answer on the run, in its order: one line for each. A leaf
// that is not asked keeps its line.
std::string script_of(const BehaviorTree& tree, const Network& network,
                      const KeptRun& run, const std::string& before) {
  std::map<std::string, std::string> results;
  for (const Step& step : run.steps()) {
    if (step.edge == kTimeStep || !network.edge(step.edge).asks_world) continue;
    const Automaton& owner = network.owner_of_edge(step.edge);
    if (owner.kind != AutomatonKind::Node) continue;
    const Node& leaf = tree.node(owner.node);
    if (leaf.type != NodeType::Action && leaf.type != NodeType::Condition) {
      continue;
    }
    results[leaf.id] += ' ' + network.edge(step.edge).label;
  }
  std::istringstream lines(before);
  std::string script;
  for (std::string line; std::getline(lines, line);) {
    const auto found = results.find(line.substr(0, line.find(':')));
    script += found == results.end()
                  ? line + '\n'
                  : fmt::format("{}:{}\n", found->first, found->second);
  }
  return script;
}

// The lines of the ticks that the run has, the last of which may be cut off.
std::string lines_of(const BehaviorTree& tree, const Network& network,
                     const KeptRun& run) {
  std::string text;
  TickLines lines(tree, network);
  run.walk([&](const Valuation&, const RunStep& step) {
    const std::string line = lines.take(step);
    if (!line.empty()) text += line + '\n';
  });
  return text;
}

}  // namespace

std::vector<ScriptedTree> finding_scripts(const ScriptedTree& made,
                                          Profile profile) {
  const auto tree =
      read_tree("t.xml", made.xml, scripted_reading(profile, made.leaves));
  if (!tree.value) throw std::logic_error("a tree that cannot be read");
  const Network network = lower(*tree.value, TickSemantics::Root);
  const CompiledNetwork system(network);
  Limits limits;
  limits.max_states = kMostStates;
  const DefaultReport report =
      check_defaults(*tree.value, system, Reduction::None, limits);
  std::vector<ScriptedTree> scripts;
  for (const TreeFinding& finding : report.findings) {
    if (!finding.run) continue;
    ScriptedTree one = made;
    one.script = script_of(*tree.value, network, *finding.run, made.script);
    const int count = finding.run->ticks() + 1;
    const ScriptedRun played = scripted_run(*tree.value, one.script, count);
    const std::string lines = lines_of(*tree.value, network, *finding.run);
    if (!played.is_determined || !played.lines.starts_with(lines)) continue;
    scripts.push_back(std::move(one));
  }
  return scripts;
}

}  // namespace btcheck::reference
