// SPDX-License-Identifier: MIT
//
// Several faults at once, and which sets of them make something possible.
#pragma once

#include <functional>
#include <vector>

#include "check/whatif/whatif.hpp"

namespace btcheck {

// Searches the pairs of faults that may do what neither does alone, by the rows
// of single ones. A pair is left out where no run has both: behind neither
// fault the leaf of the other is asked; and where each event is possible with
// one of them already.
using RowsOf = std::function<std::vector<FaultRow>(
    const std::vector<std::vector<InjectedFault>>&)>;
void add_pairs(WhatIf& result, const RowsOf& rows_of);

// The events that are not possible without any fault, each with its sets, by
// the rows and pairs that have been searched.
void add_cut_sets(WhatIf& result);

}  // namespace btcheck
