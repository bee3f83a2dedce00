// SPDX-License-Identifier: MIT
//
// Included before each of Nav2's files: the function that registers its nodes
// is called REGISTER_AS, so that several of them make one program.
#pragma once

#if __has_include(<behaviortree_cpp/bt_factory.h>)
#include <behaviortree_cpp/bt_factory.h>
#else
#include <behaviortree_cpp_v3/bt_factory.h>
#endif

#undef BT_REGISTER_NODES
#define BT_REGISTER_NODES(factory) \
  void REGISTER_AS(BT::BehaviorTreeFactory& factory)
