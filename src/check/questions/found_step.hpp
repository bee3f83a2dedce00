// SPDX-License-Identifier: MIT
//
// A step as a search has seen it.
#pragma once

#include <cstdint>

#include "explore/state/transition_system.hpp"

namespace btcheck {

// All that is needed to tell a run that ends with an edge: the way on which the
// search came to `from`, and the single steps from there up to this edge.
struct FoundStep {
  StateId from{};
  std::uint32_t edge = 0;
};

}  // namespace btcheck
