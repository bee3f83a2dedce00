// SPDX-License-Identifier: MIT
//
// Monitors as C++, for the program that runs the tree.
#pragma once

#include <string>

#include "ltl/rules/property.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// One header in C++17 without dependencies. It is told of changes of status, as
// loggers of BehaviorTree.CPP are, and says of each rule what `btcheck trace
// LOG --prop RULES` would say of the log up to there. The rules are refused as
// for a log, and so is, when it runs, another tree. `nodes` are the tree's, as
// recorded_tree has them.
Result<std::string> cpp_monitor(const BehaviorTree& tree,
                                const RecordedRun& nodes,
                                const PropertyFile& rules,
                                const SourceText& source);

}  // namespace btcheck
