// SPDX-License-Identifier: MIT
//
// A log against a model: is there a run of the network that it may be the log
// of?
//
// A log shows changes of status and nothing else: no variables, no step that
// changes no status, and of nodes that move side by side the one order in which
// they did. So the states that the model may be in are followed from record to
// record, as sets, with all steps in between that a log does not show.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "explore/state/limits.hpp"
#include "explore/state/step.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// Which node of the tree each node of a log is.
class LoggedNodes {
 public:
  // By their places, names and children; else which node is another one
  // (BT1806). `run` is the tree as recorded_tree makes it.
  static Result<LoggedNodes> match(const BehaviorLog& log,
                                   const BehaviorTree& tree,
                                   const RecordedRun& run);

  NodeId node(std::uint16_t uid) const { return by_uid_[uid].value(); }
  bool is_logged(NodeId node) const { return is_logged_[index(node)]; }

 private:
  std::vector<std::optional<NodeId>> by_uid_;
  std::vector<bool> is_logged_;  // by node
};

// A log of the tree without records: uids count from 1 in pre-order.
BehaviorLog log_of_tree(const RecordedRun& run);

// A log that has no places (a recording of ROS 2), with those of the tree's
// nodes: by uid where it has them and the names agree, else by name. Nodes of a
// name that several have become silent, and their records are left out
// (BT1812, a warning); a name that the tree does not have is an error (BT1806).
// Any other log stays as it is.
Result<BehaviorLog> placed(BehaviorLog log, const BehaviorTree& tree,
                           const RecordedRun& run);

// A change of status, as the model makes it.
struct LogEvent {
  NodeId node{};
  LogStatus status = LogStatus::Idle;

  friend bool operator==(const LogEvent&, const LogEvent&) = default;
};

struct Conformance {
  StopReason stopped = StopReason::None;  // a limit was reached: not known
  SearchProgress progress;
  // The first record that no run takes after the ones before it, from 0.
  std::optional<std::size_t> refused;
  // Of a log with marks: the answer that no run gives; then `refused` is the
  // record that follows it, or the last one.
  std::optional<LogEvent> refused_answer;
  std::int64_t tick = 0;      // of it
  std::string contradiction;  // with an earlier record, "" where there is none
  std::vector<LogEvent> allowed;  // what the model could have done there
  // It could have come, in another tick.
  bool is_in_wrong_tick = false;
  // Where the model may be when the last record, or the last of tick `until`,
  // has been written; each state once.
  std::vector<StateVector> states;
  std::size_t records = 0;  // that were taken

  bool conforms() const {
    return stopped == StopReason::None && !refused.has_value();
  }
};

// In a log that btcheck has written the ticks must be those of the model, too.
// With `until` the log is read to the end of that tick.
Conformance conform(const BehaviorTree& tree, const CompiledNetwork& system,
                    const BehaviorLog& log, const LoggedNodes& nodes,
                    const Limits& limits, std::optional<int> until = {},
                    const LogReading& reading = {});

}  // namespace btcheck
