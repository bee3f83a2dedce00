// SPDX-License-Identifier: MIT
//
// What the written-out space of a network answers without a property file.
#pragma once

#include <string>

#include "check/questions/defaults.hpp"
#include "reference/naive_network.hpp"

namespace btcheck::reference {

// Whether the node can come to do so. That it does so at first is not enough.
bool naive_answer(const Network& network, const NaiveSpace& space, NodeId node,
                  NodeQuestion question);

// Whether the tree question is answered with `Holds`.
bool naive_answer(const BehaviorTree& tree, const Network& network,
                  const NaiveSpace& space, TreeQuestion question);

// The first answer of a report that is another one, "" for none.
std::string flaw_of(const DefaultReport& report, const BehaviorTree& tree,
                    const Network& network, const NaiveSpace& space);

// "" or an automaton that is under way though nobody has called it.
std::string broken_gate(const Network& network, const NaiveSpace& space);

}  // namespace btcheck::reference
