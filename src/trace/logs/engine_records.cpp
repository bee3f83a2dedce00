// SPDX-License-Identifier: MIT
#include "trace/logs/engine_records.hpp"

namespace btcheck {

SetsRunning sets_running_in(NodeType type, Profile profile) {
  // src/controls/parallel_node.cpp of 3.8.8 does not.
  if (type == NodeType::Parallel && is_release_3(profile)) {
    return SetsRunning::Never;
  }
  return info_of(type).sets_running;
}

bool is_from_idle(SetsRunning when) {
  return when == SetsRunning::FromIdle ||
         when == SetsRunning::WithChildFromIdle ||
         when == SetsRunning::AsProgrammed;
}

bool sets_running(SetsRunning when, std::string_view from, std::string_view to,
                  bool is_call) {
  if (when == SetsRunning::Never) return false;
  if (when == SetsRunning::WithChild ||
      when == SetsRunning::WithChildFromIdle) {
    return is_call;
  }
  if (when == SetsRunning::AsProgrammed && is_call) return true;
  if (to == "tick") return true;
  return from == "tick_node" && to != "conditions" && to != "still";
}

}  // namespace btcheck
