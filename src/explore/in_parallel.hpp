// SPDX-License-Identifier: MIT
//
// A loop whose rounds run side by side, on the threads of the present arena.
#pragma once

#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <thread>
#include <vector>
#else
#include <tbb/parallel_for.h>
#endif

namespace btcheck {

// Calls work(i) for each i below `count`, in any order and perhaps at once, and
// returns when all have returned. (The thread sanitizer does not see how the
// installed TBB synchronises, and would complain of that: it gets a thread for
// each round.)
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

}  // namespace btcheck
