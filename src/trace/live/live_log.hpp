// SPDX-License-Identifier: MIT
//
// A log of BehaviorTree.CPP that is still being written, as a run that grows.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"
#include "trace/live/live_run.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/log_run.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

class LiveLog {
 public:
  // `tick_time`: microseconds of a tick, for logs that btcheck has not written.
  // `topic`: as for read_log.
  LiveLog(std::string file, std::int64_t tick_time, std::string topic = "")
      : file_(std::move(file)),
        tick_time_(tick_time),
        topic_(std::move(topic)) {}

  // All bytes that the file has now. What is new since the last call is added
  // to the run; a last record that is not whole is waited for. A file that has
  // been begun anew is a run that begins anew. Returns why it cannot be read:
  // then nothing has changed.
  std::vector<Diagnostic> take(std::string_view bytes);
  // The log is not followed any longer.
  void end(std::string_view words);

  // Once a call of `take` has gone well.
  LiveRun& run() { return *run_; }

 private:
  RecordedRun beginning() const;
  void gather();
  void show();

  std::string file_;
  std::int64_t tick_time_;
  std::string topic_;
  BehaviorLog log_;
  std::size_t played_ = 0;             // of its records
  std::unique_ptr<LogPlayer> player_;  // of the log
  std::unique_ptr<LiveRun> run_;
  std::vector<RecordedState> states_;  // that are not shown yet
};

}  // namespace btcheck
