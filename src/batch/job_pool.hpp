// SPDX-License-Identifier: MIT
//
// Independent pieces of work, several at a time.
#pragma once

#include <cstddef>
#include <functional>

namespace btcheck {

// Calls work(i) for each i below `count`, up to `jobs` (1 or more) at a time;
// they begin in the order of their numbers. Returns when all have returned. The
// work may use threads of its own, and must not throw.
void run_jobs(std::size_t count, unsigned jobs,
              const std::function<void(std::size_t)>& work);

}  // namespace btcheck
