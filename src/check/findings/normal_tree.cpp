// SPDX-License-Identifier: MIT
//
// A subtree stands where it is used; a Sequence or Fallback of one child
// answers what that answers; two Inverters cancel out; and a Sequence of
// Inverters below one is a Fallback, as a Fallback of Inverters is a Sequence.
// Whatever has a condition or script of its own stays.
#include "check/findings/normal_tree.hpp"

#include <algorithm>
#include <utility>

#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

constexpr NodeId kNowhere{static_cast<std::uint32_t>(-1)};

std::optional<NodeType> dual_of(NodeType type) {
  switch (type) {
    case NodeType::Sequence:
      return NodeType::Fallback;
    case NodeType::Fallback:
      return NodeType::Sequence;
    case NodeType::ReactiveSequence:
      return NodeType::ReactiveFallback;
    case NodeType::ReactiveFallback:
      return NodeType::ReactiveSequence;
    default:
      return std::nullopt;
  }
}

NodeStatus turned(NodeStatus status) {
  if (status == NodeStatus::Success) return NodeStatus::Failure;
  return status == NodeStatus::Failure ? NodeStatus::Success : status;
}

}  // namespace

NormalTree::NormalTree(const BehaviorTree& written) : written_(written) {
  const auto& nodes = written.nodes;
  const auto may_go = [&](const Node& node) {
    const NodeId id{static_cast<std::uint32_t>(&node - nodes.data())};
    return changes_nothing(node) ||
           (is_inverter(id) && (negation(node.children[0]) || is_dual(id)));
  };
  if (!is_engine(written.profile) || std::ranges::none_of(nodes, may_go)) {
    return;
  }
  BehaviorTree& made = tree_.emplace();
  made.file = written.file;
  made.included = written.included;
  made.profile = written.profile;
  made.variables = written.variables;
  made.open_entries = written.open_entries;
  made.entries = written.entries;
  made.entry_uses = written.entry_uses;
  made.programs = written.programs;
  of_.resize(nodes.size(), kNowhere);
  for (const NodeId root : written.roots) {
    made.roots.push_back(add(root, {}, false));
  }
  for (std::size_t n = nodes.size(); n-- > 0;) {
    if (of_[n] == kNowhere) of_[n] = of_[index(nodes[n].children[0])];
  }
  for (EntryUse& use : made.entry_uses) use.node = of_[index(use.node)];
}

bool NormalTree::changes_nothing(const Node& node) const {
  return node.children.size() == 1 && node.scripts.empty() &&
         (node.type == NodeType::SubTree || dual_of(node.type));
}

bool NormalTree::is_inverter(NodeId id) const {
  const Node& node = written_.node(id);
  return node.type == NodeType::Inverter && node.scripts.empty();
}

NodeId NormalTree::unwrapped(NodeId id) const {
  while (changes_nothing(written_.node(id))) {
    id = written_.node(id).children[0];
  }
  return id;
}

// What an Inverter turns round, if the node is one.
std::optional<NodeId> NormalTree::negation(NodeId id) const {
  id = unwrapped(id);
  if (!is_inverter(id)) return std::nullopt;
  return written_.node(id).children[0];
}

bool NormalTree::is_dual(NodeId inverter) const {
  const Node& below = written_.node(unwrapped(*negation(inverter)));
  return dual_of(below.type) && below.scripts.empty() &&
         std::ranges::all_of(below.children, [&](NodeId child) {
           return negation(child).has_value();
         });
}

NormalTree::Core NormalTree::core(NodeId id) const {
  Core core{id, id, id};
  std::optional<NodeId> subtree;
  while (true) {
    const Node& node = written_.node(core.node);
    if (changes_nothing(node)) {
      if (node.type == NodeType::SubTree && !subtree) subtree = core.node;
      core.node = node.children[0];
      continue;
    }
    if (!is_inverter(core.node)) break;
    const auto twice = negation(node.children[0]);
    if (twice && !is_dual(unwrapped(node.children[0]))) {
      core.node = *twice;
      continue;
    }
    if (is_dual(core.node)) {
      core.acting = core.node;
      core.node = unwrapped(node.children[0]);
      core.is_dual = true;
      core.shown = subtree.value_or(core.node);
      return core;
    }
    break;
  }
  core.acting = core.node;
  const bool has_name = is_leaf(written_.node(core.node).type);
  core.shown = subtree && !has_name ? *subtree : core.node;
  return core;
}

NodeId NormalTree::add(NodeId written, NodeId parent, bool is_turned) {
  ask_budget();
  BehaviorTree& made = *tree_;
  const NodeId id{static_cast<std::uint32_t>(made.nodes.size())};
  const Core found = core(is_turned ? *negation(written) : written);
  Node node = written_.node(found.node);
  const std::vector<NodeId> children = std::exchange(node.children, {});
  node.parent = node.is_root() ? id : parent;
  if (found.is_dual) {
    node.type = *dual_of(node.type);
    node.id = type_name(node.type);
  }
  made.nodes.push_back(std::move(node));
  acting_.push_back(found.acting);
  shown_.push_back(found.shown);
  outermost_.push_back(written);
  is_turned_.push_back(is_turned);
  of_[index(found.node)] = id;
  for (const NodeId child : children) {
    const NodeId added = add(child, id, found.is_dual);
    made.nodes[index(id)].children.push_back(added);
  }
  return id;
}

void NormalTree::put_back(TreeFinding& finding) const {
  finding.node = shown(finding.node);
  for (NodeId& each : finding.others) each = shown(each);
  for (NodeId& each : finding.folded) each = shown(each);
}

// A node that has answered may be reset by what is around it: what it answered
// is seen further out.
void NormalTree::put_back(Suspicion& suspicion) const {
  put_back(suspicion.finding);
  for (auto* sightings : {&suspicion.shown_by, &suspicion.cleared_by}) {
    for (Sighting& each : *sightings) {
      each.node = acting(each.node);
      for (auto& [node, status] : each.with) {
        if (tree_ && is_turned_[index(node)]) status = turned(status);
        node = outermost(node);
      }
      if (each.retried) each.retried = acting(*each.retried);
    }
  }
  for (auto* consequence : {&suspicion.then, &suspicion.after}) {
    if (*consequence) (*consequence)->node = acting((*consequence)->node);
  }
}

}  // namespace btcheck
