// SPDX-License-Identifier: MIT
//
// Layout after src/loggers/bt_file_logger_v2.cpp of BehaviorTree.CPP 4.10,
// checked against a file it wrote. Every number has the least significant byte
// first.
#include "trace/logs/btlog.hpp"

#include <algorithm>

#include "trace/logs/status_changes.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostNodes = 0xFFFF;

}  // namespace

std::string btlog_bytes(const RecordedRun& run, int passes) {
  const LoggedTree tree = btcpp_tree(run);
  const std::string xml = btcpp_xml(tree);
  std::string bytes(kBtlogMagic);
  append_number(bytes, kBtlogVersion, 1);
  append_number(bytes, xml.size(), 4);
  bytes += xml;
  append_number(bytes, static_cast<std::uint64_t>(kLogBegin), 8);
  std::int64_t next = 0;
  for (const StatusChange& change :
       status_changes(run, tree, unrolled(run, passes))) {
    if (change.node >= kMostNodes) continue;
    const std::int64_t time = std::max(next, change.tick * kTickTime);
    append_number(bytes, static_cast<std::uint64_t>(time), 6);
    append_number(bytes, change.node + 1, 2);
    append_number(bytes, static_cast<std::uint64_t>(change.status), 1);
    next = time + 1;
  }
  return bytes;
}

}  // namespace btcheck
