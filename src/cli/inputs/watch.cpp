// SPDX-License-Identifier: MIT
//
// A search asks the monitor now and then; between two questions nothing
// happens here, so a search costs the same with and without one.
#include "cli/inputs/watch.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <vector>

#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/memory.hpp"
#include "explore/components/component_store.hpp"

namespace btcheck {
namespace {

constexpr double kTellInterval = 1;
constexpr double kRateWindow = 10;
// What a search may hold. The limit is for the whole process, which held the
// program and the inputs before the first search. A search gets at least half.
std::uint64_t search_limit(const Options& options) {
  static const std::uint64_t before = peak_bytes();
  const std::uint64_t limit = memory_limit(options);
  return std::max(limit / 2, limit - std::min(limit, before));
}

}  // namespace

double next_line_after(double now) {
  for (const double at : {1.0, 2.0, 5.0, 10.0, 30.0, 60.0}) {
    if (now < at) return at;
  }
  return (std::floor(now / 60) + 1) * 60;
}

CommandMonitor::CommandMonitor(ProgressStyle style, ProcessLimits& limits,
                               std::uint64_t max_bytes)
    : shown_(style, 0.1), max_bytes_(max_bytes), limits_(limits) {}

void ProgressLine::write(const std::string& text, double now) {
  is_there_ = style_ == ProgressStyle::Rewritten;
  tell_exactly(fmt::format(fmt::runtime(is_there_ ? "\r{}\x1b[K" : "{}\n"),
                           readable(text)));
  next_ = is_there_ ? now + kRewriteInterval : next_line_after(now);
}

void ProgressLine::clear() {
  if (is_there_) tell_exactly("\r\x1b[K");
  is_there_ = false;
}

std::string CommandMonitor::line(const SearchProgress& progress, double now) {
  const Sample& oldest = samples_.front();
  const double span = std::max(now - oldest.at, 1e-3);
  const std::uint64_t frontier = progress.states - progress.expanded;
  const char* trend = frontier > last_frontier_   ? "growing"
                      : frontier < last_frontier_ ? "shrinking"
                                                  : "steady";
  last_frontier_ = frontier;
  return fmt::format(
      "{:.0f} s  depth {}  {} states  {:.1f} M/s  frontier {} {}  {} of {} MB",
      now, progress.depth, progress.states,
      static_cast<double>(progress.expanded - oldest.expanded) / span / 1e6,
      frontier, trend, progress.bytes >> 20, max_bytes_ >> 20);
}

bool CommandMonitor::may_tell() { return limits_.may_tell(); }

bool CommandMonitor::has_spare() { return limits_.has_spare(); }

void CommandMonitor::found(const std::string& lines) {
  if (shown_.is_silent()) return;
  shown_.clear();
  btcheck::tell(lines);
}

StopReason CommandMonitor::observe(const SearchProgress& progress) {
  const StopReason reason = limits_.reached();
  if (reason != StopReason::None) return reason;
  const double now = seconds();
  if (listener_ && now >= next_told_) {
    next_told_ = now + kTellInterval;
    listener_(progress, now);
  }
  if (shown_.is_silent()) return StopReason::None;
  if (!samples_.empty() && progress.expanded < samples_.back().expanded) {
    samples_.clear();  // another search
  }
  if (samples_.empty() ||
      now - samples_.back().at >= ProgressLine::kRewriteInterval) {
    samples_.push_back({now, progress.expanded});
    while (now - samples_.front().at > kRateWindow) samples_.pop_front();
  }
  if (shown_.is_due(now)) shown_.write(line(progress, now), now);
  return StopReason::None;
}

std::uint64_t memory_limit(const Options& options) {
  if (options.max_bytes != 0) return options.max_bytes;
  return available_memory().bytes / 4 * 3;
}

unsigned threads_to_use(const Options& options) {
  std::atomic<bool> is_over = false;
  std::vector<std::jthread> trials;  // end before it does
  unsigned count = 1;                // this one
  const unsigned most = std::max(options.threads, core_count());
  try {
    for (; count < most; ++count) {
      trials.emplace_back([&is_over] { is_over.wait(false); });
    }
  } catch (const std::system_error&) {
    // TBB ends the program where it gets no thread: to the end it must not try.
    [[maybe_unused]] static const auto* const forever = new tbb::global_control(
        tbb::global_control::max_allowed_parallelism, count);
  }
  is_over = true;
  is_over.notify_all();
  return std::min(count, options.threads);
}

ProgressStyle progress_style(const Options& options) {
  if (options.is_quiet) return ProgressStyle::Silent;
  return ::isatty(STDERR_FILENO) != 0 && !is_dumb_terminal()
             ? ProgressStyle::Rewritten
             : ProgressStyle::Lines;
}

void allow(const Options& options) {
  limits_of_command().allow(options.timeout, memory_limit(options));
}

Watch::Watch(const Options& options)
    : monitor(progress_style(options), limits_of_command(),
              memory_limit(options)),
      limits{options.max_states, search_limit(options), &monitor} {
  allow(options);
  if (!options.is_verbose || options.is_quiet || options.max_bytes != 0) return;
  tell(fmt::format("--memory {}M: three quarters of what {} has\n",
                   memory_limit(options) >> 20, available_memory().whose));
}

CheckOptions check_options(const Options& options, const Limits& limits) {
  CheckOptions made{options.ticks,
                    {options.search,
                     options.reduce,
                     PartsUse::WhereLarge,
                     threads_to_use(options),
                     {options.scratch_dir}},
                    options.assume,
                    limits,
                    options.judgement,
                    options.tries_repairs};
  made.choices.components = ComponentStore::of_program();
  made.any_count = options.any_count;
  return made;
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

void tell_of_disk(const Options& options, StopReason stopped) {
  if (stopped != StopReason::Memory || options.scratch_dir.empty()) return;
  tell(
      "--on-disk: only `space` and rules about single states go on there, and "
      "the parts that states are made of stay in memory\n");
}

}  // namespace btcheck
