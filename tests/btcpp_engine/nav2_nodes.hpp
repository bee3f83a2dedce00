// SPDX-License-Identifier: MIT
//
// Nav2's nodes that know nothing of ROS, compiled from a checkout of the
// user's (NAV2_BEHAVIOR_TREE, see CMakeLists.txt); none without one. Each of
// Nav2's files ends with the function that registers what it has; it is given
// a name of its own here.
#pragma once

#ifdef NAV2_NODES

#define NODE(name) void register_##name(BT::BehaviorTreeFactory& factory);
NAV2_NODES
#undef NODE

#endif

inline void register_nav2_nodes(
    [[maybe_unused]] BT::BehaviorTreeFactory& factory) {
#ifdef NAV2_NODES
#define NODE(name) register_##name(factory);
  NAV2_NODES
#undef NODE
#endif
}
