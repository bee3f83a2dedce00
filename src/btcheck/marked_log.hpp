// SPDX-License-Identifier: MIT
//
// A log of a behavior tree with what logs do not show: NAME.btlog is what
// FileLogger2 of BehaviorTree.CPP 4 writes and Groot2 reads, NAME.btlog.marks
// has ticks, answers, exceptions and entries, and where among these each record
// of the log stands (docs/robots.md has the format). C++17, the standard
// library and nothing else.
//
// Who tells copies a few bytes into a ring and goes on; a thread writes them.
// Files are whole after a crash, but for the last hundredth of a second.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <deque>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "btcheck/monitor.hpp"

namespace btcheck {

class MarkedLog {
 public:
  struct Heading {
    std::string file;  // NAME.btlog
    int engine = 4;    // of BehaviorTree.CPP
    std::string xml;
    std::vector<std::uint16_t> uids;                  // of node 1, 2, …
    std::vector<std::string> entries;                 // their names
    std::size_t most_bytes = std::size_t{32} << 20U;  // of a file
    std::size_t most_files = 4;  // robot.btlog, robot.2.btlog, …: the last ones
  };
  enum class Mark : std::uint8_t {
    End,
    TickBegins,
    WokenUp,
    TickEnds,
    TickIsLeft,
    NodeBegins,
    NodeAnswers,
    Record,
    Entry,
    SameTick,
    Before,
    Lost
  };
  static constexpr std::string_view kMagic = "btcheck-marks";
  static constexpr std::uint8_t kVersion = 1;

  // Throws std::runtime_error where the files cannot be written.
  explicit MarkedLog(Heading heading)
      : heading_(std::move(heading)), ring_(kRing), begin_(Clock::now()) {
    tick_.reserve(kPiece);
    last_tick_.reserve(kPiece);
    marks_.reserve(kPiece);
    records_.reserve(kPiece);
    status_.resize(heading_.uids.size() + 1, 0);
    open();
    writer_ = std::thread([this] { write(); });
  }
  ~MarkedLog() {
    is_over_ = true;
    if (writer_.joinable()) writer_.join();
    close();
  }
  MarkedLog(const MarkedLog&) = delete;
  MarkedLog& operator=(const MarkedLog&) = delete;

  // --- Of the thread that tells ---

