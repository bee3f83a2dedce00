// SPDX-License-Identifier: MIT
//
// No log says where a tick begins. Within one, changes follow one another in
// microseconds, and executors pause for 10 ms or more between two: a pause is
// as good a mark as there is, and the text calls it by its time, not a tick.
#include "trace/logs/behavior_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// As many as a log may have between two records: its clock may be wrong.
constexpr std::int64_t kMostTicks = 1'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

// However long a name and however deep a tree, a line stays a line.
constexpr std::size_t kLongestShown = 40;
constexpr std::size_t kDeepest = 20;

std::string shown(const std::string& name) {
  return shortened(one_line(name), kLongestShown);
}

std::string name_of(const LogNode& node) {
  return shown(node.name.empty() ? node.type : node.name);
}

std::string date(std::int64_t time) {
  std::int64_t second = time / kSecond;
  std::int64_t rest = time % kSecond;
  if (rest < 0) {
    rest += kSecond;
    --second;
  }
  const auto stamp = static_cast<std::time_t>(second);
  std::tm parts{};
  if (gmtime_r(&stamp, &parts) == nullptr) return fmt::format("{} us", time);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}.{:06} UTC",
                     parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                     parts.tm_hour, parts.tm_min, parts.tm_sec, rest);
}

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

class Teller {
 public:
  Teller(const BehaviorLog& log, const LogReading& reading)
      : log_(log),
        is_ours_(is_own(log)),
        pause_(reading.tick_gap.value_or(kTickPause)) {}

  std::string tell() {
    tell_heading();
    tell_tree();
    if (log_.marks) {
      each_mark(*log_.marks,
                [&](const LogMark& mark) { tell_mark(mark, *log_.marks); });
      return std::move(text_);
    }
    const LogTransition* before = nullptr;
    for (const LogTransition& change : log_.transitions) {
      if (before == nullptr || is_new_tick(before->time, change.time)) {
        text_ += is_ours_
                     ? fmt::format("\ntick {}\n", change.time / kTickTime)
                     : fmt::format("\nafter {} s\n", seconds_text(change.time));
      }
      tell_change(change);
      before = &change;
    }
    return std::move(text_);
  }

 private:
  bool is_new_tick(std::int64_t before, std::int64_t now) const {
    return is_ours_ ? before / kTickTime != now / kTickTime
                    : now - before >= pause_ || now < before;
  }

  void tell_mark(const LogMark& mark, const LogMarks& marks) {
    switch (mark.kind) {
      case MarkKind::TickBegins:
      case MarkKind::TickIsWoken:
        text_ += fmt::format(
            "\ntick {}, after {} s{}\n", ++tick_, seconds_text(mark.time),
            mark.kind == MarkKind::TickIsWoken ? ", woken up" : "");
        break;
      case MarkKind::TickEnds:
        text_ += fmt::format("  [{}]       = {}\n", seconds_text(mark.time),
                             status_word(mark.status));
        break;
      case MarkKind::TickIsLeft:
        text_ += fmt::format("  [{}]       left by an exception: {}\n",
                             seconds_text(mark.time),
                             shown(marks.texts[mark.number]));
        break;
      case MarkKind::Record:
        tell_change(log_.transitions[told_++]);
        break;
      case MarkKind::WasBefore:
        text_ += fmt::format("  {} was {}\n",
                             name_of(*log_.find(log_.transitions[told_].uid)),
                             status_word(log_.transitions[told_].after));
        ++told_;
        break;
      case MarkKind::Entry:
        text_ += fmt::format(
            "  {} := {}\n", shown(marks.entries[mark.number]),
            shown(marks.texts[static_cast<std::size_t>(mark.time)]));
        break;
      case MarkKind::NodeAnswers:
        if (mark.status == LogStatus::Skipped) {
          text_ += fmt::format("  {:5} {} is skipped\n", mark.uid,
                               name_of(*log_.find(mark.uid)));
        }
        break;
      case MarkKind::NodeBegins:
      case MarkKind::TickAgain:  // has come as the marks of its tick
      case MarkKind::End:
      case MarkKind::Lost:
        break;
    }
  }

