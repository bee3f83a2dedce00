// SPDX-License-Identifier: MIT
//
// Children of reactive nodes that interrupt each other without meaning to. A
// ReactiveSequence or ReactiveFallback begins its earlier children anew on each
// tick. One that lets the tick pass by a condition, as in "charge when the
// battery is low, else patrol", interrupts on purpose. One that lets it pass
// only once an action has run begins that action again and again, and halts
// what runs behind it.
#pragma once

#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck {

struct Interruption {
  NodeId node{};    // the reactive one
  NodeId first{};   // its child that begins anew
  NodeId second{};  // the next that may run, and is halted
  // Only if leaves run of which nothing is known but their names.
  bool is_guessed = false;
};

// One for each reactive node of an XML tree, at most.
std::vector<Interruption> interruptions(const BehaviorTree& tree);

}  // namespace btcheck
