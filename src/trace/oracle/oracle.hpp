// SPDX-License-Identifier: MIT
//
// Rules asked of a robot that is told of event by event, in the form in which
// monitors of ROSMonitoring ask an oracle (Ferrando et al., "ROSMonitoring: a
// runtime verification framework for ROS", 2020).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ltl/rules/property.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/log_run.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/watch/recorded_watch.hpp"

namespace btcheck {

// The rules of one file.
struct OracleRules {
  PropertyFile file;
  SourceText source;
};

class Oracle {
 public:
  // `run` is the tree as recorded_tree makes it. Rules are refused as for a log
  // (BT1805). All must outlive it. A message ends a tick.
  static Result<std::unique_ptr<Oracle>> make(
      const BehaviorTree& tree, const RecordedRun& run,
      const std::vector<OracleRules>& rules, const LogReading& reading);

  // One line, a JSON object. The changes of status of a message of Nav2's
  // /behavior_tree_log stand in its member `event_log`; other messages change
  // nothing. The answer is that object with `verdict`, and `spec` where that is
  // `false`; of a line that is not understood an object with the verdict and
  // `error`, and a warning (BT1813). Without its line end.
  struct Answer {
    std::string line;
    std::vector<Diagnostic> told;
  };
  Answer answer(std::string_view line);

  // "true": every rule is satisfied, whatever comes. "false": one is violated
  // that is not expected to be. Else "unknown".
  std::string_view verdict() const;
  // The names of those rules, in order.
  std::vector<std::string> violated() const;

  std::size_t lines() const { return lines_; }
  std::size_t changes() const { return changes_; }

 private:
  struct Change;

  Oracle(const BehaviorTree& tree, const RecordedRun& run,
         const LogReading& reading)
      : tree_(tree), run_(run), reading_(reading) {}

  void begin(bool has_uids, std::vector<Diagnostic>& told);
  std::string take(const std::vector<Change>& changes,
                   std::vector<Diagnostic>& told);

  const BehaviorTree& tree_;
  const RecordedRun& run_;
  LogReading reading_;
  std::vector<std::unique_ptr<RecordedWatch>> watches_;
  BehaviorLog log_;  // its nodes, and the changes of the message that is read
  std::unique_ptr<LogPlayer> player_;  // from the first change on
  std::size_t lines_ = 0;
  std::size_t changes_ = 0;
};

}  // namespace btcheck
