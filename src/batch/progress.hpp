// SPDX-License-Identifier: MIT
//
// How far a batch is, on stderr: one line that is rewritten on a terminal, a
// line now and then on a pipe.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "cli/inputs/progress.hpp"

namespace btcheck {

// Every member may be called by several threads at once.
class BatchProgress {
 public:
  BatchProgress(ProgressStyle style, std::size_t entries);
  ~BatchProgress();
  BatchProgress(const BatchProgress&) = delete;
  BatchProgress& operator=(const BatchProgress&) = delete;

  // An entry begins, and is done.
  void begin(std::size_t entry, const std::string& name);
  void end(std::size_t entry);
  // Now is a time to say something, if it is long since the last one.
  void observe();
  // Prints something else, with no line of progress in its way.
  void print(const std::function<void()>& what);

  double seconds() const;

 private:
  struct Running {
    std::string name;
    double since = 0;
  };

  void tell();
  void clear();
  std::string line(double now) const;

  ProgressStyle style_;
  std::size_t entries_;
  std::chrono::steady_clock::time_point start_;
  std::size_t done_ = 0;
  std::map<std::size_t, Running> running_;
  double next_line_;
  bool has_line_ = false;
  std::mutex mutex_;
};

}  // namespace btcheck
