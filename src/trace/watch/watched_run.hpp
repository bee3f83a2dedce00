// SPDX-License-Identifier: MIT
//
// What a recorded run says about the rules of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "ltl/monitor/monitor.hpp"
#include "ltl/rules/property.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/watch/log_watch.hpp"

namespace btcheck {

// What an open rule would be decided by, and a log does not show.
enum class TickGuess : std::uint8_t {
  None,
  Begin,  // between which records ticks begin
  Count   // how many have left no record
};

// A rule, and the moment at which it was decided.
struct WatchedRule {
  std::string name;
  std::string title;
  std::string text;
  Outlook outlook = Outlook::Open;
  bool is_question = false;  // `possible`: satisfied where it was shown
  bool is_expected = false;  // the file expects it to be violated
  bool has_unknown = false;  // something that it asks for was not known
  TickGuess guess = TickGuess::None;
  std::optional<std::size_t> record;  // of a log, from 1
  std::optional<int> tick;            // where it is known
  std::int64_t time = 0;              // of a log: microseconds since it began
  // Of a violated one, the run up to there: its last kMostShown states, and
  // what happened last in words.
  std::vector<std::string> events;
  std::optional<RecordedRun> run;
};
inline constexpr std::size_t kMostShown = 4000;

// Without the moment.
WatchedRule watched_rule(const BoundProperty& rule, Outlook outlook);
// With it, as far as the log has been played.
WatchedRule watched_rule(const LogWatch& watch, std::size_t rule);
// When it was decided, or why it is not: "record 4, tick 2, after 0.2 s"; "".
std::string moment_text(const WatchedRule& rule);

// "VIOLATED   low  (record 4, tick 2)  (expected violated)", one line.
std::string verdict_line(std::string_view verdict, std::string_view name,
                         std::string_view moment, bool is_expected);
// "3 rules: 1 satisfied, 1 violated, 1 open", by Outlook.
std::string rule_totals(const std::array<std::size_t, 4>& counts);

struct WatchReport {
  std::string heading;  // "robot.btlog: 6 nodes, 16 records, 3 ticks"
  std::vector<WatchedRule> rules;
};

// Goes through a log. The rules must have been read without an error.
Result<WatchReport> watch_log(const std::string& file, const BehaviorLog& log,
                              const LogReading& reading,
                              const PropertyFile& rules,
                              const SourceText& source);

// The same by the names of a tree whose nodes have the places of the log's.
Result<WatchReport> watch_log_as(const RecordedRun& tree,
                                 const std::string& file,
                                 const BehaviorLog& log,
                                 const LogReading& reading,
                                 const PropertyFile& rules,
                                 const SourceText& source);

// Goes through a run of btcheck; its loop, where it has one, twice.
Result<WatchReport> watch_run(const std::string& file, const RecordedRun& run,
                              const PropertyFile& rules,
                              const SourceText& source);

// A verdict for each rule with the moment and the records or events that led to
// it, and a line of totals.
std::string watch_text(const WatchReport& report);

// Some rule is violated and was not expected to be.
bool is_broken(const WatchReport& report);

}  // namespace btcheck
