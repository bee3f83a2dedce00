// SPDX-License-Identifier: MIT
//
// (BehaviorTree …): the nodes of one form, before subtrees are expanded.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/btf/keywords.hpp"
#include "model/btf/variables.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

// A node with everything that does not depend on other nodes.
struct NodeDraft {
  Node node;  // `children`, `parent` and what is made of expressions are unset
  FormId form{};
  std::vector<std::uint32_t> children;  // indices into TreeDraft::nodes
  std::optional<FormId> expression;     // of an Eval
  SourceSpan reference;                 // of the name a SubTree refers to
  std::uint32_t words = 0;              // its own, without its children's
};

// One BehaviorTree form; nodes[0] is its root, the others follow in pre-order.
struct TreeDraft {
  std::vector<NodeDraft> nodes;

  const Node& root() const { return nodes.front().node; }
};

// The node type with that name, in any case.
std::optional<NodeType> find_node_type(std::string_view word);
// What to say to an unknown node type, or "".
std::string node_type_advice(std::string_view word);

TreeDraft read_tree(const Reading& reading, const Variables& variables,
                    FormId form);

}  // namespace btcheck::btf
