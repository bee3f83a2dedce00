// SPDX-License-Identifier: MIT
//
// Rules asked of a log while it grows.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "ltl/rules/property.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/log_run.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/watch/recorded_watch.hpp"

namespace btcheck {

// Where ticks begin is asked of the log and of who reads it, never guessed:
// what would be decided by a guess stays open.
class LogWatch {
 public:
  // Called for each state that certainly was, once it has been seen.
  using See = std::function<bool(const RecordedState&)>;

  // Or why such rules cannot be asked of a log. `names` is the log's tree, as
  // LogPlayer has it or by other names; the log, rules and source must outlive
  // the result.
  static Result<std::unique_ptr<LogWatch>> make(const RecordedRun& names,
                                                const BehaviorLog& log,
                                                const LogReading& reading,
                                                const PropertyFile& rules,
                                                const SourceText& source,
                                                TickWays ways = TickWays::All);

  // The records of the log that follow those before.
  void play_on(std::span<const LogTransition> records, const See& see = {});
  // Of a log with marks: all that they have more.
  void play_marks(const See& see = {});
  // The log as it is, from its first record to its end.
  void play(const See& see = {});
  // The log is over. Where the tree has ended with it, time goes on; whether
  // another last tick is over is not known.
  void play_end(const See& see = {});

  const std::vector<RecordedWatch::Seen>& rules() const {
    return watch_->rules();
  }
  const RecordedWatch& watch() const { return *watch_; }
  const LogPlayer& player() const { return player_; }

  // Where a rule has been decided.
  struct Moment {
    LogPlace place;
    int tick = 0;
  };
  const Moment& moment(std::size_t rule) const { return moments_[rule]; }
  // Where each tick begins.
  bool knows_ticks() const { return knows_ticks_; }
  // An open rule would be decided if it were known where ticks begin.
  bool is_guessed(std::size_t rule) const;

 private:
  LogWatch(const BehaviorLog& log, const LogReading& reading, TickWays ways)
      : log_(log),
        player_(log, reading, ways),
        knows_ticks_(btcheck::knows_ticks(log, reading)) {}

  bool show(const RecordedState& state, const See& see);

  const BehaviorLog& log_;
  LogPlayer player_;
  const bool knows_ticks_;
  std::unique_ptr<RecordedWatch> watch_;
  std::vector<Moment> moments_;  // by rule
  bool goes_on_ = true;
};

}  // namespace btcheck
