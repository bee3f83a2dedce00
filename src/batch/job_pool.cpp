// SPDX-License-Identifier: MIT
//
// As many loops as there are jobs, each of which takes the next number. TBB
// would rather have the whole range, and split it; then the last numbers would
// begin before the first are done, and a batch that tells its results in order
// would have nothing to tell for long.
#include "batch/job_pool.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace btcheck {

void run_jobs(std::size_t count, unsigned jobs,
              const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  const auto loop = [&] {
    for (std::size_t i; (i = next.fetch_add(1)) < count;) work(i);
  };
  if (jobs <= 1 || count <= 1) return loop();
  // More than there are cores, if that is asked for.
  constexpr auto kMost = tbb::global_control::max_allowed_parallelism;
  const std::size_t threads =
      std::max<std::size_t>(jobs, tbb::global_control::active_value(kMost));
  const tbb::global_control control(kMost, threads);
  tbb::task_arena arena(static_cast<int>(jobs));
  arena.execute([&] {
    tbb::parallel_for(
        0u, jobs, [&](unsigned) { loop(); }, tbb::simple_partitioner());
  });
}

}  // namespace btcheck
