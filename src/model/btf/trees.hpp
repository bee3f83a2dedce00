// SPDX-License-Identifier: MIT
//
// (BehaviorTree …): the nodes of each form (nodes.cpp), and what names refer to
// (references.cpp): a SubTree to another form, `name.rstatus` to a node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btf/forms.hpp"
#include "model/btf/variables.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

// Index into the list of BehaviorTree forms.
using TreeNumber = std::size_t;

// A node with everything that does not depend on other nodes.
struct NodeDraft {
  Node node;  // `children`, `parent` and what is made of expressions are unset
  FormId form{};
  std::vector<std::uint32_t> children;  // indices into the TreeDraft
  std::optional<FormId> expression;     // of an Eval
  std::optional<FormId> arguments;      // the list after :args
  SourceSpan reference;                 // of the name a SubTree refers to
  std::optional<TreeNumber> refers_to;  // the form of that name, once known
  std::uint32_t words = 0;              // its own, without its children's
};

// One BehaviorTree form: its root first, the others in pre-order.
using TreeDraft = std::vector<NodeDraft>;

// The node type with that name, in any case.
std::optional<NodeType> find_node_type(std::string_view word);
TreeDraft read_tree(const Reading& reading, const Variables& variables,
                    FormId form);

// The forms with, for each SubTree node, the form it refers to.
class TreeForms {
 public:
  // Reports two forms of one name, a SubTree without its form, and a form that
  // contains itself.
  TreeForms(const Reading& reading, std::vector<TreeDraft> trees);

  // The trees named by (Trees …), or else the one that no SubTree refers to.
  std::vector<TreeNumber> roots(const std::vector<FormId>& trees_forms) const;

  // The forms that run neither as a root nor as a subtree of one.
  std::vector<TreeNumber> unused(const std::vector<TreeNumber>& roots) const;

  // All nodes, subtrees in place, and for each the draft it was made from.
  struct Expansion {
    BehaviorTree tree;
    std::vector<const NodeDraft*> drafts;
  };
  // At most 65,535 nodes; more are an error.
  Expansion expand(const std::vector<TreeNumber>& roots) const;

 private:
  void name_trees();
  void resolve_references();
  void cut_cycles();
  const Node& root_of(TreeNumber tree) const { return trees_[tree][0].node; }
  // The form of a name that stands at `span`; nothing after an error.
  std::optional<TreeNumber> named(SourceSpan span, std::string_view name) const;
  std::vector<TreeNumber> named_roots(FormId form) const;
  std::vector<TreeNumber> unreferenced() const;

  const Reading& reading_;
  std::vector<TreeDraft> trees_;
  std::map<std::string, TreeNumber, std::less<>> by_name_;
};

// Which node a name means, seen from another node.
class NodeNames {
 public:
  explicit NodeNames(const BehaviorTree& tree);

  // The node that `word`, a name or a unique one such as `land_btn12`, means in
  // an expression of the node `from`. None, or more than one, is an error at
  // `place`.
  std::optional<NodeId> find(const Reading& reading, const Form& place,
                             std::string_view word, NodeId from) const;

 private:
  std::vector<NodeId> candidates(const std::vector<NodeId>& all,
                                 std::string_view word, NodeId from) const;
  void report_unknown(const Reading& reading, const Form& place,
                      std::string_view word) const;

  const BehaviorTree& tree_;
  std::map<std::string, std::vector<NodeId>, std::less<>> by_name_;
  std::vector<NodeId> scope_;  // the SubTree or root a node stands in
  std::vector<NodeId> end_;    // the node after the last below it
};

}  // namespace btcheck::btf
