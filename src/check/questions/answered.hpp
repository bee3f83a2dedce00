// SPDX-License-Identifier: MIT
//
// Findings that follow from the answers of a search.
#pragma once

#include <vector>

#include "check/findings/normal_tree.hpp"
#include "check/findings/suspicion.hpp"
#include "check/questions/defaults.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Nodes that can never be ticked or never answer so, told once for each cause;
// guards that go stale, by guard; what is left running.
std::vector<TreeFinding> findings_in(const NormalTree& normal,
                                     const DefaultReport& report);

}  // namespace btcheck
