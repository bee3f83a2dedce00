// SPDX-License-Identifier: MIT
//
// A tree without the nodes that change nothing: what findings look at, so that
// a fault is the same however it is wrapped.
//
// Example: in (Inverter (Sequence (Inverter (SubTree a)) (Inverter b))) nothing
// happens that would not in (Fallback a b), and that is what is left of it.
#pragma once

#include <optional>
#include <vector>

#include "check/findings/suspicion.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

class NormalTree {
 public:
  // Must outlive it.
  explicit NormalTree(const BehaviorTree& written);

  const BehaviorTree& written() const { return written_; }
  const BehaviorTree& tree() const { return tree_ ? *tree_ : written_; }

  // Of a node of tree() the written one
  // - that is ticked, runs and answers as it does,
  NodeId acting(NodeId node) const { return at(acting_, node); }
  // - by whose name it is told, which of a subtree is that of the subtree,
  NodeId shown(NodeId node) const { return at(shown_, node); }
  // - that is all that was around it. Its answer is the opposite one where an
  // Inverter has become part of what the parent is.
  NodeId outermost(NodeId node) const { return at(outermost_, node); }
  // The node of tree() that a written one is, or is a part of.
  NodeId of(NodeId written) const { return at(of_, written); }

  // What was found in tree(), as of what is written.
  void put_back(TreeFinding& finding) const;
  void put_back(Suspicion& suspicion) const;

 private:
  // What a written node comes to.
  struct Core {
    NodeId node{};
    NodeId acting{};
    NodeId shown{};
    bool is_dual = false;  // a Fallback that is written as a Sequence
  };

  NodeId at(const std::vector<NodeId>& all, NodeId node) const {
    return tree_ ? all[index(node)] : node;
  }
  bool changes_nothing(const Node& node) const;
  bool is_inverter(NodeId id) const;
  NodeId unwrapped(NodeId id) const;
  std::optional<NodeId> negation(NodeId id) const;
  bool is_dual(NodeId inverter) const;
  Core core(NodeId id) const;
  NodeId add(NodeId written, NodeId parent, bool is_turned);

  const BehaviorTree& written_;
  std::optional<BehaviorTree> tree_;  // nothing where all is as written
  std::vector<NodeId> acting_;
  std::vector<NodeId> shown_;
  std::vector<NodeId> outermost_;
  std::vector<bool> is_turned_;
  std::vector<NodeId> of_;
};

}  // namespace btcheck
