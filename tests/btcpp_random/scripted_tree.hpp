// SPDX-License-Identifier: MIT
//
// Random trees of BehaviorTree.CPP with all that decides what they do, so that
// btcheck and the engine itself can run them and be compared.
#pragma once

#include <cstdint>
#include <string>

#include "model/tree/tree.hpp"
#include "reference/random_xml_nodes.hpp"

namespace btcheck::reference {

// docs/engine_comparison.md tells of the four texts.
struct ScriptedTree {
  std::string xml;
  std::string script;   // what the leaves answer
  std::string leaves;   // contracts: whether an answer stands, what it writes
  std::string entries;  // which blackboard entries the variables are
};

// A tree of any profile but Paper whose first `ticks` ticks follow from the
// script alone; equal for equal arguments, on every machine. The world is
// Scripted, or Clocked: then the time of some nodes is up while it runs, with
// 100 ms a tick.
ScriptedTree random_scripted_tree(std::uint64_t seed, Profile profile,
                                  World world, int ticks);

}  // namespace btcheck::reference
