// SPDX-License-Identifier: MIT
//
// What the nodes of BehaviorTree.CPP leave in a log beside their answers: one
// row for each type (BehaviorTree.CPP 4.10 and 3.8.8, src/controls,
// src/decorators; Nav2's plugins).
#pragma once

#include <cstdint>
#include <string_view>

#include "model/tree/tree.hpp"

namespace btcheck {

// Where tick() calls setStatus(RUNNING), before the node answers.
enum class SetsRunning : std::uint8_t {
  Never,
  First,              // of all, in every tick
  FromIdle,           // first of all, in a tick that finds it idle
  WithChild,          // before it ticks its child
  WithChildFromIdle,  // likewise, in a tick that finds it idle
  AsProgrammed        // by the user's program: anywhere, or never
};

struct EngineRecords {
  SetsRunning sets_running = SetsRunning::Never;
  bool ends_idle = false;  // may call its own halt() before it answers
};

// Of a type in this release.
EngineRecords engine_records(NodeType type, Profile profile);

// Only where it is idle.
bool is_from_idle(SetsRunning when);

// Whether such a node calls setStatus(RUNNING) in a step of its automaton
// between locations of these names: tick() begins where preconditions have let
// it through (TreeNode::executeTick). `is_call`: it turns to a child.
bool sets_running(SetsRunning when, std::string_view from, std::string_view to,
                  bool is_call);

}  // namespace btcheck
