// SPDX-License-Identifier: MIT
#include "cli/inputs/watch.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/memory.hpp"

namespace btcheck {
namespace {

// What a search may hold. The limit is for the whole process, which held the
// program and the inputs before the first search. A search gets at least half.
std::uint64_t search_limit(const Options& options) {
  static const std::uint64_t before = peak_bytes();
  const std::uint64_t limit = memory_limit(options);
  return std::max(limit / 2, limit - std::min(limit, before));
}

}  // namespace

std::uint64_t memory_limit(const Options& options) {
  if (options.max_bytes != 0) return options.max_bytes;
  return available_memory().bytes / 4 * 3;
}

ProgressStyle progress_style(const Options& options) {
  if (options.is_quiet) return ProgressStyle::Silent;
  return ::isatty(STDERR_FILENO) != 0 ? ProgressStyle::Rewritten
                                      : ProgressStyle::Lines;
}

Watch::Watch(const Options& options)
    : monitor(progress_style(options), options.timeout, memory_limit(options)),
      limits{options.max_states, search_limit(options), &monitor} {
  if (!options.is_verbose || options.is_quiet || options.max_bytes != 0) return;
  fmt::print(stderr, "--memory {}M: three quarters of what {} has\n",
             memory_limit(options) >> 20, available_memory().whose);
}

CheckOptions check_options(const Options& options, const Limits& limits) {
  return {
      options.ticks,
      {options.search, options.reduce, options.threads, {options.scratch_dir}},
      options.assume,
      limits};
}

bool can_use_disk(const Options& options) {
  const std::string& folder = options.scratch_dir;
  if (folder.empty()) return true;
  std::string complaint = make_directory(folder);
  try {
    if (complaint.empty()) ScratchFile trial(folder);
  } catch (const ScratchFault& fault) {
    complaint = fmt::format("--on-disk: {}", fault.what());
  }
  if (!complaint.empty()) complain("BT0004", complaint);
  return complaint.empty();
}

std::uint64_t peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace btcheck
