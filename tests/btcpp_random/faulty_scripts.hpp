// SPDX-License-Identifier: MIT
//
// A random tree whose leaves all work, but for one that has a fault.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

// Nothing where the tree has no action, or where something other than the
// script would decide what it does. `throws` is a word that the engine's leaves
// know, and no script of btcheck. A leaf that is late has a contract that says
// how long it takes.
std::optional<FaultyScript> random_faulty_script(std::uint64_t seed,
                                                 Profile profile, int ticks);

}  // namespace btcheck::reference
