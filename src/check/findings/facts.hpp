// SPDX-License-Identifier: MIT
//
// A tree, ready to be asked what the kinds of findings ask.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/tree/answers.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

class TreeFacts {
 public:
  explicit TreeFacts(const BehaviorTree& tree);

  const BehaviorTree& tree() const { return tree_; }
  const Node& node(NodeId id) const { return tree_.node(id); }
  const Answers& answers(NodeId id) const { return answers_[index(id)]; }

  // Below a node or the node itself.
  bool is_in(NodeId node, NodeId above) const {
    return index(above) <= index(node) && index(node) < end_[index(above)];
  }
  // In pre-order, the node itself first.
  std::vector<NodeId> subtree(NodeId node) const;
  std::vector<NodeId> leaves(NodeId node) const;

  // Of the node or one below: may it be running when a tick ends?
  bool may_run(NodeId node) const { return may_run_[index(node)]; }
  // A leaf that looks at the world and changes nothing.
  bool is_condition(NodeId node) const;
  // A leaf that does something: no condition, no script, no wait.
  bool is_deed(NodeId node) const;
  bool has_deed(NodeId node) const;
  // Through SubTrees and decorators that pass their child's answer on.
  NodeId core(NodeId node) const;
  // Does the mission go on behind this node when it has succeeded?
  bool is_relied_on(NodeId node) const;
  // Which child of its parent it is, from 0.
  std::size_t place_of(NodeId node) const;
  NodeId parent(NodeId node) const { return tree_.node(node).parent; }
  bool is_root(NodeId node) const { return tree_.node(node).is_root(); }

  // How the name is told: "`land`", with the line where several have it.
  std::string told(NodeId node) const;

  // "`a`, `b` and `c`".
  std::string told(const std::vector<NodeId>& nodes) const;

  const std::vector<EntryUse>& uses() const { return tree_.entry_uses; }

  // Where an edit names the node.
  SourcePlace place(NodeId node) const;
  // How the file writes its type.
  std::string type_word(NodeId node) const;
  // Of an XML tree for version 4 of the engine, which has scripts.
  bool has_scripts() const;

 private:
  const BehaviorTree& tree_;
  std::vector<Answers> answers_;
  std::vector<std::uint32_t> end_;  // by node: behind its last descendant
  std::vector<bool> may_run_;
};

// Whether a node may be ticked between two ticks of a running action.
bool is_ticked_while(const BehaviorTree& tree, NodeId node, NodeId running);
// A node that resumes its running child: the others are not asked meanwhile.
bool resumes(const Node& node);
bool is_reactive(const Node& node);
// KeepRunningUntilFailure, Repeat, RetryUntilSuccessful, without end.
bool is_endless(const Node& node);

}  // namespace btcheck
