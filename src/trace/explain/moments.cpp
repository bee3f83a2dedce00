// SPDX-License-Identifier: MIT
#include "trace/explain/moments.hpp"

#include <algorithm>
#include <utility>

namespace btcheck {
namespace {

std::optional<Happening> happening_of(LogStatus before, LogStatus after) {
  switch (after) {
    case LogStatus::Success:
      return Happening::Success;
    case LogStatus::Failure:
      return Happening::Failure;
    case LogStatus::Running:
      return Happening::Running;
    case LogStatus::Skipped:
      return Happening::Skipped;
    case LogStatus::Idle:
      // That an answer is reset says nothing.
      if (before == LogStatus::Running) return Happening::Halted;
      break;
  }
  return std::nullopt;
}

bool is_end(Happening what) {
  return what == Happening::Success || what == Happening::Failure;
}

}  // namespace

// An answer is written twice in a log with marks: as such, and as a change of
// status, in either order. It is one moment.
class LogMoments::Reader {
 public:
  Reader(LogMoments& made, const BehaviorLog& log, const LoggedNodes& nodes)
      : made_(made), log_(log), nodes_(nodes) {}

  void read(const LogReading& reading) {
    if (log_.marks) {
      each_mark(*log_.marks, [&](const LogMark& mark) { take(mark); });
    } else {
      const std::vector<std::int64_t> ticks = ticks_of(log_, reading);
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        tick_ = ticks[i];
        take(log_.transitions[i]);
      }
    }
    made_.last_tick_ = tick_;
    if (!made_.is_left_) made_.open_.clear();
  }

 private:
  void take(const LogMark& mark) {
    switch (mark.kind) {
      case MarkKind::TickBegins:
      case MarkKind::TickIsWoken:
        ++tick_;
        time_ = mark.time;
        made_.open_.clear();
        made_.is_left_ = false;
        break;
      case MarkKind::TickIsLeft:
        made_.is_left_ = true;
        if (mark.number < log_.marks->texts.size()) {
          made_.exception_ = log_.marks->texts[mark.number];
        }
        break;
      case MarkKind::NodeBegins:
        made_.open_.push_back(nodes_.node(mark.uid));
        add(nodes_.node(mark.uid), Happening::Asked);
        break;
      case MarkKind::NodeAnswers:
        answer(mark);
        break;
      case MarkKind::Record:
        take(log_.transitions[record_]);
        break;
      case MarkKind::WasBefore:
        ++record_;
        break;
      case MarkKind::End:
      case MarkKind::TickEnds:
      case MarkKind::Entry:
      case MarkKind::TickAgain:
      case MarkKind::Lost:
        break;
    }
  }

  void answer(const LogMark& mark) {
    const NodeId node = nodes_.node(mark.uid);
    // What it has called has answered or was left out.
    const auto begun = std::ranges::find(made_.open_, node);
    made_.open_.erase(begun, made_.open_.end());
    const auto what = happening_of(LogStatus::Idle, mark.status);
    if (what) add_once(node, *what, true);
  }

  void take(const LogTransition& record) {
    ++record_;
    time_ = record.time;
    const auto what = happening_of(record.before, record.after);
    if (what) add_once(nodes_.node(record.uid), *what, false);
  }

  void add(NodeId node, Happening what) {
    made_.moments_.push_back({node, what, tick_, time_, record_});
  }

  void add_once(NodeId node, Happening what, bool is_answer) {
    if (last_.size() <= index(node)) last_.resize(index(node) + 1);
    Last& last = last_[index(node)];
    const bool is_same = last.what == what && last.tick == tick_ &&
                         last.is_answer != is_answer && !last.is_paired;
    if (is_same) {
      last.is_paired = true;
      made_.moments_[last.moment].records = record_;
      return;
    }
    last = {what, tick_, made_.moments_.size(), is_answer, false};
    add(node, what);
  }

  struct Last {
    std::optional<Happening> what;
    std::int64_t tick = 0;
    std::size_t moment = 0;
    bool is_answer = false;
    bool is_paired = false;
  };

  LogMoments& made_;
  const BehaviorLog& log_;
  const LoggedNodes& nodes_;
  std::vector<Last> last_;  // by node
  std::size_t record_ = 0;
  std::int64_t tick_ = 0;
  std::int64_t time_ = 0;
};

LogMoments::LogMoments(const BehaviorLog& log, const LoggedNodes& nodes,
                       const LogReading& reading)
    : knows_ticks_(btcheck::knows_ticks(log, reading)) {
  Reader(*this, log, nodes).read(reading);
  std::size_t count = 0;
  for (const LogNode& each : log.nodes) {
    count = std::max(count, index(nodes.node(each.uid)) + std::size_t{1});
  }
  children_.resize(count);
  moments_of_.resize(count);
  for (const LogNode& each : log.nodes) {
    const NodeId node = nodes.node(each.uid);
    if (each.parent) {
      children_[index(nodes.node(*each.parent))].push_back(node);
    } else if (!top_) {
      top_ = node;
    }
  }
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    moments_of_[index(moments_[i].node)].push_back(i);
  }
  part();
}

void LogMoments::part() {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    const Moment& moment = moments_[i];
    if (moment.node != top_ || !is_end(moment.what)) continue;
    missions_.push_back({begin, i + 1,
                         moment.what == Happening::Success ? Outcome::Success
                                                           : Outcome::Failure});
    begin = i + 1;
  }
  const bool goes_on = std::any_of(
      moments_.begin() + static_cast<std::ptrdiff_t>(begin), moments_.end(),
      [](const Moment& moment) { return moment.what != Happening::Halted; });
  if (goes_on || is_left_) {
    missions_.push_back({begin, moments_.size(),
                         is_left_ ? Outcome::Exception : Outcome::Running});
  }
  if (missions_.empty()) missions_.emplace_back();
}

std::vector<std::size_t> LogMoments::of(NodeId node, std::size_t begin,
                                        std::size_t end) const {
  const auto& all = moments_of_[index(node)];
  return {std::ranges::lower_bound(all, begin),
          std::ranges::lower_bound(all, end)};
}

std::optional<std::size_t> LogMoments::last_of(NodeId node, std::size_t begin,
                                               std::size_t end) const {
  const auto& all = moments_of_[index(node)];
  const auto behind = std::ranges::lower_bound(all, end);
  if (behind == all.begin() || *(behind - 1) < begin) return std::nullopt;
  return *(behind - 1);
}

BehaviorLog first_records(const BehaviorLog& log, std::size_t records) {
  BehaviorLog cut = log;
  if (records >= log.transitions.size()) return cut;
  cut.transitions.resize(records);
  if (!cut.marks) return cut;
  // A tick that comes again has its records again: all are written out.
  std::vector<LogMark> events;
  std::size_t seen = 0;
  each_mark(*log.marks, [&](const LogMark& mark) {
    if (seen == records) return;
    seen += is_record(mark) ? 1 : 0;
    events.push_back(mark);
  });
  cut.marks->events = std::move(events);
  return cut;
}

}  // namespace btcheck
