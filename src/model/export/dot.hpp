// SPDX-License-Identifier: MIT
//
// The network as a picture, in Graphviz's language.
#pragma once

#include <string>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// One digraph: the tree on top, with the process number of each node, and one
// cluster per automaton below it, drawn as the paper draws them: locations as
// circles, guards in brackets, assignments below, intervals where they are not
// [0,0]. Render with `dot -Tsvg`.
std::string dot_text(const BehaviorTree& tree, const Network& network);

}  // namespace btcheck
