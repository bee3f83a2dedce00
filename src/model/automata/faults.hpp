// SPDX-License-Identifier: MIT
//
// Where a fault of a leaf strikes (model/tree/leaf_fault.hpp): what all
// families of leaves have in common.
#pragma once

#include <optional>
#include <vector>

#include "model/automata/builder.hpp"
#include "model/tree/leaf_fault.hpp"

namespace btcheck::mapping {

// Where a leaf goes on that has been asked: as if nothing were wrong with it,
// and with its fault.
struct Asked {
  std::optional<LocationId> well;    // of one that is not always at fault
  std::optional<LocationId> struck;  // of one that has a fault
};

// Draws the choice of a leaf that is asked in a location, if it has a fault:
// that strikes under the guard alone.
Asked draw_strike(NodeBuilder& draw, LocationId asked, Expression guard = {});

// Of a leaf that writes another value: chooses that for each variable which the
// effects assign, and goes on.
void draw_other_values(NodeBuilder& draw, LocationId from, LocationId then,
                       const std::vector<Assignment>& effects);

// Whether its fault is what it writes: that strikes where it succeeds.
inline bool spoils_writes(const Node& node) {
  return node.fault && (node.fault->kind == FaultKind::WritesNothing ||
                        node.fault->kind == FaultKind::WritesOther);
}

}  // namespace btcheck::mapping
