// SPDX-License-Identifier: MIT
//
// For which numbers of attempts and rounds a verdict stands: not tried one by
// one, but by an argument for all of them (docs/reductions.md, "For every
// count").
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/search/engine.hpp"
#include "model/automata/network.hpp"
#include "model/sampling.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// What is known of a verdict where a node counts to another number.
struct CountClaim {
  NodeId node{};
  std::string attribute;  // as the tree's language has it: "num_attempts"
  // The verdict is the same for every number from this one on, the tree's own
  // among them.
  std::optional<int> from;
  std::string open;  // why nothing is known, where it is not
};
using CountClaims = std::vector<CountClaim>;

// A file of rules that has been checked.
struct CountedRules {
  const BehaviorTree& tree;
  const SourceText& tree_source;
  const PropertyFile& rules;
  const SourceText& source;
  const BoundFile& bound;
  const std::vector<PropertyVerdict>& verdicts;
  TickSemantics ticks;
  ExtraAssumption extra = ExtraAssumption::None;
  std::int64_t most_whole = kMostWhole;
};

// By verdict, of each node of the tree that counts rounds up to a number that
// is written in the tree: one at a time, all others as they are. Each search
// keeps to the limits; one that is stopped tells nothing.
std::vector<CountClaims> count_claims(const CountedRules& of,
                                      const SearchChoices& choices,
                                      const Limits& limits);

}  // namespace btcheck
