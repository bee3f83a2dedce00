// SPDX-License-Identifier: MIT
//
// A tick of a tree is what happens from where its root leaves `tick_node` to
// where it answers. Who does what in it is read off the edges that fire.
#include "trace/run/tick_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace btcheck {
namespace {

std::string shown_key(const std::string& name) {
  if (name.find_first_of(" \t\"=,") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::vector<std::string> tick_line_keys(const BehaviorTree& tree) {
  std::map<std::string, int> uses = {{"root", 1}};
  for (const StateVariable& variable : tree.variables) ++uses[variable.name];
  std::vector<std::string> keys;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    keys.push_back(short_name(tree, NodeId{n}));
    ++uses[keys.back()];
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (uses[keys[n]] > 1) keys[n] = unique_name(tree, NodeId{n});
    keys[n] = shown_key(keys[n]);
  }
  return keys;
}

TickLines::TickLines(const BehaviorTree& tree, const Network& network)
    : tree_(tree),
      network_(network),
      keys_(tick_line_keys(tree)),
      ticks_(tree.nodes.size()),
      is_visited_(tree.nodes.size()),
      answers_(tree.nodes.size()) {
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    root_of_.push_back(node.is_root() ? NodeId{n}
                                      : root_of_[index(node.parent)]);
  }
}

void TickLines::note(NodeId node, const Location& location) {
  const std::uint32_t n = index(node);
  const LocationRole role = location.role;
  if (role == LocationRole::Tick || role == LocationRole::Halt) {
    is_visited_[n] = true;
  }
  if (!is_answer(role) && role != LocationRole::Halted &&
      role != LocationRole::Error) {
    return;
  }
  if (!answers_[n].empty()) answers_[n] += ',';
  answers_[n] += location.name;
}

std::string TickLines::take(const RunStep& step) {
  if (step.step.edge == kTimeStep) return {};
  const Automaton& mover = network_.owner_of_edge(step.step.edge);
  if (mover.kind != AutomatonKind::Node) return {};
  const Edge& edge = network_.edge(step.step.edge);
  const Location& target = mover.target(edge);
  if (!tree_.node(mover.node).is_root()) {
    note(mover.node, target);
    return {};
  }
  Tick& tick = ticks_[index(mover.node)];
  if (mover.source(edge).role == LocationRole::Tick) {
    ++tick.number;
    tick.is_open = true;
  }
  if (!is_answer(target.role)) return {};
  tick.is_open = false;
  const std::string text = line(mover.node, target.name, step.after);
  for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
    if (root_of_[n] != mover.node) continue;
    is_visited_[n] = false;
    answers_[n].clear();
  }
  return text;
}

std::string TickLines::rest(const Valuation& last) const {
  std::string text;
  for (const NodeId root : tree_.roots) {
    if (ticks_[index(root)].is_open) text += line(root, "none", last) + '\n';
  }
  return text;
}

std::string TickLines::line(NodeId root, std::string_view answer,
                            const Valuation& state) const {
  std::string text = fmt::format("tick {}", ticks_[index(root)].number);
  if (tree_.roots.size() > 1) text += fmt::format(" of {}", keys_[index(root)]);
  text += fmt::format(": root={}", answer);
  for (std::size_t v = 0; v < tree_.variables.size(); ++v) {
    const int value = state.variables[index(network_.state_variable[v])];
    text += fmt::format(" {}={}", tree_.variables[v].name,
                        tree_.variables[v].value_name(value));
  }
  for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
    if (root_of_[n] != root || !is_visited_[n]) continue;
    text += fmt::format(" {}={}", keys_[n],
                        answers_[n].empty() ? "none" : answers_[n]);
  }
  return text;
}

std::string tick_lines(const BehaviorTree& tree, const Network& network,
                       const Run& run) {
  TickLines lines(tree, network);
  std::string text;
  for (const RunStep& step : run.steps) {
    const std::string line = lines.take(step);
    if (!line.empty()) text += line + '\n';
  }
  return text + lines.rest(run.state(run.steps.size()));
}

}  // namespace btcheck
