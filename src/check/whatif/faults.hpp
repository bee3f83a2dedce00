// SPDX-License-Identifier: MIT
//
// Which faults a tree's leaves may have, and the tree with some of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/tree/leaf_fault.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// What the leaves do that have no fault.
enum class Others : std::uint8_t {
  Work,       // an action does what it is for, before a Timeout above it is
              // over; a condition says yes or no
  AsContract  // whatever their contracts allow
};

struct InjectedFault {
  NodeId leaf{};
  LeafFault fault;

  friend bool operator==(const InjectedFault&, const InjectedFault&) = default;
};

struct FaultChoices {
  Others others = Others::Work;
  std::vector<FaultKind> kinds = {};  // empty: all
  // Ticks by which a leaf ends too late: beyond its contract, if that says how
  // long it takes.
  int late = 10;
  // Of leaves that are these nodes, or below them; empty: of all.
  std::vector<NodeId> below = {};
};

// Kinds of faults that a leaf cannot have, or that change nothing.
struct OmittedFaults {
  std::vector<NodeId> leaves;
  std::vector<FaultKind> kinds;
  std::string why;
};

struct PossibleFaults {
  std::vector<InjectedFault> faults;  // by leaf in pre-order, by kind
  std::vector<OmittedFaults> left_out;
  std::vector<NodeId> guessed;  // leaves that are taken for conditions
};
PossibleFaults possible_faults(const BehaviorTree& tree,
                               const FaultChoices& choices);

// A leaf that does something, and should succeed at it.
bool is_deed(const Node& node);
// A condition whose answer its contract leaves to the world; or a leaf that
// finds out what the world is like and does nothing else.
bool answers_freely(const Node& node);
bool is_of_world(const Node& node);

// The tree with these faults, at most one of a leaf.
BehaviorTree with_faults(const BehaviorTree& tree,
                         std::span<const InjectedFault> faults, Others others);

}  // namespace btcheck
