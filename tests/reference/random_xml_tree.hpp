// SPDX-License-Identifier: MIT
//
// Small random trees in the XML of BehaviorTree.CPP.
#pragma once

#include <cstdint>
#include <string>

#include "model/tree/tree.hpp"

namespace btcheck::reference {

// The text of a tree with the nodes that the profile has; equal for equal
// arguments, on every machine. Leaves are called a1, a2, … (actions) and c1, …
// (conditions), and conditions on nodes speak of entries that nothing writes.
std::string random_xml_tree(std::uint64_t seed, Profile profile);

}  // namespace btcheck::reference