  void begin_tick(bool is_wake_up) {
    Bytes bytes(is_wake_up ? Mark::WokenUp : Mark::TickBegins);
    add_time(bytes);
    push(bytes);
  }
  void end_tick(monitor::Status answer) {
    Bytes bytes(Mark::TickEnds);
    add_time(bytes);
    bytes.push_back(static_cast<std::uint8_t>(answer));
    push(bytes);
  }
  void leave_tick() {
    Bytes bytes(Mark::TickIsLeft);
    add_time(bytes);
    // Without a text: the observer does not hear what was thrown.
    bytes.push_back(0);
    push(bytes);
  }
  void begin_node(std::size_t node) {
    Bytes bytes(Mark::NodeBegins);
    add_number(bytes, heading_.uids[node - 1]);
    push(bytes);
  }
  void answer(std::size_t node, monitor::Status status) {
    Bytes bytes(Mark::NodeAnswers);
    add_number(bytes, heading_.uids[node - 1]);
    bytes.push_back(static_cast<std::uint8_t>(status));
    push(bytes);
  }
  void change(std::size_t node, monitor::Status before, monitor::Status after) {
    Bytes bytes(Mark::Record);
    add_bytes(bytes, static_cast<std::uint64_t>(since_begin()), 6);
    add_bytes(bytes, heading_.uids[node - 1], 2);
    bytes.push_back(static_cast<std::uint8_t>(after));
    (void)before;  // readers know it from the record before
    push(bytes);
  }
  void entry(std::size_t entry, const monitor::EntryValue& value) {
    Bytes bytes(Mark::Entry);
    add_number(bytes, entry);
    bytes.push_back(static_cast<std::uint8_t>(value.kind));
    if (value.kind == monitor::EntryValue::Integer) {
      const auto bits = static_cast<std::uint64_t>(value.integer);
      add_number(bytes,
                 (bits << 1U) ^ (value.integer < 0 ? ~std::uint64_t{0} : 0));
    } else if (value.kind == monitor::EntryValue::Real) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value.real, sizeof bits);
      add_bytes(bytes, bits, 8);
    } else if (value.kind == monitor::EntryValue::Text) {
      const std::size_t length = std::min(value.text.size(), Bytes::kMostText);
      add_number(bytes, length);
      for (std::size_t i = 0; i < length; ++i) {
        bytes.push_back(static_cast<std::uint8_t>(value.text[i]));
      }
    }
    push(bytes);
  }

  // Waits until all that was told is written.
  void flush() {
    const std::uint64_t told = told_.load();
    while (written_.load() < told) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  // How many events were lost, the disk being too slow.
  std::uint64_t lost() const { return lost_.load(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kRing = std::size_t{1} << 20U;
  static constexpr std::size_t kPiece = std::size_t{1} << 16U;

  // One event.
  class Bytes {
   public:
    static constexpr std::size_t kMostText = 200;  // of a longer text so much
    explicit Bytes(Mark mark) { push_back(static_cast<std::uint8_t>(mark)); }
    void push_back(std::uint8_t byte) { bytes_[size_++] = byte; }
    const std::uint8_t* data() const { return bytes_; }
    std::uint8_t size() const { return size_; }

   private:
    std::uint8_t bytes_[255] = {};
    std::uint8_t size_ = 0;
  };

  // LEB128.
  template <class Bytes_>
  static void add_number(Bytes_& bytes, std::uint64_t number) {
    for (; number >= 0x80U; number >>= 7U) {
      bytes.push_back(static_cast<std::uint8_t>(number | 0x80U));
    }
    bytes.push_back(static_cast<std::uint8_t>(number));
  }
  // Little endian, so many bytes.
  template <class Bytes_>
  static void add_bytes(Bytes_& bytes, std::uint64_t number, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
    }
  }

  std::int64_t since_begin() const {
    return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() -
                                                                 begin_)
        .count();
  }
  void add_time(Bytes& bytes) {
    const std::int64_t now = since_begin();
    add_number(bytes, static_cast<std::uint64_t>(now - last_time_));
    last_time_ = now;
  }

  // An event with its length before it, whole or not at all.
  void push(const Bytes& bytes) {
    const std::uint64_t end = told_.load(std::memory_order_relaxed);
    const std::size_t used = static_cast<std::size_t>(
        end - written_.load(std::memory_order_acquire));
    const std::size_t needed = std::size_t{bytes.size()} + 1;
    if (used + needed + 3 > kRing) {
      has_lost_ = true;
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    std::uint64_t at = end;
    if (has_lost_) {
      has_lost_ = false;
      put(at++, 1);
      put(at++, static_cast<std::uint8_t>(Mark::Lost));
    }
    put(at++, bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) put(at++, bytes.data()[i]);
    told_.store(at, std::memory_order_release);
  }
  void put(std::uint64_t at, std::uint8_t byte) { ring_[at % kRing] = byte; }

  // --- Of the thread that writes ---

  void write() {
    for (bool is_last = false; !is_last;) {
      is_last = is_over_.load();
      const std::uint64_t end = told_.load(std::memory_order_acquire);
      std::uint64_t at = written_.load(std::memory_order_relaxed);
      while (at < end) {
        const std::size_t size = ring_[at++ % kRing];
        std::uint8_t bytes[255];
        for (std::size_t i = 0; i < size; ++i) bytes[i] = ring_[at++ % kRing];
        take(bytes, size);
      }
      put_down();
      written_.store(at, std::memory_order_release);
      if (!is_last) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  void take(const std::uint8_t* bytes, std::size_t size) {
    const auto mark = static_cast<Mark>(bytes[0]);
    if (mark == Mark::Record) {
      records_.insert(records_.end(), bytes + 1, bytes + size);
      const std::size_t uid = bytes[7] | std::size_t{bytes[8]} << 8U;
      if (uid < status_.size()) status_[uid] = bytes[9];
      tick_.push_back(bytes[0]);
      return;
    }
    if (mark == Mark::TickBegins || mark == Mark::WokenUp) {
      spill();
      tick_begin_.assign(bytes, bytes + size);
      is_whole_ = mark == Mark::TickBegins;
      is_in_tick_ = true;
      return;
    }
    if (mark == Mark::TickEnds && is_in_tick_) {
      end_of_tick(bytes, size);
      return;
    }
    if (mark == Mark::Entry || mark == Mark::Lost || mark == Mark::TickIsLeft) {
      is_whole_ = false;
    }
    tick_.insert(tick_.end(), bytes, bytes + size);
  }

  // A tick like the one before is told in a few bytes.
  void end_of_tick(const std::uint8_t* bytes, std::size_t size) {
    is_in_tick_ = false;
    const std::uint8_t answer = bytes[size - 1];
    if (is_whole_ && !tick_begin_.empty() && tick_ == last_tick_ &&
        answer == last_answer_ && !tick_.empty()) {
      marks_.push_back(static_cast<std::uint8_t>(Mark::SameTick));
      marks_.insert(marks_.end(), tick_begin_.begin() + 1, tick_begin_.end());
      marks_.insert(marks_.end(), bytes + 1, bytes + size - 1);
    } else {
      marks_.insert(marks_.end(), tick_begin_.begin(), tick_begin_.end());
      marks_.insert(marks_.end(), tick_.begin(), tick_.end());
      marks_.insert(marks_.end(), bytes, bytes + size);
      const bool can_come_again = is_whole_ && !tick_begin_.empty();
      if (can_come_again) {
        last_tick_ = tick_;
        last_answer_ = answer;
      } else {
        last_tick_.clear();
      }
    }
    tick_.clear();
    tick_begin_.clear();
    if (size_ + marks_.size() + records_.size() > heading_.most_bytes) turn();
  }

  // What stands between two ticks, or of a tick that has not ended yet.
  void spill() {
    if (tick_begin_.empty() && tick_.empty()) return;
    marks_.insert(marks_.end(), tick_begin_.begin(), tick_begin_.end());
    marks_.insert(marks_.end(), tick_.begin(), tick_.end());
    tick_.clear();
    tick_begin_.clear();
    last_tick_.clear();
    is_whole_ = false;
  }

  void put_down() {
    spill();
    if (marks_.empty() && records_.empty()) return;
    size_ += marks_.size() + records_.size();
    put_into(log_.get(), records_);
    put_into(mark_file_.get(), marks_);
  }
  static void put_into(std::FILE* file, std::vector<std::uint8_t>& bytes) {
    if (file != nullptr && !bytes.empty()) {
      std::fwrite(bytes.data(), 1, bytes.size(), file);
      std::fflush(file);
    }
    bytes.clear();
  }

  // The next file begins where this one ends: with the statuses as they are.
  void turn() {
    put_down();
    close();
    ++number_;
    open();
    for (std::size_t uid = 1; uid < status_.size(); ++uid) {
      if (status_[uid] == 0) continue;
      add_bytes(records_, 0, 6);
      add_bytes(records_, uid, 2);
      records_.push_back(status_[uid]);
      marks_.push_back(static_cast<std::uint8_t>(Mark::Before));
    }
  }

  // robot.btlog, robot.2.btlog, …
  std::string name_of(std::size_t number) const {
    if (number == 1) return heading_.file;
    constexpr std::string_view kEnding = ".btlog";
    std::string stem = heading_.file;
    std::string ending;
    if (stem.size() > kEnding.size() &&
        stem.compare(stem.size() - kEnding.size(), kEnding.size(), kEnding) ==
            0) {
      stem.resize(stem.size() - kEnding.size());
      ending = kEnding;
    }
    return stem + "." + std::to_string(number) + ending;
  }

  struct Closing {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Closing>;

  void open() {
    const std::string name = name_of(number_);
    log_ = File(std::fopen(name.c_str(), "wb"));
    mark_file_ = File(std::fopen((name + ".marks").c_str(), "wb"));
    if (!log_ || !mark_file_) {
      if (number_ > 1) return;  // on the way nothing can be done about it
      throw std::runtime_error("btcheck: cannot write " + name);
    }
    const auto since_1970 =
        std::chrono::duration_cast<std::chrono::microseconds>(
            std::chrono::system_clock::now().time_since_epoch())
            .count() -
        since_begin();
    std::vector<std::uint8_t> bytes;
    const auto add_text = [&](std::string_view text) {
      bytes.insert(bytes.end(), text.begin(), text.end());
    };
    add_text("BTCPP4-FileLogger2");
    add_bytes(bytes, 1, 1);
    add_bytes(bytes, heading_.xml.size(), 4);
    add_text(heading_.xml);
    add_bytes(bytes, static_cast<std::uint64_t>(since_1970), 8);
    size_ = bytes.size();
    put_into(log_.get(), bytes);
    add_text(kMagic);
    add_bytes(bytes, kVersion, 1);
    add_bytes(bytes, static_cast<std::uint64_t>(heading_.engine), 1);
    add_bytes(bytes, static_cast<std::uint64_t>(since_1970), 8);
    add_bytes(bytes, monitor::fingerprint(heading_.xml), 8);
    add_number(bytes, heading_.entries.size());
    for (const std::string& entry : heading_.entries) {
      add_number(bytes, entry.size());
      add_text(entry);
    }
    size_ += bytes.size();
    put_into(mark_file_.get(), bytes);
    last_tick_.clear();
    files_.push_back(name);
    while (files_.size() > std::max<std::size_t>(heading_.most_files, 1)) {
      std::remove(files_.front().c_str());
      std::remove((files_.front() + ".marks").c_str());
      files_.pop_front();
    }
  }
  void close() {
    log_.reset();
    mark_file_.reset();
  }

  Heading heading_;
  std::vector<std::uint8_t> ring_;
  const Clock::time_point begin_;
  std::int64_t last_time_ = 0;  // of who tells
  bool has_lost_ = false;       // the same
  std::atomic<std::uint64_t> told_{0};
  std::atomic<std::uint64_t> written_{0};
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<bool> is_over_{false};

  // Of who writes.
  std::vector<std::uint8_t> tick_begin_;  // of the tick that goes on
  std::vector<std::uint8_t> tick_;        // and what was told since
  std::vector<std::uint8_t> last_tick_;   // of the tick before; none: empty
  std::uint8_t last_answer_ = 0;
  bool is_in_tick_ = false;
  bool is_whole_ = false;  // all of the tick is here, and can come again
  std::vector<std::uint8_t> marks_;
  std::vector<std::uint8_t> records_;
  std::vector<std::uint8_t> status_;  // by uid
  std::size_t size_ = 0;              // of the files
  std::size_t number_ = 1;
  std::deque<std::string> files_;
  File log_;
  File mark_file_;
  std::thread writer_;
};

}  // namespace btcheck
