// SPDX-License-Identifier: MIT
//
// Properties of branching time, all answered on one stored graph.
#pragma once

#include <vector>

#include "check/bound_property.hpp"
#include "check/verdict.hpp"
#include "explore/limits.hpp"
#include "explore/reduction.hpp"
#include "explore/step.hpp"

namespace btcheck {

// Sets the verdicts of the Branching properties of a file. Their runs are the
// fair ones. A run is told where one path can show something.
void verify_branching(const CompiledNetwork& system, const BoundFile& file,
                      Reduction reduction, const Limits& limits,
                      std::vector<PropertyVerdict>& verdicts);

}  // namespace btcheck
