// SPDX-License-Identifier: MIT
//
// The arcs of a graph as refinement goes along them, in both directions.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "explore/minimise/partition.hpp"

namespace btcheck {

// No state, arc, block or whatever else has a number.
inline constexpr std::uint32_t kNoNumber = 0xffffffff;

// 32-bit numbers throughout: 20 bytes for an arc and 8 for a state.
struct Arcs {
  std::uint32_t states = 0;
  std::vector<std::uint32_t> first_out;  // by state and one behind: its arcs
  std::vector<std::uint32_t> first_in;   // by state and one behind: `incoming`
  std::vector<std::uint32_t> incoming;   // arcs by target, silent ones first
  std::vector<std::uint32_t> source;     // by arc
  std::vector<std::uint32_t> target;     // by arc
  std::vector<std::uint32_t> label;      // by arc, below `labels`
  std::vector<bool> is_silent;           // by arc; nowhere on a cycle
  std::uint32_t labels = 0;

  std::uint32_t size() const {
    return static_cast<std::uint32_t>(target.size());
  }
};

// By state: on which silent cycle it is, or the number of a component of its
// own. A component that another leads to silently has the smaller number.
std::vector<std::uint32_t> silent_components(const LabelledGraph& graph);

// With Strong, a silent step is one as any other. With Branching, `component`
// is that of silent_components(), the states are the components, and a silent
// cycle is a step to itself with a label of its own: divergence.
Arcs arcs_of(const LabelledGraph& graph, Equivalence equivalence,
             const std::vector<std::uint32_t>& component);

// Exchanges two neighbouring ranges of places, [begin, middle) and
// [middle, end), when the order within them does not matter. Time: that of the
// shorter one.
template <class Swap>
void exchange(std::uint32_t begin, std::uint32_t middle, std::uint32_t end,
              Swap swap) {
  const std::uint32_t moved =
      middle - begin < end - middle ? middle - begin : end - middle;
  for (std::uint32_t i = 0; i < moved; ++i) swap(begin + i, end - moved + i);
}

}  // namespace btcheck
