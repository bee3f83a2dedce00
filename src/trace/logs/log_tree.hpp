// SPDX-License-Identifier: MIT
//
// What the readers of both log formats share: the nodes, and how they refuse.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trace/logs/behavior_log.hpp"

namespace btcheck {

// A finding about the file as a whole; its bytes are no lines.
Diagnostic log_finding(Severity severity, std::string_view code,
                       std::string_view file, std::string message,
                       std::string help = {});

// BT1303: damaged, in this way.
Result<BehaviorLog> damaged_log(std::string_view file, std::string message);

// Puts the nodes in the order of their uids and finds out how deep they stand.
// What is wrong with them (a uid twice, a node that is below itself), or "".
std::string ordered_nodes(std::vector<LogNode>& nodes);

// One record, as both formats have them.
struct LogRecord {
  std::int64_t time = 0;
  std::uint16_t uid = 0;
  std::optional<int> before;  // not all formats say
  int after = 0;
};

// What reads record i, which begins at that byte.
using RecordReader = LogRecord (*)(std::string_view bytes, std::size_t at);

// The log with the records that begin at a byte. `before` is what the record
// says, else the status that was logged last.
Result<BehaviorLog> with_records(BehaviorLog log, std::string_view file,
                                 std::string_view bytes, std::size_t at,
                                 std::size_t size, RecordReader read);

}  // namespace btcheck
