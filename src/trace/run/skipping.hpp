// SPDX-License-Identifier: MIT
//
// Why a node of an XML tree answers SKIPPED.
#pragma once

#include <string>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// True for the step with which it is decided that the node answers so.
bool begins_to_skip(const Network& network, const RunStep& step);

// What decided it: "`docked` is true", "all its children were skipped"; "" for
// a leaf that may answer so by its contract. `before` is the state in which
// such a step is taken.
std::string reason_to_skip(const BehaviorTree& tree, const Network& network,
                           const Valuation& before, const RunStep& step);

}  // namespace btcheck
