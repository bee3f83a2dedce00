// SPDX-License-Identifier: MIT
//
// A log of BehaviorTree.CPP that is still being written, as a run that grows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ltl/rules/property.hpp"
#include "text/diagnostic.hpp"
#include "trace/live/live_run.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/log_run.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/watch/log_watch.hpp"

namespace btcheck {

// A log with the places and the names of a tree.
struct LogInTree {
  RecordedRun names;
  BehaviorLog log;
};

// The rules of a file, and of which tree they speak: `place` finds the log's
// nodes in it; nothing where they speak of the log's own.
struct LiveRules {
  PropertyFile file;
  SourceText source;
  std::function<Result<LogInTree>(const BehaviorLog&)> place = {};
  std::shared_ptr<const void> text = {};  // that the source is a view of
};

class LiveLog {
 public:
  // `topic`: as for read_log. Rules must have been read without an error.
  LiveLog(std::string file, const LogReading& reading, std::string topic = "",
          std::vector<LiveRules> rules = {});
  ~LiveLog();

  // All bytes that the file has now, and those of its marks where it has such.
  // What is new since the last call is added
  // to the run; a last record that is not whole is waited for. A file that has
  // been begun anew is a run that begins anew. Returns why it cannot be read,
  // or be asked these rules: then nothing has changed.
  std::vector<Diagnostic> take(std::string_view bytes,
                               const std::string* marks = nullptr);

  // The same of a log that comes in another way: it begins, or begins anew,
  std::vector<Diagnostic> begin(BehaviorLog log);
  // and has these records more, shown each or by the state behind them alone.
  enum class Shown : std::uint8_t { Each, Last, Nothing };
  void add(std::span<const LogTransition> records, Shown shown = Shown::Each);
  // What entries have as values from now on, as texts by their names. The run
  // has those that were known when it began.
  void know(const std::map<std::string, std::string>& entries);
  // Of a log that comes in that way: nothing is kept of it that is not shown,
  // however long it goes on.
  void forget() { forgets_ = true; }
  // What is said of the run that begins next.
  void say(std::string words) { words_ = std::move(words); }

  // The log is over, and another one may begin.
  void close();
  // The log is not followed any longer.
  void end(std::string_view words);

  // What it says of the rules so far, those of the first file first.
  const std::vector<LiveVerdict>& verdicts() const { return verdicts_; }
  // The same as lines of text.
  std::string verdicts_text() const;
  // A rule is violated that was not expected to be.
  bool is_broken() const;

  // Once `take` or `begin` has gone well.
  LiveRun& run() { return *run_; }

 private:
  struct Judge;

  RecordedRun beginning() const;
  std::vector<Diagnostic> ask(const BehaviorLog& log);
  void add_marks(BehaviorLog log);
  void gather(std::span<const LogTransition> records,
              Shown shown = Shown::Each);
  void note_state();
  void show();
  void judge();
  std::size_t state_of(const LogWatch& watch, std::size_t rule) const;

  std::string file_;
  LogReading reading_;
  std::string topic_;
  std::vector<LiveRules> rules_;
  BehaviorLog log_;
  std::unique_ptr<LogPlayer> player_;  // of the log
  std::vector<std::unique_ptr<Judge>> judges_;
  std::vector<LiveVerdict> verdicts_;
  std::unique_ptr<LiveRun> run_;
  std::vector<RecordedState> states_;  // that are not shown yet
  // By state: how many records had been read, and the tick.
  std::vector<std::pair<std::size_t, int>> places_;
  bool is_open_ = false;
  bool forgets_ = false;
  std::size_t forgotten_ = 0;        // states without a place
  std::vector<std::string> values_;  // of entries
  std::vector<std::string> names_;   // theirs
  std::string words_;
};

}  // namespace btcheck
