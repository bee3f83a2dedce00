// SPDX-License-Identifier: MIT
//
// Findings of the check that a log is an instance of.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "check/questions/defaults.hpp"
#include "trace/explain/moments.hpp"

namespace btcheck {

struct FindingInLog {
  std::string_view code;
  NodeId node{};
  std::string message;
  std::int64_t tick = 0;  // in which the log shows it
};

// Those of a report that the last mission of the log shows: what is named by
// the suspicion behind the finding, step by step. What a log does not show is
// left out, and so are questions and what is so on every run.
std::vector<FindingInLog> findings_in(const BehaviorTree& tree,
                                      const DefaultReport& report,
                                      const LogMoments& moments);

}  // namespace btcheck
