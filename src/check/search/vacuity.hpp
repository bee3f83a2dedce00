// SPDX-License-Identifier: MIT
//
// Properties that hold, but not for the reason their author had in mind.
#pragma once

#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "explore/reduce/reduction.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// Names the conditions of each LTL property that holds which could be replaced
// by false where they stand positively, by true where negatively, without
// changing the verdict (Kupferman and Vardi, "Vacuity detection in temporal
// model checking", STTT 2003). At most kMostVacuityChecks for a property.
inline constexpr std::size_t kMostVacuityChecks = 8;
void judge_vacuity(const CompiledNetwork& system, const BoundFile& file,
                   Reduction reduction, const Limits& limits,
                   std::vector<PropertyVerdict>& verdicts);

// One breadth-first search over everything: counts the states with the trigger
// of each property that holds, as many as the reduction leaves. Returns whether
// some run ends in a fault; no search where nothing is to be counted and
// nothing can fail.
bool take_census(const CompiledNetwork& system, const BoundFile& file,
                 Reduction reduction, const Limits& limits,
                 std::vector<PropertyVerdict>& verdicts);

}  // namespace btcheck
