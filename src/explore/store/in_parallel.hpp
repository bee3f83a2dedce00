// SPDX-License-Identifier: MIT
//
// A loop whose rounds run side by side, and sorting, on the threads of the
// present arena.
#pragma once

#include <cstddef>
#include <vector>

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#include <thread>
#else
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#endif

namespace btcheck {

// Calls work(i) for each i below `count`, in any order and perhaps at once, and
// returns when all have returned. (ThreadSanitizer does not see how the
// installed TBB synchronises, and would report races: under it each round gets
// a thread of its own.)
template <class Work>
void in_parallel(std::size_t count, Work&& work) {
#ifdef __SANITIZE_THREAD__
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i) {
    threads.emplace_back([&work, i] { work(i); });
  }
  for (std::thread& thread : threads) thread.join();
#else
  tbb::parallel_for(
      std::size_t{0}, count, [&](std::size_t i) { work(i); },
      tbb::simple_partitioner());
#endif
}

// Into ascending order, on the threads of the present arena.
template <class Item>
void sort_in_parallel(std::vector<Item>& items) {
#ifdef __SANITIZE_THREAD__
  std::sort(items.begin(), items.end());
#else
  tbb::parallel_sort(items.begin(), items.end());
#endif
}

}  // namespace btcheck
