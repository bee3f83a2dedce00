// SPDX-License-Identifier: MIT
#include "cli/robots/robot_teller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck {
namespace {

// What is told may be so late before that is said, and said again.
constexpr std::chrono::seconds kBehind{2};
constexpr std::chrono::seconds kWarnAgain{10};

const std::string& name_of(const LogNode& node) {
  return node.name.empty() ? node.type : node.name;
}

// As `trace --prop` writes it.
std::string line_of(const LiveVerdict& rule) {
  std::string line =
      verdict_line(rule.verdict, rule.name, rule.moment, rule.is_expected);
  if (rule.verdict == "VIOLATED") {
    line += fmt::format("{:11}{}\n", "", rule.text);
  }
  return line;
}

std::string totals_of(const std::vector<LiveVerdict>& rules) {
  std::array<std::size_t, 4> counts{};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = static_cast<std::size_t>(
        std::ranges::count(rules, kOutlookNames[i], &LiveVerdict::verdict));
  }
  return rule_totals(counts);
}

}  // namespace

RobotTeller::RobotTeller(const groot2::Address& address, const WatchPlan& plan,
                         std::vector<LiveRules> rules, Board& board,
                         std::function<void(LiveRun&)> show)
    : address_(address),
      plan_(plan),
      board_(board),
      show_(std::move(show)),
      injected_(plan.following.faults.size(), 0),
      stood_(plan.following.faults.size()),
      thread_([this] { work(); }) {
  if (!show_ && rules.empty()) return;
  log_.emplace("groot2://" + address_.text(), plan_.reading, "",
               std::move(rules));
  log_->forget();
  std::string words = "a robot that runs, asked by its Groot2 publisher";
  for (const groot2::Fault& fault : plan_.following.faults) {
    words += fmt::format(
        "; {}{}", fault.is_break ? "it stops at " : "on purpose, ", fault.text);
  }
  log_->say(std::move(words));
}

void RobotTeller::later(std::function<void()> work) {
  const Clock::time_point now = Clock::now();
  std::chrono::duration<double> behind{};
  {
    const std::lock_guard lock(mutex_);
    queue_.emplace_back(now, std::move(work));
    behind = now - queue_.front().first;
  }
  has_work_.notify_all();
  if (behind < kBehind || now - warned_ < kWarnAgain) return;
  warned_ = now;
  board_.remark(fmt::format(
      "groot2://{}: what is told is {:.1f} s behind: the robot is faster than "
      "its rules and pages are\n",
      address_.text(), behind.count()));
}

void RobotTeller::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    has_work_.wait(lock, [this] { return is_closed_ || !queue_.empty(); });
    if (queue_.empty()) return;
    // It stands in the queue until it is done: it says how far behind we are.
    const auto work = std::move(queue_.front().second);
    lock.unlock();
    work();
    lock.lock();
    queue_.pop_front();
  }
}

void RobotTeller::close() {
  if (!thread_.joinable()) return;
  if (was_met_) {
    later([this, why = last_words_] {
      if (log_) log_->end(why);
    });
  }
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  has_work_.notify_all();
  thread_.join();
}

