// SPDX-License-Identifier: MIT
//
// The state space of a network: measured, or as a graph for other programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "explore/large/scratch.hpp"
#include "explore/reduce/observed.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"
#include "text/diagnostic.hpp"

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

enum class GraphFormat : std::uint8_t {
  Aldebaran,  // `des (0, transitions, states)` and a line for each (CADP)
  Dot         // Graphviz
};

// Every reachable state, numbered as a breadth-first search finds it, from 0,
// and every step with its edge as the label (`land_btn12.tick_node -> success`)
// or `time`, and what it assigns. A step of a reduced graph has the labels of
// the steps that it stands for. Idle steps are left out: a state from which
// nothing leads is dead. An error, which names `file`, when there are more than
// 100,000 states, or 2,000 to be drawn, or a limit stops the search.
Result<std::string> space_graph(const Network& network, GraphFormat format,
                                const Limits& limits, std::string_view file,
                                Reduction reduce = Reduction::None);

}  // namespace btcheck
