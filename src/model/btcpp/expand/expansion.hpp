// SPDX-License-Identifier: MIT
//
// One tree of nodes out of a document: every SubTree with its own copy of the
// tree it names, under the numbers and paths that BehaviorTree.CPP gives.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"

namespace btcheck {

// How a name inside a subtree reaches the blackboard around it.
struct BtcppRemapping {
  std::string inner;
  std::string outer;        // a key, or the literal's text
  bool is_literal = false;  // the entry is the subtree's own, with this value
};

// One use of a tree. The first is the tree that runs.
struct BtcppSubtree {
  const BtcppTree* tree = nullptr;
  std::string path;              // "" for the first, then "a/Move::4"
  std::uint32_t parent = 0;      // the subtree it stands in
  std::uint32_t first_node = 0;  // its root, an index into the nodes
  std::vector<BtcppRemapping> remappings;
  bool is_autoremapped = false;
  bool is_shared = false;  // version 3: one blackboard with its parent
};

struct BtcppInstance {
  const BtcppNode* node = nullptr;
  std::uint32_t subtree = 0;
  std::uint32_t parent = 0;             // of the first: itself
  std::vector<std::uint32_t> children;  // of a SubTree: the root inside
  std::string path;  // "Move::4/patrol", "Sequence::1": the fullPath
};

// The document must outlive it.
struct BtcppExpansion {
  const BtcppDocument* document = nullptr;
  std::vector<BtcppSubtree> subtrees;
  // In pre-order; the uid is the index and 1. A SubTree counts, and the root
  // inside it comes next.
  std::vector<BtcppInstance> nodes;
};

// Expands the tree of this ID, "" for the document's own choice, and checks
// what BehaviorTree.CPP checks when it loads and ticks it, and what it never
// does: BT1606 and BT1609 to BT1629.
Result<BtcppExpansion> expand_btcpp(const BtcppDocument& document,
                                    std::string_view main_tree = {});

}  // namespace btcheck
