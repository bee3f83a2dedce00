// SPDX-License-Identifier: MIT
//
// The threads of one search.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace btcheck {

// So many threads, more than there are cores where that is asked for. They
// start when they are first needed.
class SearchThreads {
 public:
  explicit SearchThreads(unsigned count);
  ~SearchThreads();

  // Calls work(i) for each of them, all at once.
  void each(const std::function<void(std::size_t)>& work);
  // Calls work() where it may use all of them.
  void execute(const std::function<void()>& work);

 private:
  struct Arena;

  unsigned count_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace btcheck
