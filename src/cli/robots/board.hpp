// SPDX-License-Identifier: MIT
//
// What is to be printed of robots: said by their threads, printed by one.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace btcheck {

class Board {
 public:
  struct Line {
    bool is_result = false;  // for standard output, else for the error
    std::string text;
  };

  // What came of it, and what goes on beside that.
  void result(std::string text) { put({true, std::move(text)}); }
  void remark(std::string text) { put({false, std::move(text)}); }

  // Those that have come, in order, after so long at the most.
  std::vector<Line> take(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    has_come_.wait_for(lock, patience, [this] { return !lines_.empty(); });
    return std::exchange(lines_, {});
  }

 private:
  void put(Line line) {
    {
      const std::lock_guard lock(mutex_);
      lines_.push_back(std::move(line));
    }
    has_come_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable has_come_;
  std::vector<Line> lines_;
};

}  // namespace btcheck
