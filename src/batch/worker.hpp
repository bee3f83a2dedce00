// SPDX-License-Identifier: MIT
//
// A process for each entry of a batch.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "cli/inputs/files.hpp"

namespace btcheck {

// A process that works on one entry: what takes too much memory, or meets a
// mistake of ours, ends alone. Its standard output is ours, so it writes to a
// pipe only.
class Worker {
 public:
  // What it does, and where it writes to.
  using Work = std::function<void(const OpenFile&)>;

  // Throws std::system_error where there is no process to be had. The batch has
  // no threads, so that everything is whole in the copy of it.
  Worker(std::size_t entry, const Work& work);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  std::size_t entry() const { return entry_; }
  int output() const { return output_.number(); }
  const std::string& text() const { return text_; }

  // Asks it to end soon.
  void cancel();
  // Takes what it has written; false at the end.
  bool read();
  // Waits for it. The signal that has ended it, or 0.
  int end();

 private:
  Worker(std::size_t entry, const Work& work, std::array<int, 2> ends);

  std::size_t entry_;
  pid_t process_ = -1;
  OpenFile output_;
  bool is_cancelled_ = false;
  std::string text_;
};

}  // namespace btcheck
