// SPDX-License-Identifier: MIT
//
// The log files of BehaviorTree.CPP: what a robot's executor has logged, and a
// run written as such a log, for Groot2.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "explore/state/limits.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/log_status.hpp"
#include "trace/logs/marks.hpp"

namespace btcheck {

struct RecordedRun;

struct LogNode {
  std::uint16_t uid = 0;
  std::string name;  // of the instance; a SubTree's: its tree
  std::string type;  // as registered
  std::optional<std::uint16_t> parent;  // its uid
  std::size_t depth = 0;                // how many are above it
  bool is_silent = false;  // what it does was not told apart from others

  friend bool operator==(const LogNode&, const LogNode&) = default;
};

struct LogTransition {
  std::int64_t time = 0;  // microseconds since the log began
  std::uint16_t uid = 0;
  LogStatus before = LogStatus::Idle;
  LogStatus after = LogStatus::Idle;

  friend bool operator==(const LogTransition&, const LogTransition&) = default;
};

struct BehaviorLog {
  int version = 4;             // of BehaviorTree.CPP: 4 for .btlog, 3 for .fbl
  std::int64_t begin = 0;      // microseconds since 1970-01-01 UTC
  std::string tree;            // the main tree's ID; "" in a .fbl
  std::string xml;             // all trees; "" in a .fbl
  std::vector<LogNode> nodes;  // ascending by uid; each below a root
  std::vector<LogTransition> transitions;
  std::string topic;     // of a recording of ROS 2, else ""
  bool has_uids = true;  // else its nodes are numbered as they come
  std::optional<LogMarks> marks = {};  // of btcheck::observer

  // False for a recording of ROS 2: nodes are names, until they are `placed`.
  bool has_places() const { return topic.empty(); }

  // The node with this uid, or null.
  const LogNode* find(std::uint16_t uid) const;
};

// Reads what FileLogger2 of BehaviorTree.CPP 4 writes (a .btlog, known by its
// first bytes), FileLogger of BehaviorTree.CPP 3 (a .fbl, known by the file's
// name), or rosbag2 of Nav2's /behavior_tree_log (.mcap, .db3), of which
// `topic` chooses one of several. A last record cut off, as when a robot loses
// power, is a warning; a limit that is reached an error.
Result<BehaviorLog> read_log(std::string_view file, std::string_view bytes,
                             std::string_view topic = {},
                             const Limits& limits = {});

// True for what read_log is to read, by name and first bytes.
bool is_log(std::string_view file, std::string_view bytes);

// True for a log that btcheck wrote: its times are synthetic.
bool is_own(const BehaviorLog& log);

// What is known of the ticks of a log that does not have them: in microseconds.
struct LogReading {
  std::int64_t tick_time = 100'000;  // from one to the next
  bool is_time_said = false;         // by somebody who knows the robot
  // A pause of that length or more parts two ticks, a shorter one does not.
  // Nobody says so: where ticks begin is not known.
  std::optional<std::int64_t> tick_gap = {};
};

// Whether it is known where each tick of a log begins.
inline bool knows_ticks(const BehaviorLog& log, const LogReading& reading) {
  return is_own(log) || log.marks || reading.tick_gap.has_value();
}

// A pause that is shown as one between two ticks where nobody says better:
// within a tick, changes follow one another at once but where a function
// blocks; between two, the executor sleeps. Nothing is decided by it.
inline constexpr std::int64_t kTickPause = 5'000;

// Counts the ticks of a log, record by record. A log that btcheck wrote has
// them. In others a pause parts two ticks, and the time from the beginning of
// the one to that of the other says how many there were; or only those with
// records are counted, where the gap is said and the time is not.
class TickCounter {
 public:
  TickCounter(const BehaviorLog& log, const LogReading& reading)
      : is_own_(is_own(log)),
        is_counted_(!reading.tick_gap || reading.is_time_said),
        tick_time_(reading.tick_time),
        pause_(reading.tick_gap.value_or(kTickPause)) {}

  // The tick of a record at this time, from 1; never less than the last one.
  std::int64_t tick_at(std::int64_t time);

 private:
  bool is_own_;
  bool is_counted_;
  std::int64_t tick_time_;
  std::int64_t pause_;
  std::int64_t tick_ = 0;
  std::int64_t begin_ = 0;  // of this tick
  std::int64_t last_ = 0;   // the record before
};

// The tick of each record, from 1: as the marks say, else as a TickCounter
// does.
std::vector<std::int64_t> ticks_of(const BehaviorLog& log,
                                   const LogReading& reading);

// "-0.000012" for microseconds.
std::string seconds_text(std::int64_t time);

// The tree with its uids, then every change of a status in the style of
// BehaviorTree.CPP's StdCoutLogger, under a heading for each tick:
//
//     after 0.030183 s
//       [0.030183]    2 a                  RUNNING -> SUCCESS
//
// What has no ticks is parted where nothing changed for as long as a gap, or
// for 5 ms; a log that btcheck wrote has them, and its headings say `tick 1`.
std::string log_text(const BehaviorLog& log, const LogReading& reading = {});

// What a .btlog begins with, and the version of the format that follows.
inline constexpr std::string_view kBtlogMagic = "BTCPP4-FileLogger2";
inline constexpr int kBtlogVersion = 1;

// When our logs begin: 2000-01-01 UTC, in microseconds since 1970. A log that
// begins then has synthetic times: tick t begins t * kTickTime later.
inline constexpr std::int64_t kLogBegin = 946'684'800'000'000;
inline constexpr std::int64_t kTickTime = 100'000;

// The bytes of FileLogger2: magic, version, XML, the time the log begins, and 9
// bytes for each change of a status.
std::string btlog_heading(std::string_view xml, std::int64_t begin);
void append_record(std::string& bytes, std::int64_t time, std::uint16_t uid,
                   LogStatus status);

// A run as such a log. Event i of tick t (from 0) has the time
// t * 100 ms + i us, so that a slider moves by ticks. The loop of a run is gone
// through `passes` times. Nodes beyond the 65,535th have no number in such a
// log and are silent.
std::string btlog_bytes(const RecordedRun& run, int passes = 2);

}  // namespace btcheck
