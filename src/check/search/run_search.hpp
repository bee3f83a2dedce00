// SPDX-License-Identifier: MIT
//
// Searches for one run of a network: against a formula, against a pattern.
#pragma once

#include <vector>

#include "check/bind/bound_property.hpp"
#include "explore/reduce/reduced_network.hpp"
#include "explore/state/limits.hpp"
#include "ltl/product/fair_system.hpp"
#include "ltl/timed/pattern_search.hpp"

namespace btcheck {

// A fair run that violates the formula and satisfies every condition; without
// conditions also a finite one that violates it however it goes on. With
// StopReason::FormulaTooLarge nothing was searched.
RunSearch find_run_against(const ReducedNetwork& system,
                           const BoundFormula& formula,
                           const std::vector<FairnessPair>& conditions,
                           const Limits& limits);

// Whether there is one: quicker, as no run is told.
SearchOutcome exists_run_against(const ReducedNetwork& system,
                                 const BoundFormula& formula,
                                 const std::vector<FairnessPair>& conditions,
                                 const Limits& limits);

// A run that violates the pattern, and the longest answer on all of them.
PatternRun find_run_against(const ReducedNetwork& system,
                            const BoundPattern& pattern, const Limits& limits);

// The same among the runs that satisfy the assumptions; the run is infinite.
RunSearch find_run_against(const ReducedNetwork& system,
                           const BoundPattern& pattern,
                           const UnderAssumptions& assumed,
                           const std::vector<FairnessPair>& conditions,
                           const Limits& limits);

}  // namespace btcheck
