// SPDX-License-Identifier: MIT
//
// The edges that evaluate a condition have it as their label. A node that is
// skipped for what is below it still has the answers of its children before
// the step; most node types pass through `skip`, which forgets them.
#include "trace/run/skipping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace btcheck {
namespace {

constexpr std::string_view kPassing = "skip";

std::vector<NodeId> skipped_children(const Node& node, const Network& network,
                                     const Valuation& state) {
  std::vector<NodeId> found;
  for (const NodeId child : node.children) {
    const std::size_t status = index(network.node_status[index(child)]);
    const auto last = static_cast<NodeStatus>(state.variables[status]);
    if (last == NodeStatus::Skipped || last == NodeStatus::SkippedRunning ||
        last == NodeStatus::SkippedEnded) {
      found.push_back(child);
    }
  }
  return found;
}

}  // namespace

bool begins_to_skip(const Network& network, const RunStep& step) {
  if (step.step.edge == kTimeStep) return false;
  const Automaton& automaton = network.owner_of_edge(step.step.edge);
  const Edge& edge = network.edge(step.step.edge);
  const Location& target = automaton.target(edge);
  return automaton.kind == AutomatonKind::Node &&
         (target.role == LocationRole::Skipped || target.name == kPassing) &&
         automaton.source(edge).name != kPassing && edge.source != edge.target;
}

std::string reason_to_skip(const BehaviorTree& tree, const Network& network,
                           const Valuation& before, const RunStep& step) {
  const Automaton& automaton = network.owner_of_edge(step.step.edge);
  const Edge& edge = network.edge(step.step.edge);
  const Node& node = tree.node(automaton.node);
  // Its _while has become false, and it has halted itself.
  if (automaton.source(edge).role == LocationRole::Halted) {
    return fmt::format("`{}` is false", node.script(ScriptTime::While)->text);
  }
  if (!edge.label.empty()) return edge.label;
  const auto children = skipped_children(node, network, before);
  if (children.empty()) return "";
  if (node.children.size() == 1) return "its child was skipped";
  if (children.size() == node.children.size()) {
    return "all its children were skipped";
  }
  std::string names;
  for (const NodeId child : children) {
    names += (names.empty() ? "" : ", ") + short_name(tree, child);
  }
  return fmt::format("{} {} skipped", names,
                     children.size() == 1 ? "was" : "were");
}

}  // namespace btcheck
