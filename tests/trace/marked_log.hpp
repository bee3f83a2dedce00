// SPDX-License-Identifier: MIT
//
// Writes a log with its marks, as btcheck::observer does.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "btcheck/monitor.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/marks.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {

class MarkedLogWriter {
 public:
  // `xml` as a .btlog has it, with a _uid on each node.
  explicit MarkedLogWriter(std::string xml,
                           const std::vector<std::string>& entries = {},
                           int engine = 4)
      : log_(kBtlogMagic) {
    constexpr std::int64_t kBegin = 1'700'000'000'000'000;
    append_number(log_, kBtlogVersion, 1);
    append_number(log_, xml.size(), 4);
    log_ += xml;
    append_number(log_, kBegin, 8);
    marks_ = kMarksMagic;
    append_number(marks_, kMarksVersion, 1);
    append_number(marks_, static_cast<std::uint64_t>(engine), 1);
    append_number(marks_, kBegin, 8);
    append_number(marks_, monitor::fingerprint(xml), 8);
    varint(entries.size());
    for (const std::string& entry : entries) text(entry);
    heading_ = marks_.size();
  }

  void begin_tick(std::uint64_t passed = 100'000, bool is_woken = false) {
    byte(is_woken ? MarkKind::TickIsWoken : MarkKind::TickBegins);
    pass(passed);
  }
  void end_tick(LogStatus status, std::uint64_t passed = 50) {
    byte(MarkKind::TickEnds);
    pass(passed);
    append_number(marks_, static_cast<std::uint64_t>(status), 1);
  }
  void leave_tick(std::string_view why) {
    byte(MarkKind::TickIsLeft);
    pass(50);
    text(why);
  }
  void begin_node(std::uint16_t uid) {
    byte(MarkKind::NodeBegins);
    varint(uid);
  }
  void answer(std::uint16_t uid, LogStatus status) {
    byte(MarkKind::NodeAnswers);
    varint(uid);
    append_number(marks_, static_cast<std::uint64_t>(status), 1);
  }
  // The record of a change, if it is one.
  void change(std::uint16_t uid, LogStatus status) {
    if (status_[uid] == status) return;
    byte(MarkKind::Record);
    record(uid, status);
  }
  // An answer and what it changes.
  void say(std::uint16_t uid, LogStatus status) {
    answer(uid, status);
    if (status != LogStatus::Skipped) change(uid, status);
  }
  void was(std::uint16_t uid, LogStatus status) {
    byte(MarkKind::WasBefore);
    record(uid, status);
  }
  void tick_again(std::uint64_t passed, std::uint64_t took) {
    byte(MarkKind::TickAgain);
    pass(passed);
    pass(took);
  }
  void set(std::uint64_t entry, std::int64_t value) {
    byte(MarkKind::Entry);
    varint(entry);
    append_number(marks_, 2, 1);
    varint(static_cast<std::uint64_t>(value) << 1 ^
           static_cast<std::uint64_t>(value >> 63));
  }
  void set(std::uint64_t entry, double value) {
    byte(MarkKind::Entry);
    varint(entry);
    append_number(marks_, 3, 1);
    append_number(marks_, std::bit_cast<std::uint64_t>(value), 8);
  }
  void set(std::uint64_t entry, std::string_view value) {
    byte(MarkKind::Entry);
    varint(entry);
    append_number(marks_, 4, 1);
    text(value);
  }
  // 0 unset, 1 no value, 5 a value of another type.
  void set_kind(std::uint64_t entry, std::uint64_t kind) {
    byte(MarkKind::Entry);
    varint(entry);
    append_number(marks_, kind, 1);
  }
  void lose() { byte(MarkKind::Lost); }

  // A record that has no mark, and a mark as it is.
  void record(std::uint16_t uid, LogStatus status) {
    append_number(log_, static_cast<std::uint64_t>(time_), 6);
    append_number(log_, uid, 2);
    append_number(log_, static_cast<std::uint64_t>(status), 1);
    status_[uid] = status;
  }
  void add(std::string_view bytes) { marks_ += bytes; }

  const std::string& log() const { return log_; }
  const std::string& marks() const { return marks_; }
  std::size_t heading() const { return heading_; }

 private:
  void byte(MarkKind kind) {
    append_number(marks_, static_cast<std::uint64_t>(kind), 1);
  }
  void pass(std::uint64_t microseconds) {
    time_ += microseconds;
    varint(microseconds);
  }
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) {
      marks_ += static_cast<char>((value & 0x7F) | 0x80);
    }
    marks_ += static_cast<char>(value);
  }
  void text(std::string_view letters) {
    varint(letters.size());
    marks_ += letters;
  }

  std::string log_;
  std::string marks_;
  std::size_t heading_ = 0;
  std::uint64_t time_ = 0;
  std::map<std::uint16_t, LogStatus> status_;
};

}  // namespace btcheck
