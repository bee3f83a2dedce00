// SPDX-License-Identifier: MIT
//
// A network made for a file of rules: it remembers what they ask for, and its
// SetSV give as many values as they can tell apart.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "check/bind/bound_property.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/sampling.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

struct RulesNetwork {
  std::unique_ptr<Network> network;
  BoundFile bound;  // to it
};

// Errors are those of names in the rules, and of numbers of the tree that have
// too many values. `tree_source` is the text of the tree's file, `source` that
// of the rules; the tree and the rules must outlive the result. `change` is
// made to the network before anything is bound to it.
Result<RulesNetwork> network_for(
    const BehaviorTree& tree, const SourceText& tree_source,
    const PropertyFile& rules, const SourceText& source, TickSemantics ticks,
    ExtraAssumption extra = {}, std::int64_t most_whole = kMostWhole,
    const std::function<void(Network&)>& change = {});

}  // namespace btcheck
