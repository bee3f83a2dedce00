// SPDX-License-Identifier: MIT
//
// Nothing in a file is believed: nodes must form trees, and records must be
// about them. Only a last record that is cut off is forgiven, with a warning: a
// robot that lost power is the very one whose log is read.
#include "trace/logs/log_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace btcheck {

const LogNode* BehaviorLog::find(std::uint16_t uid) const {
  const auto found = std::lower_bound(
      nodes.begin(), nodes.end(), uid,
      [](const LogNode& node, std::uint16_t u) { return node.uid < u; });
  return found != nodes.end() && found->uid == uid ? &*found : nullptr;
}

Diagnostic log_finding(Severity severity, std::string_view code,
                       std::string_view file, std::string message,
                       std::string help) {
  Diagnostic finding;
  finding.severity = severity;
  finding.code = code;
  finding.message = std::move(message);
  finding.file = file;
  finding.help = std::move(help);
  return finding;
}

Result<BehaviorLog> damaged_log(std::string_view file, std::string message) {
  return {std::nullopt,
          {log_finding(Severity::Error, "BT1303", file,
                       "the log is damaged: " + std::move(message))}};
}

std::string ordered_nodes(std::vector<LogNode>& nodes) {
  const auto by_uid = [](const LogNode& left, const LogNode& right) {
    return left.uid < right.uid;
  };
  std::stable_sort(nodes.begin(), nodes.end(), by_uid);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (nodes[i - 1].uid == nodes[i].uid) {
      return fmt::format("two nodes have the uid {}", nodes[i].uid);
    }
  }
  std::multimap<std::uint16_t, LogNode*> children;
  std::vector<const LogNode*> reached;
  for (LogNode& node : nodes) {
    if (node.parent) {
      children.emplace(*node.parent, &node);
    } else {
      reached.push_back(&node);
    }
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const auto [begin, end] = children.equal_range(reached[i]->uid);
    for (auto child = begin; child != end; ++child) {
      child->second->depth = reached[i]->depth + 1;
      reached.push_back(child->second);
    }
  }
  return reached.size() == nodes.size() ? "" : "a node is below itself";
}

Result<BehaviorLog> with_records(BehaviorLog log, std::string_view file,
                                 std::string_view bytes, std::size_t at,
                                 std::size_t size, RecordReader read) {
  std::map<std::uint16_t, LogStatus> last;
  std::size_t number = 0;
  for (; bytes.size() - at >= size; at += size) {
    const LogRecord record = read(bytes, at);
    const std::string where = fmt::format("record {} (byte {})", ++number, at);
    const int least = std::min(record.after, record.before.value_or(0));
    const int most = std::max(record.after, record.before.value_or(0));
    if (least < 0 || most > static_cast<int>(LogStatus::Skipped)) {
      return damaged_log(file, fmt::format("{} has the status {}", where,
                                           least < 0 ? least : most));
    }
    if (log.find(record.uid) == nullptr) {
      return damaged_log(file, fmt::format("{} is about node {}, which the "
                                           "tree does not have",
                                           where, record.uid));
    }
    LogStatus& status = last[record.uid];
    const LogStatus before =
        record.before ? static_cast<LogStatus>(*record.before) : status;
    status = static_cast<LogStatus>(record.after);
    log.transitions.push_back({record.time, record.uid, before, status});
  }
  Result<BehaviorLog> result{std::move(log), {}};
  if (at < bytes.size()) {
    result.diagnostics.push_back(log_finding(
        Severity::Warning, "BT1304", file,
        fmt::format("the last record is cut off: {} of {} bytes are there",
                    bytes.size() - at, size)));
  }
  return result;
}

}  // namespace btcheck
