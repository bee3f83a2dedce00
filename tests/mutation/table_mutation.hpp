// SPDX-License-Identifier: MIT
//
// Wrong tables, made from right ones: every small mistake one can make when a
// node type's automaton is drawn.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck::mutation {

// The kinds of mistake (mutation operators), in the order of the table of
// docs/mutations.md.
enum class Operator : std::uint8_t {
  OtherTarget,   // an edge leads to another location of the table
  SwapTargets,   // two edges from one location have each other's target
  DropEdge,      // an edge is missing
  NegateGuard,   // a guard is taken the wrong way round
  DropGuard,     // a guard is missing
  DropConjunct,  // a part of a guard is missing
  GuardValue,    // a guard compares with a neighbouring value
  GuardChild,    // a guard asks another child
  DropUpdate,    // an assignment is missing: a reset, a call, a halt
  UpdateValue,   // another value is assigned
  UpdateChild,   // another child is called or halted
  Interval       // one unit more or less, or no urgency
};
inline constexpr std::size_t kOperatorCount = 12;
std::string_view operator_name(Operator which);

// One mistake in one automaton: the edges that are replaced, by their place in
// Automaton::edges. The text calls the node `self`, its parent `parent` and its
// children `child 1`, …, so that the same mistake has the same text in every
// tree.
struct Mutation {
  Operator which{};
  std::string text;
  std::vector<std::pair<std::size_t, Edge>> edges;
};

// Every single mistake of every kind, in the order of the edges.
std::vector<Mutation> mutations_of(const BehaviorTree& tree,
                                   const Network& network,
                                   AutomatonId automaton);

}  // namespace btcheck::mutation
