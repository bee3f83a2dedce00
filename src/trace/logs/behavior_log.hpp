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

// Reads what FileLogger2 of BehaviorTree.CPP 4 writes. BT1302: this is no such
// log, or one of another version. BT1303: it is damaged. BT1304, a warning: the
// last record is cut off, as when a robot loses power; all others are given.
Result<BehaviorLog> read_btlog(std::string_view file, std::string_view bytes);

// The same for FileLogger of BehaviorTree.CPP 3, a flatbuffer and records.
Result<BehaviorLog> read_fbl(std::string_view file, std::string_view bytes);

// By its first bytes, which only a .btlog has, else by the file's name.
Result<BehaviorLog> read_log(std::string_view file, std::string_view bytes);

}  // namespace btcheck
