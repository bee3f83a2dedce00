// SPDX-License-Identifier: MIT
//
// The state space of a network, measured.
#pragma once

#include <cstddef>
#include <cstdint>

#include "explore/large/scratch.hpp"
#include "explore/reduce/observed.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// How the visited states are held (explore/halves/pair_set.hpp).
enum class StateSetKind : std::uint8_t { Exact, Compressed };

struct SpaceOptions {
  SearchOrder search = SearchOrder::BreadthFirst;
  Reduction reduce = Reduction::None;
  StateSetKind store = StateSetKind::Compressed;
  unsigned threads = 1;  // of a breadth-first search
  Scratch scratch = {};  // where it goes on when memory is used up
};

struct SpaceReport {
  ReachabilityResult result;
  std::uint64_t markings = 0;          // states that differ in more than clocks
  std::uint64_t dead_states = 0;       // no step but an idle one
  std::uint32_t vector_bits = 0;       // of a packed state
  std::uint64_t largest_frontier = 0;  // states of one depth; 0: depth first
  std::uint64_t bytes = 0;  // held by the search at its peak, markings aside
  std::uint64_t bytes_on_disk = 0;  // at its peak; 0: all was in memory
};

// At the memory limit a breadth-first search starts over on disk, if there is
// a folder for it.
SpaceReport measure_space(const Network& network, const SpaceOptions& options,
                          const Limits& limits);

}  // namespace btcheck
