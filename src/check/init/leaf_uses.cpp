// SPDX-License-Identifier: MIT
#include "check/init/leaf_uses.hpp"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "text/findings.hpp"

namespace btcheck {
namespace {

// Through decorators that pass an answer on, and an Inverter.
const Node& asked_in(const BehaviorTree& tree, NodeId id) {
  const Node* node = &tree.node(id);
  while (info_of(node->type).flow == Flow::AsChild ||
         node->type == NodeType::Inverter) {
    node = &tree.node(node->children[0]);
  }
  return *node;
}

// A leaf of the program, by the name that a contract has for it; else "".
std::string named(const Node& node, NodeType type) {
  const bool is_engines =
      node.id == "AlwaysSuccess" || node.id == "AlwaysFailure";
  if (node.type != type || is_engines) return {};
  return contract_name(node.id).value_or("");
}

NodeId end_of(const BehaviorTree& tree, NodeId node) {
  while (!tree.node(node).children.empty()) {
    node = tree.node(node).children.back();
  }
  return NodeId{index(node) + 1};
}

}  // namespace

void LeafUses::add(const BehaviorTree& tree) {
  for (const Node& node : tree.nodes) {
    ask_budget();
    const std::string action = named(node, NodeType::Action);
    if (!action.empty()) ++forgiven_[action].all;
    if (node.type == NodeType::ForceSuccess) {
      const std::string forgiven =
          named(asked_in(tree, node.children[0]), NodeType::Action);
      if (!forgiven.empty()) ++forgiven_[forgiven].yes;
    }
    const bool guards =
        info_of(node.type).flow == Flow::OnSuccess && node.children.size() > 1;
    if (guards) add_guards(tree, node);
  }
}

// Its conditions, and the actions behind each.
void LeafUses::add_guards(const BehaviorTree& tree, const Node& above) {
  const bool asks_again = info_of(above.type).beside == Beside::TheLeft;
  std::set<std::string> actions;
  for (std::size_t i = above.children.size(); i-- > 0;) {
    const NodeId child = above.children[i];
    const std::string condition =
        named(asked_in(tree, child), NodeType::Condition);
    if (!condition.empty()) {
      for (const std::string& action : actions) {
        Count& count = asked_[{condition, action}];
        ++count.all;
        count.yes += asks_again;
      }
    }
    const NodeId end = end_of(tree, child);
    for (NodeId at = child; at < end; at = NodeId{index(at) + 1}) {
      ask_budget();
      const std::string action = named(tree.node(at), NodeType::Action);
      if (!action.empty() && tree.node(at).contract.may_run) {
        actions.insert(action);
      }
    }
  }
}

std::string LeafUses::proposals() const {
  std::string text;
  const auto propose = [&](const Count& count, const std::string& what,
                           const std::string& contract) {
    text += fmt::format("; In {} of {} places {}:\n; {}\n", count.yes,
                        count.all, what, contract);
  };
  // The actions of a condition with the same count in one.
  for (auto at = asked_.begin(); at != asked_.end();) {
    const std::string& condition = at->first.first;
    const Count count = at->second;
    std::vector<std::string> actions;
    for (; at != asked_.end() && at->first.first == condition &&
           at->second == count;
         ++at) {
      actions.push_back(at->first.second);
    }
    if (!count.is_mostly_so()) continue;
    propose(count,
            fmt::format("{} is asked as long as {} run{}", condition,
                        enumerated(actions), actions.size() == 1 ? "s" : ""),
            fmt::format("(defcondition {} :holds-while ({}))", condition,
                        fmt::join(actions, " ")));
  }
  for (const auto& [action, count] : forgiven_) {
    if (!count.is_mostly_so()) continue;
    propose(count, fmt::format("nobody hears of a failure of {}", action),
            fmt::format("(defaction {} :may-be-lost)", action));
  }
  if (text.empty()) return {};
  return "; What the trees do in most places. Where it is meant, take the\n"
         "; comment sign away: what does otherwise is then a warning.\n" +
         text;
}

}  // namespace btcheck
