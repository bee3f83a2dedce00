// SPDX-License-Identifier: MIT
//
// What rules need a network to remember.
#pragma once

#include <span>

#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Keeps the arguments that the files ask for
// (model/automata/kept_arguments.hpp), and gives an `answer` to each node that
// `x.answer` and `tick.ends` name in them (model/automata/tick_memory.hpp);
// names that fit no node, or several, are left to bind_properties. To be called
// once, before a file is bound.
void remember_for(const BehaviorTree& tree,
                  std::span<const PropertyFile* const> files, Network& network);
inline void remember_for(const BehaviorTree& tree, const PropertyFile& file,
                         Network& network) {
  const PropertyFile* const only = &file;
  remember_for(tree, {&only, 1}, network);
}

}  // namespace btcheck
