// SPDX-License-Identifier: MIT
//
// As in a log, nothing is believed: events must be about nodes and entries that
// are there, and come where they can. What is cut off ends before the event.
#include "trace/logs/marks.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "btcheck/monitor.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/flaws.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {
namespace {

constexpr std::uint64_t kMostMicroseconds = std::uint64_t{1} << 60;
// So many bytes between two looks at the limits.
constexpr std::size_t kLook = std::size_t{1} << 16;

// The file ends within an event.
struct CutOff {};

Diagnostic damaged_marks(const std::string& what) {
  return flaw("BT1303", "the marks are damaged: " + what,
              "remove this file, and the log is read without marks");
}

class MarksReader {
 public:
  MarksReader(std::string_view bytes, BehaviorLog& log, const Limits& limits)
      : bytes_(bytes), log_(log), limits_(limits) {}

  std::vector<Diagnostic> read() {
    read_heading();
    bool is_cut = false;
    for (std::size_t looked = 0; at_ < bytes_.size() && !is_over_;) {
      if (at_ - looked >= kLook) {
        looked = at_;
        keep_limits(limits_,
                    bytes_.size() +
                        log_.transitions.size() * sizeof(LogTransition) +
                        marks_.events.size() * sizeof(LogMark));
      }
      const std::size_t event = begin_ = at_;
      try {
        take(static_cast<int>(number(1)));
      } catch (const CutOff&) {
        at_ = event;
        is_cut = is_over_ = true;
      }
    }
    std::vector<Diagnostic> found;
    if (is_cut) {
      found.push_back(flaw("BT1304", "the last mark is cut off"));
    }
    if (is_lost_) {
      found.push_back(flaw("BT1313",
                           "events were lost after the last one that is read: "
                           "the disk was too slow",
                           "write the log to a faster disk"));
    }
    if (lacks_record_) {
      found.push_back(flaw(
          "BT1304", fmt::format("the log has {} records, its marks have more",
                                log_.transitions.size())));
    } else if (!is_lost_ && records_ < log_.transitions.size()) {
      found.push_back(flaw(
          "BT1304", fmt::format("the log has {} records, its marks have {}",
                                log_.transitions.size(), records_)));
    }
    for (Diagnostic& each : found) each.severity = Severity::Warning;
    log_.transitions.resize(records_);
    log_.version = marks_.engine;
    log_.marks = std::move(marks_);
    return found;
  }

 private:
  // --- Bytes

