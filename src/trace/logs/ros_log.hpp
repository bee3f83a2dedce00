// SPDX-License-Identifier: MIT
//
// Nav2's /behavior_tree_log out of a recording of ROS 2, as a log.
#pragma once

#include <string_view>

#include "trace/logs/behavior_log.hpp"

namespace btcheck {

// True for a file of MCAP or SQLite, by name (.mcap, .db3) or first bytes.
bool is_ros_recording(std::string_view file, std::string_view bytes);

// The log of that topic; "" is the only one of its type. Its nodes are names in
// the order in which they were first told of, and have no place in a tree: ROS
// says none. Since Jazzy it says their uids. Throws a Diagnostic; what is cut
// off is a warning (BT1304).
Result<BehaviorLog> read_ros_log(std::string_view file, std::string_view bytes,
                                 std::string_view topic, const Limits& limits);

}  // namespace btcheck
