// SPDX-License-Identifier: MIT
//
// Faults that have the same effect, together: nobody reads the same line
// fifteen times.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "check/whatif/whatif.hpp"

namespace btcheck {

// Each of these kinds of each of these leaves.
struct FaultGroup {
  std::vector<NodeId> leaves;
  std::vector<FaultKind> kinds;
  std::vector<std::size_t> places;  // in what was grouped
};

// One fault of a leaf, together with one of another: each of the first with
// each of the second.
struct PairGroup {
  FaultGroup first;
  FaultGroup second;
  std::vector<std::size_t> places;
};

using FaultSets = std::vector<std::vector<InjectedFault>>;

// Of sets of one fault; `said` of each is what has to be the same. Others are
// left out. In the order in which each group begins.
std::vector<FaultGroup> grouped_singles(const FaultSets& sets,
                                        const std::vector<std::string>& said);
// Of sets of two faults.
std::vector<PairGroup> grouped_pairs(const FaultSets& sets,
                                     const std::vector<std::string>& said);

// "1-3, 7": places counted from 1, behind as many as `before`.
std::string ranges_text(std::vector<std::size_t> places, std::size_t before);

}  // namespace btcheck
