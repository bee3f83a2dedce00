// SPDX-License-Identifier: MIT
//
// What of a network cannot be exported because its numbers are too large.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

struct NamedPredicates {
  std::string name;
  std::vector<Expression> predicates;
};

// An error BT0005 for the first guard or assigned value of each automaton, and
// the first of each list of predicates, that `is_exact` is false of.
std::vector<Diagnostic> inexpressible(
    const BehaviorTree& tree, const Network& network,
    const std::vector<NamedPredicates>& named,
    const std::function<bool(const Expression&)>& is_exact,
    std::string_view language);

}  // namespace btcheck
