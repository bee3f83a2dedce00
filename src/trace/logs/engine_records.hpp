// SPDX-License-Identifier: MIT
//
// What the nodes of BehaviorTree.CPP leave in a log beside their answers: where
// their types set RUNNING, in the steps of their automata.
#pragma once

#include <string_view>

#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Of a type in this release.
SetsRunning sets_running_in(NodeType type, Profile profile);

// Only where it is idle.
bool is_from_idle(SetsRunning when);

// Whether such a node calls setStatus(RUNNING) in a step of its automaton
// between locations of these names: tick() begins where preconditions have let
// it through (TreeNode::executeTick). `is_call`: it turns to a child.
bool sets_running(SetsRunning when, std::string_view from, std::string_view to,
                  bool is_call);

}  // namespace btcheck
