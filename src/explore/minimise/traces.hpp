// SPDX-License-Identifier: MIT
//
// What is seen of the runs from one state that is not seen from another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "explore/minimise/labelled_graph.hpp"

namespace btcheck {

// How a run ends that only one of two states has.
enum class TraceEnd : std::uint8_t {
  Seen,    // with its last label, which the other cannot have then
  Stops,   // there is no further step
  Unseen,  // it goes on for ever and nothing is seen of it
};

struct TraceDifference {
  // What is seen; both states have all of it, but for the last with Seen.
  std::vector<std::uint32_t> labels;
  TraceEnd end = TraceEnd::Seen;
  bool is_of_first = true;
  // What is seen next from the other, ascending.
  std::vector<std::uint32_t> instead;
  bool other_stops = false;   // it may stop there
  bool other_unseen = false;  // or go on unseen for ever
};

// A shortest one; nothing where both have the same runs. Nor where more than
// `most` pairs of sets of states had to be looked at: then `is_known` is false.
struct TraceComparison {
  std::optional<TraceDifference> difference;
  bool is_known = true;
};
// The graph must be a quotient (partition.hpp, Branching): its silent cycles
// are single steps.
TraceComparison compare_traces(const LabelledGraph& graph, std::uint32_t first,
                               std::uint32_t second,
                               std::size_t most = 1'000'000);

}  // namespace btcheck
