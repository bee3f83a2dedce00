// SPDX-License-Identifier: MIT
#include "batch/progress.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr double kRewriteInterval = 0.2;
constexpr std::size_t kWidth = 79;

}  // namespace

BatchProgress::BatchProgress(ProgressStyle style, std::size_t entries)
    : style_(style),
      entries_(entries),
      start_(std::chrono::steady_clock::now()),
      next_line_(style == ProgressStyle::Lines ? 1 : 0.1) {}

BatchProgress::~BatchProgress() { clear(); }

void BatchProgress::begin(std::size_t entry, const std::string& name) {
  const std::lock_guard lock(mutex_);
  running_[entry] = {one_line(name), seconds()};
  tell();
}

void BatchProgress::end(std::size_t entry) {
  const std::lock_guard lock(mutex_);
  running_.erase(entry);
  ++done_;
  tell();
}

void BatchProgress::observe() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock.owns_lock()) tell();
}

void BatchProgress::print(const std::function<void()>& what) {
  const std::lock_guard lock(mutex_);
  clear();
  what();
}

double BatchProgress::seconds() const {
  const auto now = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(now - start_).count();
}

void BatchProgress::clear() {
  if (has_line_) fmt::print(stderr, "\r\x1b[K");
  has_line_ = false;
}

// "12 of 200 entries in 3 s; now drone3.ltl (2 s), nav2.ltl (1 s)"
std::string BatchProgress::line(double now) const {
  std::string text =
      fmt::format("{} of {} entries in {:.0f} s", done_, entries_, now);
  const char* before = "; now ";
  for (const auto& [entry, running] : running_) {
    text += fmt::format("{}{} ({:.0f} s)", before, running.name,
                        now - running.since);
    before = ", ";
  }
  return shortened(text, kWidth);
}

void BatchProgress::tell() {
  const double now = seconds();
  if (style_ == ProgressStyle::Silent || now < next_line_) return;
  if (style_ == ProgressStyle::Rewritten) {
    fmt::print(stderr, "\r{}\x1b[K", line(now));
    has_line_ = true;
    next_line_ = now + kRewriteInterval;
  } else {
    fmt::print(stderr, "{}\n", line(now));
    next_line_ = next_line_after(now);
  }
  std::fflush(stderr);
}

}  // namespace btcheck
