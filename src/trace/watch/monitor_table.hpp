// SPDX-License-Identifier: MIT
//
// Rules as data, for the program that runs the tree.
#pragma once

#include <string>

#include "ltl/rules/property.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// The rules of a file as a table that btcheck/monitor.hpp reads: with the tree,
// which must be the one that runs, and what is asked of its nodes and of the
// entries of its blackboards. The rules are refused as for a log. `nodes` are
// the tree's, as recorded_tree has them.
Result<std::string> monitor_table(const BehaviorTree& tree, RecordedRun nodes,
                                  const PropertyFile& rules,
                                  const SourceText& source);

}  // namespace btcheck
