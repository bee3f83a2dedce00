// SPDX-License-Identifier: MIT
//
// What becomes of one robot that is watched: lines for the terminal, a run for
// a page, and files.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "cli/robots/board.hpp"
#include "cli/robots/log_file.hpp"
#include "groot2/robot.hpp"
#include "text/diagnostic.hpp"
#include "trace/live/live_log.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {

// The same for all robots.
struct WatchPlan {
  LogReading reading;
  std::string output;          // "" for none
  bool is_shown = false;       // on a page
  bool tells_records = false;  // where nothing else is told
  groot2::Following following;
  std::optional<std::chrono::milliseconds> break_time;
  std::size_t robots = 1;
};

class RobotTeller : public groot2::Listener {
 public:
  // `show` is called with the run, once it is there. All must outlive it.
  RobotTeller(const groot2::Address& address, const WatchPlan& plan,
              std::vector<LiveRules> rules, Board& board,
              std::function<void(LiveRun&)> show);
  ~RobotTeller() override { close(); }

  bool is_over() override { return is_over_; }
  void waits(std::string_view why) override;
  void is_back() override;
  std::vector<Diagnostic> begins(const BehaviorLog& log,
                                 const groot2::EntryValues& entries) override;
  void goes_on(std::span<const LogTransition> records) override;
  void knows_entries(const groot2::EntryValues& entries) override;
  void ends(std::string_view why) override;
  void is_injected(std::size_t fault) override;
  void stands_at(std::size_t fault) override;
  bool may_go_on(std::size_t fault) override;

  // Nothing follows: once the robot is not followed any longer. Waits until all
  // is told.
  void close();

  // By another thread: nobody wants to know more; and whoever stands goes on.
  void end() { is_over_ = true; }
  void let_go() { ++lets_; }
  bool stands() const { return standing_ > 0; }

  // Once nobody tells it anything any more.
  bool was_met() const { return was_met_; }
  bool is_broken() const { return is_broken_; }
  const std::string& complaint() const { return complaint_; }

 private:
  using Clock = std::chrono::steady_clock;

  // The robot is asked on, however long its rules and the page take: what they
  // are told waits in a queue, and is worked off by a thread.
  void later(std::function<void()> work);
  void work();
  std::vector<Diagnostic> begin_log(const BehaviorLog& log,
                                    const groot2::EntryValues& entries);

  LiveLog::Shown detail_for(std::size_t records);
  std::string named(std::string_view text) const;
  std::string node_named(std::uint16_t uid) const;
  void tell_verdicts();
  void tell_records(std::span<const LogTransition> records);
  void keep(std::string why);

  const groot2::Address address_;
  const WatchPlan& plan_;
  Board& board_;
  std::function<void(LiveRun&)> show_;
  std::atomic<bool> is_over_ = false;
  std::atomic<unsigned> lets_ = 0;
  std::atomic<int> standing_ = 0;

  // Of the thread that follows the robot.
  LogFile file_;
  int recording_ = 0;
  std::size_t records_ = 0;
  std::int64_t time_ = 0;                                      // of the last
  std::vector<std::size_t> injected_;                          // by fault
  std::vector<std::pair<Clock::time_point, unsigned>> stood_;  // by fault
  Clock::time_point lost_;
  Clock::time_point warned_;  // that the rules are behind
  std::string last_words_;
  std::string complaint_;

  // Of the thread that works.
  std::optional<LiveLog> log_;  // where rules are asked, or it is shown
  std::vector<LogNode> nodes_;
  std::vector<LiveVerdict> told_;
  std::size_t widest_ = 0;  // name
  Clock::time_point shown_ = Clock::now();
  double cells_ = 0;  // that may be shown

  std::atomic<bool> was_met_ = false;
  std::atomic<bool> is_broken_ = false;
  std::mutex mutex_;  // of these
  std::condition_variable has_work_;
  std::deque<std::pair<Clock::time_point, std::function<void()>>> queue_;
  bool is_closed_ = false;
  std::thread thread_;
};

}  // namespace btcheck
