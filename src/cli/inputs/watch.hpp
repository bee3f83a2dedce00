// SPDX-License-Identifier: MIT
//
// What a search is given to work with: limits, a monitor that watches them, and
// a folder for what does not fit into memory.
#pragma once

#include <cstdint>

#include "check/check.hpp"
#include "cli/inputs/progress.hpp"
#include "cli/options/options.hpp"

namespace btcheck {

// Limits with a monitor behind them. It stays where it is made.
struct Watch {
  explicit Watch(const Options& options);

  Monitor monitor;
  Limits limits;
};

// The limit of --memory in bytes, else three quarters of what there is.
std::uint64_t memory_limit(const Options& options);

// How progress is shown on stderr.
ProgressStyle progress_style(const Options& options);

CheckOptions check_options(const Options& options, const Limits& limits);

// Whether the folder of --on-disk can be written to, if there is one. Complains
// when it cannot.
bool can_use_disk(const Options& options);

// The most memory the process has held so far.
std::uint64_t peak_bytes();

}  // namespace btcheck
