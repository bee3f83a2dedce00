// SPDX-License-Identifier: MIT
//
// Properties of branching time, all answered on one stored graph.
#pragma once

#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "explore/reduce/reduction.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// Sets the verdicts of the Branching properties of a file. Their runs are the
// fair ones. A run is told where one path can show something.
void verify_branching(const CompiledNetwork& system, const BoundFile& file,
                      Reduction reduction, const Limits& limits,
                      std::vector<PropertyVerdict>& verdicts);

}  // namespace btcheck
