// SPDX-License-Identifier: MIT
//
// A tree, ready to be asked what the kinds of findings ask.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "check/findings/normal_tree.hpp"
#include "model/automata/network.hpp"
#include "model/tree/answers.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

class TreeFacts {
 public:
  // Must outlive it.
  explicit TreeFacts(const NormalTree& normal);

  const BehaviorTree& tree() const { return tree_; }
  const Node& node(NodeId id) const { return tree_.node(id); }
  const Answers& answers(NodeId id) const { return answers_[index(id)]; }

  // Below a node or the node itself.
  bool is_in(NodeId node, NodeId above) const {
    return index(above) <= index(node) && index(node) < end_[index(above)];
  }
  // Behind the last node below it.
  NodeId end_of(NodeId node) const { return NodeId{end_[index(node)]}; }
  // In pre-order, the node itself first.
  std::vector<NodeId> subtree(NodeId node) const;
  std::vector<NodeId> leaves(NodeId node) const;

  // Of the node or one below: may it be running when a tick ends?
  bool may_run(NodeId node) const { return may_run_[index(node)]; }
  // A leaf that looks at the world and changes nothing.
  bool is_condition(NodeId node) const;
  // A leaf that does something: no condition, no script, no wait.
  bool is_deed(NodeId node) const;
  std::size_t deeds(NodeId node) const;  // how many it has below it
  bool has_deed(NodeId node) const { return deeds(node) > 0; }
  // What the owner says of all the deeds below a node, or of the leaf that it
  // is: no where one of them may not, yes where each may.
  using Meaning = std::optional<bool> LeafMeaning::*;
  std::optional<bool> said(NodeId node, Meaning meaning) const;
  std::optional<bool> said(const std::vector<NodeId>& nodes,
                           Meaning meaning) const;
  // By one of the names that a contract gives.
  bool is_named(NodeId leaf, const std::vector<std::string>& names) const;
  // It only tells somebody: so says its owner, or else its name.
  bool only_tells(NodeId leaf) const;
  // AlwaysSuccess, AlwaysFailure: all that it has is its answer.
  bool is_constant(NodeId node) const;
  // Through SubTrees and decorators that pass their child's answer on.
  NodeId core(NodeId node) const;
  // Where the one below fails, so does the child of `above` that it stands in.
  bool fails_with(NodeId above, NodeId below) const;
  // What a node above answers as soon as its child has answered so, if that
  // decides it.
  std::optional<LocationRole> decided(NodeId above, NodeId child,
                                      LocationRole answer) const;
  // Does the mission go on behind this node when it has succeeded?
  bool is_relied_on(NodeId node) const;
  // Which child of its parent it is, from 0.
  std::size_t place_of(NodeId node) const;
  // The child of a node that another one is, or stands in.
  NodeId child_with(NodeId above, NodeId node) const;
  NodeId parent(NodeId node) const { return tree_.node(node).parent; }
  bool is_root(NodeId node) const { return tree_.node(node).is_root(); }

  // How the name is told: "`land`", with the line where several have it.
  std::string told(NodeId node) const;

  // "`a`, `b` and `c`".
  std::string told(const std::vector<NodeId>& nodes) const;
  // The same of many: "`a`, `b` and 7 more".
  std::string few(const std::vector<NodeId>& nodes) const;

  const std::vector<EntryUse>& uses() const { return tree_.entry_uses; }
  // Those of a node, and those of an entry, in their order.
  using Uses = std::span<const EntryUse* const>;
  Uses uses_of(NodeId node) const { return of_node_.uses(index(node)); }
  Uses uses_of_entry(std::uint32_t entry) const {
    return of_entry_.uses(entry);
  }

  // Where an edit names the node; and with all that stands around it alone.
  SourcePlace place(NodeId node) const;
  SourcePlace whole(NodeId node) const;
  // How the file writes its type.
  std::string type_word(NodeId node) const;
  // Of an XML tree for version 4 of the engine, which has scripts.
  bool has_scripts() const;

 private:
  // Uses sorted by something that each has one number of.
  class UsesBy {
   public:
    template <class Key>
    UsesBy(const std::vector<EntryUse>& uses, std::size_t keys, Key key);
    Uses uses(std::uint32_t key) const {
      return Uses(sorted_).subspan(first_[key], first_[key + 1] - first_[key]);
    }

   private:
    std::vector<std::uint32_t> first_;  // by key, and the end
    std::vector<const EntryUse*> sorted_;
  };

  const NormalTree& normal_;
  const BehaviorTree& tree_;
  UsesBy of_node_;
  UsesBy of_entry_;
  std::vector<Answers> answers_;
  std::vector<std::uint32_t> end_;  // by node: behind its last descendant
  std::vector<bool> may_run_;
  bool has_meanings_ = false;                // of any leaf
  std::vector<std::uint32_t> deeds_before_;  // by node, and at the end
  mutable std::vector<std::string> names_;   // by node, once one is told
};

// A leaf that nothing describes, and whose name is that of a condition.
bool is_taken_for_condition(const Node& node);
// Whether a node may be ticked between two ticks of a running action.
bool is_ticked_while(const BehaviorTree& tree, NodeId node, NodeId running);
// A node that resumes its running child: the others are not asked meanwhile.
bool resumes(const Node& node);
bool is_reactive(const Node& node);
// KeepRunningUntilFailure, Repeat, RetryUntilSuccessful, without end.
bool is_endless(const Node& node);

}  // namespace btcheck
