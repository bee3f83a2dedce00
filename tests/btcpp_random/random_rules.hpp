// SPDX-License-Identifier: MIT
//
// Random rules about what the nodes and entries of an XML tree do on one run.
#pragma once

#include <cstdint>
#include <string>

#include "model/tree/tree.hpp"

namespace btcheck::reference {

// The text of a file with so many rules, r1, r2, …, all of which can be
// watched on a run; equal for equal arguments, on every machine. Nodes are
// named so that the tree, its log and the engine mean the same ones.
std::string random_rules(std::uint64_t seed, const BehaviorTree& tree,
                         int count);

}  // namespace btcheck::reference
