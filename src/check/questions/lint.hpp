// SPDX-License-Identifier: MIT
//
// What is wrong with a tree as it stands, without a search. Only what is
// certain: each finding is true of every run.
#pragma once

#include <vector>

#include "ltl/rules/property.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Warnings, in the order of the file:
//   BT2301  an assignment that no `:transitions` lead to
//   BT2302  a node that the tick can never get to, by what is before it
//   BT2303  a variable that nothing reads or writes, nor a rule names
//   BT2304  `:transitions` of a variable that only `:=` writes
//   BT2305  several children of a reactive node of an XML tree that can run
// `source` is the text of the tree's file.
std::vector<Diagnostic> lint(const BehaviorTree& tree, const SourceText& source,
                             const std::vector<const PropertyFile*>& rules);

}  // namespace btcheck