// Where there are several, each says which it is.
std::string RobotTeller::named(std::string_view text) const {
  if (plan_.robots == 1) return std::string(text);
  std::string lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines += fmt::format("{}: {}", address_.text(), text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

std::string RobotTeller::node_named(std::uint16_t uid) const {
  const auto node = std::ranges::find(nodes_, uid, &LogNode::uid);
  return node == nodes_.end() ? std::to_string(uid) : name_of(*node);
}

void RobotTeller::waits(std::string_view why) {
  lost_ = Clock::now();
  const std::string after =
      recording_ == 0 ? "" : fmt::format(", after {} s", seconds_text(time_));
  board_.remark(fmt::format("groot2://{}: {}{}; waiting for it\n",
                            address_.text(), why, after));
}

void RobotTeller::is_back() {
  const std::chrono::duration<double> away = Clock::now() - lost_;
  board_.remark(fmt::format("groot2://{}: it answers, after {:.1f} s\n",
                            address_.text(), away.count()));
}

std::vector<Diagnostic> RobotTeller::begins(
    const BehaviorLog& log, const groot2::EntryValues& entries) {
  ++recording_;
  records_ = log.transitions.size();
  time_ = 0;
  std::string words = fmt::format("groot2://{}: {}, {}", address_.text(),
                                  log.tree.empty() ? "a tree" : log.tree,
                                  counted(log.nodes.size(), "node", "nodes"));
  if (!log.transitions.empty()) {
    words += fmt::format("; in the middle of a run, {} at work",
                         counted(log.transitions.size(), "node", "nodes"));
  }
  if (!plan_.output.empty()) {
    std::string word = plan_.robots == 1 ? "" : address_.text();
    std::ranges::replace_if(
        word, [](char c) { return !is_letter(c) && !is_digit(c) && c != '.'; },
        '_');
    keep(file_.begin(recording_name(plan_.output, word, recording_), log));
    if (complaint_.empty()) words += "; recorded to " + file_.name();
  }
  board_.remark(words + "\n");
  // Whether its rules can be asked of it is known at the first recording.
  if (!was_met_) {
    auto found = begin_log(log, entries);
    was_met_ = !has_error(found);
    return found;
  }
  later([this, log, entries] { begin_log(log, entries); });
  return {};
}

std::vector<Diagnostic> RobotTeller::begin_log(
    const BehaviorLog& log, const groot2::EntryValues& entries) {
  told_.clear();
  nodes_ = log.nodes;
  widest_ = 0;
  for (const LogNode& node : nodes_) {
    widest_ = std::max(widest_, name_of(node).size());
  }
  std::vector<Diagnostic> found;
  if (log_) {
    log_->know(entries);
    found = log_->begin(log);
    if (has_error(found)) return found;
    if (show_) std::exchange(show_, {})(log_->run());
    tell_verdicts();
  }
  if (plan_.tells_records) tell_records(log.transitions);
  return found;
}

void RobotTeller::goes_on(std::span<const LogTransition> records) {
  keep(file_.add(records));
  records_ += records.size();
  time_ = records.back().time;
  if (!log_ && !plan_.tells_records) return;
  later([this,
         more = std::vector<LogTransition>(records.begin(), records.end())] {
    if (log_) {
      log_->add(more, detail_for(more.size()));
      tell_verdicts();
    }
    if (plan_.tells_records) tell_records(more);
  });
}

// A page takes so much in a second. A robot that is faster is shown as it is
// when it has been asked, and not with all that it did since.
LiveLog::Shown RobotTeller::detail_for(std::size_t records) {
  constexpr double kCellsInASecond = 400'000;
  constexpr double kStatesOfARecord = 2.5;
  if (!plan_.is_shown) return LiveLog::Shown::Nothing;
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> passed = now - shown_;
  shown_ = now;
  cells_ = std::min(cells_ + kCellsInASecond * passed.count(), kCellsInASecond);
  const double cost = kStatesOfARecord * static_cast<double>(records) *
                      static_cast<double>(nodes_.size());
  if (cost > cells_) return LiveLog::Shown::Last;
  cells_ -= cost;
  return LiveLog::Shown::Each;
}

void RobotTeller::knows_entries(const groot2::EntryValues& entries) {
  if (log_) later([this, entries] { log_->know(entries); });
}

// Each when it is decided; those that stay open at the end.
void RobotTeller::tell_verdicts() {
  const auto& verdicts = log_->verdicts();
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const LiveVerdict& now = verdicts[i];
    const bool is_told = i < told_.size() && told_[i].verdict == now.verdict;
    if (is_told || now.verdict == "OPEN") continue;
    board_.result(named(line_of(now)));
  }
  told_ = verdicts;
}

void RobotTeller::tell_records(std::span<const LogTransition> records) {
  std::string text;
  for (const LogTransition& record : records) {
    const auto status = [](LogStatus one) {
      return kLogStatusNames[static_cast<std::size_t>(one)];
    };
    text +=
        fmt::format("[{}] {:5} {:{}}  {:>7} -> {}\n", seconds_text(record.time),
                    record.uid, node_named(record.uid), widest_,
                    status(record.before), status(record.after));
  }
  if (!text.empty()) board_.result(named(text));
}

void RobotTeller::ends(std::string_view why) {
  last_words_ = why;
  const std::string words =
      fmt::format("{} in {} s; {}", counted(records_, "record", "records"),
                  seconds_text(time_), why);
  later([this, words] {
    if (log_) {
      log_->close();
      tell_verdicts();
      if (log_->is_broken()) is_broken_ = true;
    }
    if (told_.empty()) {
      return board_.remark(
          fmt::format("groot2://{}: {}\n", address_.text(), words));
    }
    std::string text =
        fmt::format("\ngroot2://{}: {}, {}\n", address_.text(),
                    counted(nodes_.size(), "node", "nodes"), words);
    for (const LiveVerdict& rule : told_) text += line_of(rule);
    board_.result(text + totals_of(told_));
  });
  if (is_over_) return;
  board_.remark(fmt::format(
      "warning[{}]: the recording of groot2://{} has ended: {}\n"
      "  = help: what comes next is another one, and rules begin anew\n",
      "BT1904", address_.text(), why));
}

void RobotTeller::is_injected(std::size_t fault) {
  const auto& told = plan_.following.faults[fault];
  ++injected_[fault];
  // One that answers always does so in each tick.
  if (!told.is_once && injected_[fault] > 1) return;
  board_.remark(fmt::format("groot2://{}: injected `{}` after {} s\n",
                            address_.text(), told.text, seconds_text(time_)));
}

void RobotTeller::stands_at(std::size_t fault) {
  const auto& told = plan_.following.faults[fault];
  stood_[fault] = {Clock::now(), lets_};
  ++standing_;
  board_.remark(fmt::format(
      "groot2://{}: stands at `{}` after {} s{}\n", address_.text(), told.node,
      seconds_text(time_),
      plan_.break_time ? fmt::format(", for {} ms", plan_.break_time->count())
                       : std::string("; Enter lets it go on")));
}

bool RobotTeller::may_go_on(std::size_t fault) {
  const auto& [since, lets] = stood_[fault];
  const bool may = plan_.break_time ? Clock::now() - since >= *plan_.break_time
                                    : lets_ != lets;
  if (may) --standing_;
  return may;
}

// A file that cannot be written ends it all.
void RobotTeller::keep(std::string why) {
  if (why.empty() || !complaint_.empty()) return;
  complaint_ = std::move(why);
  is_over_ = true;
}

}  // namespace btcheck
