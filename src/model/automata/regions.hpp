// SPDX-License-Identifier: MIT
//
// Regions of numbers: values between which nothing that a network asks or
// computes makes a difference. They are the classes of the coarsest partition
// that every condition respects and every assignment keeps (Paige and Tarjan,
// SIAM J. Comput. 16(6), 1987), so what holds of one value of a region, in any
// logic, holds of all of them: a SetSV that gives one value of each loses
// nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck {

// By StateVariableId, ascending: the values that SetSV gives. Empty, or not
// there: all of the range.
using SampledValues = std::vector<std::vector<int>>;

// Why all values of a number are told apart.
struct UnsplitNumber {
  StateVariableId variable{};
  // It is compared or computed with this one; nothing: its assignments tell too
  // many values apart.
  std::optional<VariableId> beside;
};

struct Regions {
  SampledValues samples;
  std::vector<UnsplitNumber> unsplit;
};

// One value for each region of these numbers: the initial one, else one that is
// assigned, else the nearest to the initial one. The network's own SetSV must
// give constants only; `asked` are conditions over its variables that must not
// tell the values of a region apart either.
Regions regions_of(const Network& network,
                   std::span<const StateVariableId> numbers,
                   std::span<const Expression> asked);

}  // namespace btcheck
