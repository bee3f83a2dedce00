// SPDX-License-Identifier: MIT
//
// Faults on purpose: what nodes of a robot answer instead of what they would,
// and where it is to stop.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "groot2/wire.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck::groot2 {

struct Fault {
  std::string text;  // as it was written
  std::string node;  // as rules name nodes
  bool is_break = false;
  bool is_once = true;
  LogStatus answer = LogStatus::Failure;
  std::int64_t from_tick = 1;
};

// "NODE succeeds|fails [once|always] [from tick N]", or what is wrong with it.
struct ReadFault {
  std::optional<Fault> fault;
  std::string flaw;
};
ReadFault fault_in(std::string_view text);
// "NODE [from tick N]": where to stop.
ReadFault break_in(std::string_view text);

// The hooks of these faults in the tree of a log, in their order, or why there
// are none (BT1906, BT1907).
Result<std::vector<Hook>> hooks_of(const std::vector<Fault>& faults,
                                   const BehaviorLog& log,
                                   const std::string& robot);

}  // namespace btcheck::groot2
