// SPDX-License-Identifier: MIT
//
// What a reviewer would say of a tree: the kinds of findings put together.
#pragma once

#include <vector>

#include "check/findings/normal_tree.hpp"
#include "check/findings/suspicion.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// What is to be watched for while the tree is searched.
std::vector<Suspicion> suspicions_of(const NormalTree& normal);

// The most serious first, then in the order of the tree; what another finding
// tells already is left out.
void rank(std::vector<TreeFinding>& findings, const BehaviorTree& tree);

// Of many of one kind the first few are left; the last of these speaks for the
// rest.
void fold_many(std::vector<TreeFinding>& findings);

// The mission is an endless loop: that it never ends is meant.
bool is_meant_to_run_on(const BehaviorTree& tree);

}  // namespace btcheck
