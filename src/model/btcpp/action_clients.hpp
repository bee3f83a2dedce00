// SPDX-License-Identifier: MIT
//
// Leaves that send a goal to another process, and succeed when it is reached.
#pragma once

#include <string_view>

#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// Whether a node of this type is the client of an action server: Nav2's
// BtActionNode, behaviortree_ros2's RosActionNode and MoveIt Pro's nodes with
// the name of an action among their ports.
//
// A RosActionNode returns RUNNING when it has sent its goal. A BtActionNode
// (nav2_behavior_tree/bt_action_node.hpp) spins once behind that, so it can
// succeed within its first tick where the result is there by then; that a goal
// is reached in no time, over and over, is no run of a robot.
bool is_action_client(Profile profile, std::string_view id);

}  // namespace btcheck::btcpp
