// SPDX-License-Identifier: MIT
//
// A run as changes of status, the way BehaviorTree.CPP's loggers see one.
#pragma once

#include <cstddef>
#include <vector>

#include "trace/logs/behavior_log.hpp"
#include "trace/logs/btcpp_tree.hpp"
#include "trace/run/run_walk.hpp"

namespace btcheck {

struct StatusChange {
  std::size_t node = 0;  // its place in LoggedTree::nodes
  LogStatus status = LogStatus::Idle;
  int tick = 0;
};

std::vector<StatusChange> status_changes(const RecordedRun& run,
                                         const LoggedTree& tree,
                                         const std::vector<Passing>& passings);

}  // namespace btcheck
