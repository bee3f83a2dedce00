// SPDX-License-Identifier: MIT
//
// The runs of findings as scripts, for the engine to play.
#pragma once

#include <vector>

#include "btcpp_random/scripted_tree.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::reference {

// The tree once for each finding that has a run, with the answers that leaves
// give on it as the script. Left out are runs that a script cannot tell: the
// leaf of a subtree that is used twice answers otherwise in the other place.
std::vector<ScriptedTree> finding_scripts(const ScriptedTree& made,
                                          Profile profile);

}  // namespace btcheck::reference