  std::uint64_t number(std::size_t count) {
    if (count > bytes_.size() - at_) throw CutOff();
    at_ += count;
    return number_at(bytes_, at_ - count, count);
  }

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const std::uint64_t byte = number(1);
      if (shift > 63 || (shift == 63 && byte > 1)) {
        throw damaged("a number is too long");
      }
      value |= (byte & 0x7F) << shift;
      if (byte < 0x80) return value;
    }
  }

  std::string text() {
    const std::uint64_t length = varint();
    if (length > bytes_.size() - at_) throw CutOff();
    at_ += length;
    return std::string(bytes_.substr(at_ - length, length));
  }

  Diagnostic damaged(const std::string& what) const {
    return damaged_marks(fmt::format("byte {}: {}", begin_, what));
  }

  // --- The heading

  void read_heading() {
    const std::string_view magic = bytes_.substr(0, kMarksMagic.size());
    if (!kMarksMagic.starts_with(magic)) {
      throw flaw("BT1302", "this file has no marks of btcheck::observer",
                 "remove it, or let btcheck::observer write it");
    }
    try {
      at_ = std::min(kMarksMagic.size(), bytes_.size());
      const auto version = number(1);
      if (version != kMarksVersion) {
        throw flaw("BT1302",
                   fmt::format("the marks have version {}; version {} is known",
                               version, kMarksVersion),
                   "read them with the btcheck that the observer is of");
      }
      const auto engine = number(1);
      if (engine != 3 && engine != 4) {
        throw damaged_marks(fmt::format("they are of engine {}", engine));
      }
      marks_.engine = static_cast<int>(engine);
      const auto begin = static_cast<std::int64_t>(number(8));
      const std::uint64_t hash = number(8);
      if (begin != log_.begin || hash != monitor::fingerprint(log_.xml)) {
        throw flaw("BT1312",
                   begin != log_.begin
                       ? "these marks are of another log: it began at another "
                         "time"
                       : "these marks are of another log: its tree is another",
                   "keep a log and its marks together, or remove the marks");
      }
      for (std::uint64_t count = varint(); count > 0; --count) {
        marks_.entries.push_back(text());
      }
    } catch (const CutOff&) {
      throw damaged_marks("their heading is cut off");
    }
  }

  // --- Events

  void take(int byte) {
    if (byte > static_cast<int>(MarkKind::Lost)) {
      throw damaged(fmt::format("there is no event {}", byte));
    }
    LogMark mark;
    mark.kind = static_cast<MarkKind>(byte);
    switch (mark.kind) {
      case MarkKind::End:
        is_over_ = true;
        return;
      case MarkKind::Lost:
        is_over_ = is_lost_ = true;
        return;
      case MarkKind::TickBegins:
      case MarkKind::TickIsWoken:
        pass(mark);
        begin_tick();
        break;
      case MarkKind::TickEnds:
        pass(mark);
        mark.status = status();
        end_tick(true);
        break;
      case MarkKind::TickIsLeft:
        pass(mark);
        mark.number = kept(text());
        end_tick(false);
        break;
      case MarkKind::NodeBegins:
        mark.uid = node();
        within_tick();
        break;
      case MarkKind::NodeAnswers:
        mark.uid = node();
        mark.status = status();
        within_tick();
        break;
      case MarkKind::Record:
      case MarkKind::WasBefore:
        if (!take_records(1)) return;
        break;
      case MarkKind::Entry:
        mark.number = entry();
        mark.time = kept(value());
        may_repeat_ = false;
        break;
      case MarkKind::TickAgain:
        repeat(mark);
        if (is_over_) return;
        break;
    }
    if (mark.kind == MarkKind::WasBefore && is_in_tick_) {
      throw damaged("a status of before the log stands in a tick");
    }
    marks_.events.push_back(mark);
  }

  void pass() {
    time_ += varint();
    if (time_ > kMostMicroseconds) throw damaged("its time is too great");
  }
  void pass(LogMark& mark) {
    pass();
    mark.time = static_cast<std::int64_t>(time_);
  }

  void begin_tick() {
    if (is_in_tick_) throw damaged("a tick begins within another");
    is_in_tick_ = may_repeat_ = true;
    first_ = marks_.events.size();
    records_before_ = records_;
  }

  void end_tick(bool may_repeat) {
    if (!is_in_tick_) throw damaged("a tick ends that has not begun");
    is_in_tick_ = false;
    may_repeat_ &= may_repeat;
    has_tick_ = may_repeat_;
    records_within_ = records_ - records_before_;
  }

  void within_tick() const {
    if (!is_in_tick_) throw damaged("a node is ticked outside of a tick");
  }

  void repeat(LogMark& mark) {
    pass(mark);
    pass();
    if (is_in_tick_ || !has_tick_) {
      throw damaged("a tick comes again that was not there before");
    }
    mark.number = static_cast<std::uint32_t>(first_);
    take_records(records_within_);
  }

  // False where the log does not have so many more.
  bool take_records(std::size_t count) {
    if (count > log_.transitions.size() - records_) {
      lacks_record_ = is_over_ = true;
      return false;
    }
    records_ += count;
    return true;
  }

  LogStatus status() {
    const auto found = number(1);
    if (found < 1 || found > 4) {
      throw damaged(fmt::format("there is no answer {}", found));
    }
    return static_cast<LogStatus>(found);
  }

  std::uint16_t node() {
    const std::uint64_t uid = varint();
    if (uid > UINT16_MAX ||
        log_.find(static_cast<std::uint16_t>(uid)) == nullptr) {
      throw damaged(fmt::format("the tree has no node with the uid {}", uid));
    }
    return static_cast<std::uint16_t>(uid);
  }

  std::uint32_t entry() {
    const std::uint64_t number = varint();
    if (number >= marks_.entries.size()) {
      throw damaged(fmt::format("there is no entry {}", number));
    }
    return static_cast<std::uint32_t>(number);
  }

  std::string value() {
    switch (number(1)) {
      case 0:
        return "unset";
      case 1:
        return "no_value";
      case 2: {
        const std::uint64_t zigzag = varint();
        return fmt::format("{}", static_cast<std::int64_t>(zigzag >> 1) ^
                                     -static_cast<std::int64_t>(zigzag & 1));
      }
      case 3: {
        const auto real = std::bit_cast<double>(number(8));
        return std::isnan(real) ? "of_another_type" : fmt::format("{}", real);
      }
      case 4:
        return "'" + text() + "'";
      case 5:
        return "of_another_type";
      default:
        throw damaged("an entry has a value of a kind that is not known");
    }
  }

  std::uint32_t kept(std::string text) {
    marks_.texts.push_back(std::move(text));
    return static_cast<std::uint32_t>(marks_.texts.size() - 1);
  }

  std::string_view bytes_;
  BehaviorLog& log_;
  const Limits& limits_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;  // of the event
  LogMarks marks_;
  std::uint64_t time_ = 0;
  std::size_t records_ = 0;  // that marks stand for
  bool is_in_tick_ = false;
  bool may_repeat_ = false;  // the tick that is read
  bool has_tick_ = false;    // the one before can come again
  std::size_t first_ = 0;    // its first mark
  std::size_t records_before_ = 0;
  std::size_t records_within_ = 0;
  bool is_over_ = false;
  bool is_lost_ = false;
  bool lacks_record_ = false;
};

}  // namespace

std::vector<Diagnostic> read_marks(std::string_view file,
                                   std::string_view bytes, BehaviorLog& log,
                                   const Limits& limits) {
  std::vector<Diagnostic> found;
  try {
    found = MarksReader(bytes, log, limits).read();
  } catch (Diagnostic& flaw) {
    found = {std::move(flaw)};
  }
  for (Diagnostic& each : found) each.file = file;
  return found;
}

}  // namespace btcheck
