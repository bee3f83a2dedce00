// SPDX-License-Identifier: MIT
//
// behaviortree_ros2: the library itself has base classes only, whose nodes have
// the port `action_name`, `service_name` or `topic_name`; ready-made nodes are
// those of its package btcpp_ros2_samples, 0.2.0. ReceiveString is left out, a
// condition of a program for tests: others may well have an action of that
// name.
#include "model/btcpp/libraries/libraries.hpp"

namespace btcheck::btcpp {
namespace {

constexpr LibraryType kRos2Types[] = {
    // BehaviorTree.ROS2, btcpp_ros2_samples/src/sleep_action.hpp (a plugin)
    {"SleepAction", "Action", "action_name msec"},
    // btcpp_ros2_samples/src/sleep_client.cpp
    {"PrintValue", "Action", "message"},
    // btcpp_ros2_samples/src/set_bool_node.hpp, registered in bool_client.cpp
    {"SetBool", "Action", "service_name value"},
    {"SetBoolA", "Action", "service_name value"},
    {"SetRobotBool", "Action", "robot value"},
};

}  // namespace

std::span<const LibraryType> behaviortree_ros2_types() { return kRos2Types; }

}  // namespace btcheck::btcpp