  static std::string_view status_word(LogStatus status) {
    return kLogStatusNames[static_cast<std::size_t>(status)];
  }

  void tell_heading() {
    const std::string source =
        log_.topic.empty() ? fmt::format("BehaviorTree.CPP {}", log_.version)
                           : "ROS 2, " + shown(log_.topic);
    text_ =
        fmt::format("{}: {}, {}", source, counted(log_.nodes.size(), "node"),
                    counted(log_.transitions.size(), "change"));
    text_ += is_ours_ ? ", written by btcheck\n\n"
                      : fmt::format(", from {}\n\n", date(log_.begin));
  }

  void tell_tree() {
    for (const LogNode& node : log_.nodes) {
      const std::string name = name_of(node);
      const std::string type = shown(node.type);
      text_ += fmt::format("{:5} {:{}}{}", node.uid, "",
                           2 * std::min(node.depth, kDeepest), name);
      if (name != type) text_ += fmt::format(" ({})", type);
      text_ += '\n';
      widest_ = std::max(widest_, letter_count(name));
    }
  }

  void tell_change(const LogTransition& change) {
    const std::string name = name_of(*log_.find(change.uid));
    const std::string time =
        is_ours_ ? "" : fmt::format("[{}] ", seconds_text(change.time));
    text_ +=
        fmt::format("  {}{:5} {}{:{}}  {:>7} -> {}\n", time, change.uid, name,
                    "", widest_ - letter_count(name),
                    kLogStatusNames[static_cast<std::size_t>(change.before)],
                    kLogStatusNames[static_cast<std::size_t>(change.after)]);
  }

  const BehaviorLog& log_;
  const bool is_ours_;
  const std::int64_t pause_;
  std::size_t widest_ = 0;  // name
  std::size_t told_ = 0;    // records
  int tick_ = 0;
  std::string text_;
};

}  // namespace

bool is_own(const BehaviorLog& log) {
  return log.version == 4 && log.begin == kLogBegin;
}

std::int64_t TickCounter::tick_at(std::int64_t time) {
  const std::int64_t before = tick_;
  if (is_own_) {
    tick_ = std::max({tick_, std::int64_t{1}, time / kTickTime});
  } else if (tick_ == 0) {
    tick_ = 1;
  } else if (time - last_ >= pause_) {
    const std::int64_t apart =
        is_counted_ ? (time - begin_ + tick_time_ / 2) / tick_time_ : 1;
    tick_ += std::clamp(apart, std::int64_t{1}, kMostTicks);
  }
  if (tick_ != before) begin_ = time;
  last_ = time;
  return tick_;
}

std::vector<std::int64_t> ticks_of(const BehaviorLog& log,
                                   const LogReading& reading) {
  std::vector<std::int64_t> ticks;
  if (!log.marks) {
    TickCounter counter(log, reading);
    for (const LogTransition& record : log.transitions) {
      ticks.push_back(counter.tick_at(record.time));
    }
    return ticks;
  }
  std::int64_t tick = 0;
  each_mark(*log.marks, [&](const LogMark& mark) {
    if (begins_tick(mark)) ++tick;
    if (is_record(mark)) ticks.push_back(std::max(tick, std::int64_t{1}));
  });
  return ticks;
}

std::string seconds_text(std::int64_t time) {
  const std::uint64_t size = time < 0 ? 0 - static_cast<std::uint64_t>(time)
                                      : static_cast<std::uint64_t>(time);
  return fmt::format("{}{}.{:06}", time < 0 ? "-" : "", size / kSecond,
                     size % kSecond);
}

std::string log_text(const BehaviorLog& log, const LogReading& reading) {
  return Teller(log, reading).tell();
}

}  // namespace btcheck
