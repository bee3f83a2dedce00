// SPDX-License-Identifier: MIT
//
// Several BehaviorTree forms to the trees that run: roots and subtrees.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/btf/keywords.hpp"
#include "model/btf/nodes.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

// Index into the list of BehaviorTree forms.
using TreeNumber = std::size_t;

// The forms with, for each SubTree node, the form it refers to.
class TreeForms {
 public:
  // Errors: two forms of one name (BT1011), a SubTree without its form and
  // subtrees that contain themselves (BT1018).
  TreeForms(const Reading& reading, std::vector<TreeDraft> trees);

  // The trees named by (Trees …), or else the one that no SubTree refers to.
  // Errors: BT1019. Unused forms are warned about (BT1021).
  std::vector<TreeNumber> roots(const std::vector<FormId>& trees_forms) const;

  // The forms that run neither as a root nor as a subtree of one.
  std::vector<TreeNumber> unused(const std::vector<TreeNumber>& roots) const;

  // All nodes, subtrees in place, and for each the draft it was made from.
  struct Expansion {
    BehaviorTree tree;
    std::vector<const NodeDraft*> drafts;
  };
  // At most 20,000 nodes (BT1002).
  Expansion expand(const std::vector<TreeNumber>& roots) const;

 private:
  using Reference = std::optional<TreeNumber>;

  void name_trees();
  void resolve_references();
  void cut_cycles();
  Reference find(const Form& word) const;
  void report_unknown(SourceSpan span, std::string_view name) const;
  void report_too_large(SourceSpan span, std::size_t words) const;
  std::vector<TreeNumber> named_roots(FormId form) const;
  std::vector<TreeNumber> unreferenced() const;

  const Reading& reading_;
  std::vector<TreeDraft> trees_;
  std::map<std::string, TreeNumber, std::less<>> by_name_;
  std::vector<std::vector<Reference>> references_;  // per tree, per node
};

}  // namespace btcheck::btf
