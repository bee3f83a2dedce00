// SPDX-License-Identifier: MIT
#include "explore/store/search_threads.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "explore/store/in_parallel.hpp"

namespace btcheck {

struct SearchThreads::Arena {
  explicit Arena(unsigned count)
      : parallelism(tbb::global_control::max_allowed_parallelism, count),
        arena(static_cast<int>(count)) {}

  tbb::global_control parallelism;
  tbb::task_arena arena;
};

SearchThreads::SearchThreads(unsigned count)
    : count_(count), arena_(std::make_unique<Arena>(count)) {}

SearchThreads::~SearchThreads() = default;

void SearchThreads::each(const std::function<void(std::size_t)>& work) {
  execute([&] { in_parallel(count_, work); });
}

void SearchThreads::execute(const std::function<void()>& work) {
  arena_->arena.execute(work);
}

}  // namespace btcheck
