// SPDX-License-Identifier: MIT
//
// The leaves of a tree as functions in C: what H-Fiacre adds to Fiacre, so that
// Hippo can run the model (the paper, sections 2.3 and 3.2, appendix 1).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// An Action is a task: it is started, and the process waits for its answer. A
// Condition and a SetSV are functions that are called and answer at once.
enum class FiacreLinkKind : std::uint8_t { Action, Condition, SetSV };

// How the process of a leaf is linked.
struct FiacreLink {
  FiacreLinkKind kind{};
  std::string function;  // as Fiacre knows it; of an action the task
  std::string halt;      // the function that halts an action
  LocationId asks{};     // where the leaf's answer decides
  int node = 0;          // the number of the process
  // Over the network: what the function is given behind that number.
  std::vector<Expression> arguments;
};

// The links of a network, by automaton, and what they are declared as.
struct FiacreLinks {
  std::vector<std::optional<FiacreLink>> of;
  // The declarations, with a comment that tells each node's arguments.
  std::string declarations;
};

// Leaves of one :ID share a function. A condition that the model decides by
// itself (`:succeeds-when`, or only one answer) has none, as in `btcheck run`.
FiacreLinks fiacre_links(const BehaviorTree& tree, const Network& network);

}  // namespace btcheck
