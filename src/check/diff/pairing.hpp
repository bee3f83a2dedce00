// SPDX-License-Identifier: MIT
//
// Which node of one tree is which of another.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck {

// A node of the one tree and the same of the other; at least one of them.
struct NodePair {
  std::optional<NodeId> one;
  std::optional<NodeId> other;
};

// Pairs up nodes of two trees, each in pre-order, those of the one first: by
// name, where several are called so by the names from the root down to them,
// and the rest of that name in their order. What has no partner is told alone,
// behind.
std::vector<NodePair> paired(const BehaviorTree& one,
                             std::span<const NodeId> of_one,
                             const BehaviorTree& other,
                             std::span<const NodeId> of_other);

// Leaves that the world answers for, or hears of: neither AlwaysSuccess nor
// scripts, expressions and timers, which the engine knows all about.
std::vector<NodeId> leaves_of_world(const BehaviorTree& tree);
std::vector<NodeId> all_nodes(const BehaviorTree& tree);

// What a leaf is told otherwise in the other tree: "type Move instead of Go",
// "`goal` 2 instead of 1"; "" where it is the same. Ports that name blackboard
// entries are the same where the entries are.
std::string told_otherwise(const BehaviorTree& one, NodeId of_one,
                           const BehaviorTree& other, NodeId of_other);

}  // namespace btcheck
