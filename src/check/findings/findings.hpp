// SPDX-License-Identifier: MIT
//
// What a reviewer would say of a tree: the kinds of findings put together.
#pragma once

#include <vector>

#include "check/findings/suspicion.hpp"
#include "check/questions/defaults.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// What is to be watched for while the tree is searched.
std::vector<Suspicion> suspicions_of(const BehaviorTree& tree);

// What follows from the answers of a search: nodes that can never be ticked or
// never answer so, told once for each cause; guards that go stale.
std::vector<TreeFinding> findings_in(const BehaviorTree& tree,
                                     const Network& network,
                                     const DefaultReport& report);

// The most serious first, then in the order of the tree; what another finding
// tells already is left out.
void rank(std::vector<TreeFinding>& findings);

// The mission is an endless loop: that it never ends is meant.
bool is_meant_to_run_on(const BehaviorTree& tree);

}  // namespace btcheck
