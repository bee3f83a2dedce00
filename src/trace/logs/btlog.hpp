// SPDX-License-Identifier: MIT
//
// A run as a log of BehaviorTree.CPP 4, for Groot2.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// What a .btlog begins with, and the version of the format that follows.
inline constexpr std::string_view kBtlogMagic = "BTCPP4-FileLogger2";
inline constexpr int kBtlogVersion = 1;

// When our logs begin: 2000-01-01 UTC, in microseconds since 1970. A log that
// begins then has synthetic times: tick t begins t * kTickTime later.
inline constexpr std::int64_t kLogBegin = 946'684'800'000'000;
inline constexpr std::int64_t kTickTime = 100'000;

// The bytes of FileLogger2: magic, version, XML, the time the log begins, and 9
// bytes for each change of a status. Event i of tick t (from 0) has the time
// t * 100 ms + i us, so that a slider moves by ticks. The loop of a run is gone
// through `passes` times. Nodes beyond the 65,535th have no number in such a
// log and are silent.
std::string btlog_bytes(const RecordedRun& run, int passes = 2);

}  // namespace btcheck
