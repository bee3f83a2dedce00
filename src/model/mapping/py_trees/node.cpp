// SPDX-License-Identifier: MIT
//
// What the drawings of py_trees have in common: a node that is stopped is
// INVALID, and so is all that it has ticked.
#include "model/mapping/py_trees/drawings.hpp"

#include <utility>

namespace btcheck::mapping {

std::vector<Assignment> all_invalid(const Context& context, NodeId node) {
  const BehaviorTree& tree = context.tree;
  std::vector<Assignment> updates;
  std::vector<NodeId> open = {node};
  while (!open.empty()) {
    const NodeId at = open.back();
    open.pop_back();
    updates.push_back(set(context.status(at), NodeStatus::NoRetStatus));
    const auto& below = tree.node(at).children;
    open.insert(open.end(), below.begin(), below.end());
  }
  return updates;
}

std::vector<Assignment> PyTreesBuilder::invalid(std::size_t child) {
  return all_invalid(draw().context(), draw().child(child));
}

std::vector<Assignment> PyTreesBuilder::invalid(
    const std::vector<std::size_t>& of) {
  std::vector<Assignment> updates;
  for (const std::size_t child : of) {
    updates = joined(std::move(updates), invalid(child));
  }
  return updates;
}

void PyTreesBuilder::stop(LocationId from, LocationId then,
                          const std::vector<std::size_t>& children,
                          std::vector<Assignment> updates) {
  halt(from, then, children, joined(std::move(updates), invalid(children)));
}

std::vector<std::size_t> PyTreesBuilder::behind(std::size_t child) const {
  std::vector<std::size_t> others = all_children();
  others.erase(others.begin(),
               others.begin() + static_cast<std::ptrdiff_t>(child + 1));
  return others;
}

void PyTreesBuilder::on_stop(std::vector<Assignment> updates) {
  stop(at("halt"), at("halted"), all_children(), std::move(updates));
}

}  // namespace btcheck::mapping
