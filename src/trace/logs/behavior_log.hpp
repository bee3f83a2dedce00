// SPDX-License-Identifier: MIT
//
// What a robot's executor has logged: the log files of BehaviorTree.CPP.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"

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

struct LogNode {
  std::uint16_t uid = 0;
  std::string name;  // of the instance; a SubTree's: its tree
  std::string type;  // as registered
  std::optional<std::uint16_t> parent;  // its uid
  std::size_t depth = 0;                // how many are above it
};

struct LogTransition {
  std::int64_t time = 0;  // microseconds since the log began
  std::uint16_t uid = 0;
  LogStatus before = LogStatus::Idle;
  LogStatus after = LogStatus::Idle;

  friend bool operator==(const LogTransition&, const LogTransition&) = default;
};

struct BehaviorLog {
  int version = 4;             // of BehaviorTree.CPP: 4 for .btlog, 3 for .fbl
  std::int64_t begin = 0;      // microseconds since 1970-01-01 UTC
  std::vector<LogNode> nodes;  // ascending by uid; each below a root
  std::vector<LogTransition> transitions;

  // The node with this uid, or null.
  const LogNode* find(std::uint16_t uid) const;
};

// Reads what FileLogger2 of BehaviorTree.CPP 4 writes (a .btlog, known by its
// first bytes), or FileLogger of BehaviorTree.CPP 3 (a .fbl, known by the
// file's name). A last record that is cut off, as when a robot loses power, is
// a warning; all others are given.
Result<BehaviorLog> read_log(std::string_view file, std::string_view bytes);

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
