// SPDX-License-Identifier: MIT
//
// What btcheck::observer writes beside a log, as NAME.btlog.marks: the ticks,
// the answers and the entries of the blackboard, which a log does not have, and
// the place of each record of the log among these.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "explore/state/limits.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/log_status.hpp"

namespace btcheck {

struct BehaviorLog;

// The numbers stand in files.
enum class MarkKind : std::uint8_t {
  End,
  TickBegins,
  TickIsWoken,  // begins, called for within the same tickOnce()
  TickEnds,
  TickIsLeft,  // by an exception
  NodeBegins,
  NodeAnswers,
  Record,  // the next one of the log stands here
  Entry,   // has another value
  TickAgain,
  WasBefore,  // the next record says what was when the log began
  Lost        // events are missing here
};

struct LogMark {
  MarkKind kind{};
  LogStatus status{};     // that a tick ends with, or a node answers
  std::uint16_t uid = 0;  // of a node
  // Of an entry; of the mark that begins the tick that comes again; of the text
  // of an exception.
  std::uint32_t number = 0;
  // Microseconds since the log began, of marks about ticks; of an entry the
  // number of its value.
  std::int64_t time = 0;
};

struct LogMarks {
  int engine = 4;                    // its version, 4 or 3
  std::vector<std::string> entries;  // "battery", "first/n"
  std::vector<LogMark> events;
  // Values of entries as scripts write them, `-1`, `2.5`, `'go home'`, or
  // `unset`, `no_value`, `of_another_type`; and texts of exceptions.
  std::vector<std::string> texts;
};

// The magic of such a file, the version that follows, and the ending of its
// name behind that of the log.
inline constexpr std::string_view kMarksMagic = "btcheck-marks";
inline constexpr int kMarksVersion = 1;
inline constexpr std::string_view kMarksEnding = ".marks";

// Reads the marks of a log into it. Both end with what both have: a file that
// is cut off is a warning (BT1304), and so are events that were lost (BT1313).
// Marks of another log (BT1312) and damaged ones are errors, and leave the log
// as it was.
std::vector<Diagnostic> read_marks(std::string_view file,
                                   std::string_view bytes, BehaviorLog& log,
                                   const Limits& limits = {});

constexpr bool begins_tick(const LogMark& mark) {
  return mark.kind == MarkKind::TickBegins ||
         mark.kind == MarkKind::TickIsWoken;
}
constexpr bool is_record(const LogMark& mark) {
  return mark.kind == MarkKind::Record || mark.kind == MarkKind::WasBefore;
}

// Calls see(mark) for each, those of a tick that comes again as often as it
// does, at its time.
template <class See>
void each_mark(const LogMarks& marks, const See& see) {
  for (const LogMark& mark : marks.events) {
    if (mark.kind != MarkKind::TickAgain) {
      see(mark);
      continue;
    }
    for (std::size_t i = mark.number;; ++i) {
      LogMark again = marks.events[i];
      const bool is_end = again.kind == MarkKind::TickEnds;
      if (is_end || begins_tick(again)) again.time = mark.time;
      see(again);
      if (is_end) break;
    }
  }
}

}  // namespace btcheck
