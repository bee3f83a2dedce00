// SPDX-License-Identifier: MIT
#include "explore/large/run_merge.hpp"

#include <algorithm>
#include <utility>

#include "explore/store/in_parallel.hpp"

namespace btcheck {
namespace {

// Of one gathering: each is an open file.
constexpr std::size_t kMostRuns = 64;

constexpr std::uint64_t kWordsBetweenQuestions = std::uint64_t{1} << 20;

}  // namespace

std::size_t bytes_of(const Runs& runs) {
  std::size_t bytes = 0;
  for (const auto& run : runs) bytes += run->bytes();
  return bytes;
}

std::uint64_t bytes_on_disk_of(const Runs& runs) {
  std::uint64_t bytes = 0;
  for (const auto& run : runs) bytes += run->bytes_on_disk();
  return bytes;
}

RunMerge::RunMerge(std::span<const std::shared_ptr<const SortedRun>> runs) {
  for (const auto& run : runs) cursors_.emplace_back(*run);
  for (std::size_t i = 0; i < cursors_.size(); ++i) {
    if (!cursors_[i].is_at_end()) heads_.push({cursors_[i].word(), i});
  }
}

void RunMerge::pass_one() {
  const std::size_t run = heads_.top().run;
  heads_.pop();
  cursors_[run].advance();
  if (!cursors_[run].is_at_end()) heads_.push({cursors_[run].word(), run});
}

void Gathering::take(std::vector<Word>& words) {
  const std::size_t count = held_.size() + words.size();
  if (count > held_.capacity()) {
    held_.reserve(std::max(count, std::min(2 * count, most_held_)));
  }
  held_.insert(held_.end(), words.begin(), words.end());
  words.clear();
  if (held_.size() < most_held_) return;
  sort();
  // What was mostly the same words again may stay for another while.
  if (held_.size() > most_held_ / 2) spill();
}

RunMerge Gathering::merged() {
  sort();
  runs_.push_back(std::make_shared<SortedRun>(std::exchange(held_, {})));
  return RunMerge(runs_);
}

void Gathering::sort() {
  sort_in_parallel(held_);
  held_.erase(std::unique(held_.begin(), held_.end()), held_.end());
}

void Gathering::spill() {
  Scratch to_disk = scratch_;
  to_disk.words_in_memory = 0;
  if (runs_.size() == kMostRuns) {
    RunWriter writer(to_disk);
    for (RunMerge all(runs_); !all.is_at_end(); all.advance()) {
      writer.add(all.word());
    }
    runs_ = {std::make_shared<SortedRun>(writer.finish())};
  }
  RunWriter writer(to_disk);
  for (const Word word : held_) writer.add(word);
  runs_.push_back(std::make_shared<SortedRun>(writer.finish()));
  held_.clear();
}

void RunSet::add(std::shared_ptr<const SortedRun> run,
                 const std::function<bool()>& go_on) {
  if (run->size() == 0) return;
  runs_.push_back(std::move(run));
  while (runs_.size() > 1) {
    const auto last_two = std::span(runs_).last(2);
    if (last_two[0]->size() / 2 > last_two[1]->size()) break;
    RunWriter writer(scratch_);
    std::uint64_t count = 0;
    for (RunMerge merge(last_two); !merge.is_at_end(); merge.advance()) {
      if (++count % kWordsBetweenQuestions == 0 && !go_on()) return;
      writer.add(merge.word());
    }
    runs_.pop_back();
    runs_.back() = std::make_shared<SortedRun>(writer.finish());
  }
}

}  // namespace btcheck
