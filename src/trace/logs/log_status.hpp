// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace btcheck {

// BehaviorTree.CPP's NodeStatus; the numbers stand in files.
enum class LogStatus : std::uint8_t {
  Idle,
  Running,
  Success,
  Failure,
  Skipped
};
inline constexpr std::array<std::string_view, 5> kLogStatusNames = {
    "IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED"};

constexpr bool is_completed(LogStatus status) {
  return status == LogStatus::Success || status == LogStatus::Failure;
}

}  // namespace btcheck
