// SPDX-License-Identifier: MIT
//
// A step as a search has seen it.
#pragma once

#include "explore/transition_system.hpp"

namespace btcheck {

// All that is needed to tell a run that ends with it: the way on which the
// search came to `from`, and this step. (The way to `to` may be another.)
struct FoundStep {
  StateId from{};
  Step step;
  StateId to{};
};

}  // namespace btcheck
