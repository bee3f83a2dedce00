// SPDX-License-Identifier: MIT
//
// A log of BehaviorTree.CPP as text for a terminal.
#pragma once

#include <string>

#include "trace/logs/behavior_log.hpp"

namespace btcheck {

// The tree with its uids, then every change of a status in the style of
// BehaviorTree.CPP's StdCoutLogger, under a heading for each tick:
//
//     after 0.030183 s
//       [0.030183]    2 a                  RUNNING -> SUCCESS
//
// What has no ticks is parted where nothing changed for 5 ms; a log that
// btcheck wrote has them, and its headings say `tick 1`.
std::string log_text(const BehaviorLog& log);

}  // namespace btcheck
