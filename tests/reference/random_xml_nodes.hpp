// SPDX-License-Identifier: MIT
//
// The nodes with children that random XML trees are made of.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck::reference {

// Which profiles have a node.
enum class Where : std::uint8_t {
  Everywhere,
  Release3,
  Misspelt,       // 3.5: RetryUntilSuccesful
  OneThreshold,   // 3.5.1: a Parallel
  TwoThresholds,  // release 3 after that
  Release4,
  Nav2,
  Main
};

// What decides about a node beside its children's answers. Open: entries that
// the program sets, and a clock. Scripted: entries that the tree sets. Clocked:
// those, and a clock of which half a tick is left over, so that it makes no
// difference when exactly the program ticks. Any: no matter.
enum class World : std::uint8_t { Any, Open, Scripted, Clocked };

// A node's ID, how many children it takes, and its ports as they are written,
// with `#` for 1 or 2, `?` for a condition and `$` for the name of an entry.
struct InnerNode {
  std::string_view id;
  int least;
  int most;
  std::string_view ports;
  Where where = Where::Everywhere;
  World world = World::Any;
};

// Those of a profile that suit the world, always in the same order.
std::vector<InnerNode> inner_nodes(Profile profile, World world);

}  // namespace btcheck::reference
