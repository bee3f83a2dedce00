// SPDX-License-Identifier: MIT
//
// A random tree whose leaves all work, but for one that has a fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "btcpp_random/scripted_tree.hpp"
#include "model/tree/leaf_fault.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::reference {

struct FaultyScript {
  ScriptedTree tree;  // its script has the fault
  std::string well;   // the script without it
  std::string leaf;
  FaultKind kind{};
};

// Of one tree so many at the most, each with a fault that strikes before the
// tree has ended and makes a difference; none where something other than the
// script would decide what it does. `throws` is a word that the engine's leaves
// know, and no script of btcheck. A leaf that is late has a contract that says
// how long it takes.
std::vector<FaultyScript> random_faulty_scripts(std::uint64_t seed,
                                                Profile profile, int ticks,
                                                std::size_t most);

}  // namespace btcheck::reference
