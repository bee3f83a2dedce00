// SPDX-License-Identifier: MIT
//
// The state space of a network, built and measured.
#pragma once

#include <cstddef>
#include <cstdint>

#include "explore/limits.hpp"
#include "explore/reachability.hpp"
#include "model/network.hpp"

namespace btcheck {

struct SpaceReport {
  ReachabilityResult result;
  std::uint64_t markings = 0;     // states that differ in more than clocks
  std::uint64_t dead_states = 0;  // no step but an idle one
  std::uint32_t vector_bits = 0;  // of a packed state
  std::uint64_t bytes = 0;        // held by the search, markings aside
};

SpaceReport measure_space(const Network& network, SearchOrder order,
                          const Limits& limits);

}  // namespace btcheck
