// SPDX-License-Identifier: MIT
//
// The limits of --timeout and --memory as the process meets them, whoever
// spends the time or holds the memory: a search counts what it stores, and
// nothing is forgotten here.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

#include "explore/state/limits.hpp"

namespace btcheck {

// The memory that the process holds now, in bytes; 0 where nobody tells.
std::uint64_t held_bytes();

class ProcessLimits {
 public:
  // No limit of time where `timeout` is 0. The clock starts now. Of less than
  // 64 MiB the program itself takes too large a part: there only what searches
  // count is kept to the limit.
  ProcessLimits(double timeout_seconds, std::uint64_t max_bytes)
      : timeout_(timeout_seconds),
        max_bytes_(std::max(max_bytes, kLeastMeasured)),
        start_(std::chrono::steady_clock::now()) {}

  double seconds() const;
  // The limit that is reached now, Interrupted where it was interrupted.
  StopReason reached(bool is_interrupted);
  // For a moment after that, what has been found may still be told.
  bool may_tell(bool is_interrupted);

 private:
  static constexpr std::uint64_t kLeastMeasured = std::uint64_t{64} << 20;

  double timeout_;
  std::uint64_t max_bytes_;
  std::chrono::steady_clock::time_point start_;
  std::optional<double> stopped_at_;
};

}  // namespace btcheck
