// SPDX-License-Identifier: MIT
//
// Which search answers which property, and one search for many.
#pragma once

#include <vector>

#include "check/bound_property.hpp"
#include "check/verdict.hpp"
#include "explore/limits.hpp"
#include "explore/reachability.hpp"
#include "explore/step.hpp"

namespace btcheck {

struct Verification {
  std::vector<PropertyVerdict> verdicts;  // one for each property, in order
  // Some run ends in a fault: what would have followed is not judged by any
  // verdict. False as well when the limits end the search before one is found.
  bool has_faults = false;
};

// All properties that ask of single states share one breadth-first search, all
// of branching time share one graph; each of the others has a search of its
// own. Every run told has been replayed.
Verification verify(const CompiledNetwork& system, const BoundFile& file,
                    SearchOrder order, const Limits& limits);

}  // namespace btcheck
