// SPDX-License-Identifier: MIT
//
// A run by which somebody outside can tell two states apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "explore/minimise/labelled_graph.hpp"

namespace btcheck {

// How a run ends that one of two states has and the other has not.
enum class DifferenceEnd : std::uint8_t {
  Step,    // with the last of its labels
  Stop,    // in a state from which nothing leads
  Silence  // by going on silently for ever
};

struct RunDifference {
  bool is_of_first = true;            // which of the two states has the run
  std::vector<std::uint32_t> labels;  // of the steps that are seen, in order
  DifferenceEnd end = DifferenceEnd::Step;

  friend bool operator==(const RunDifference&, const RunDifference&) = default;
};

struct ComparedRuns {
  std::optional<RunDifference> difference;
  bool is_complete = true;  // false: too many sets of states were looked at
};

// A difference with as few labels as any. Where all has been looked at and
// there is none, both states have the same runs; they need not be equivalent
// for that, since it may matter when a choice is made. Equivalent states have
// none, of either equivalence.
//
// The states that can be reached by equal labels are looked at together
// (subset construction), of which there may be exponentially many: no more than
// `most` such pairs of sets are.
ComparedRuns compare_runs(const LabelledGraph& graph, std::uint32_t first,
                          std::uint32_t second, std::size_t most = 100'000);

}  // namespace btcheck
