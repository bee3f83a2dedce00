// SPDX-License-Identifier: MIT
#include "explore/large/run_merge.hpp"

#include <algorithm>
#include <utility>

#include "explore/store/in_parallel.hpp"

namespace btcheck {
namespace {

std::vector<const SortedRun*> addresses(const std::vector<SortedRun>& runs) {
  std::vector<const SortedRun*> found;
  for (const SortedRun& run : runs) found.push_back(&run);
  return found;
}

// Of one gathering: each is an open file.
constexpr std::size_t kMostRuns = 64;

constexpr std::uint64_t kWordsBetweenQuestions = std::uint64_t{1} << 20;

}  // namespace

RunMerge::RunMerge(const std::vector<const SortedRun*>& runs) {
  for (const SortedRun* run : runs) cursors_.emplace_back(*run);
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
  runs_.emplace_back(std::exchange(held_, {}));
  return RunMerge(addresses(runs_));
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
    for (RunMerge all(addresses(runs_)); !all.is_at_end(); all.advance()) {
      writer.add(all.word());
    }
    runs_.clear();
    runs_.push_back(writer.finish());
  }
  RunWriter writer(to_disk);
  for (const Word word : held_) writer.add(word);
  runs_.push_back(writer.finish());
  held_.clear();
}

std::size_t Gathering::bytes() const {
  std::size_t bytes = held_.capacity() * sizeof(Word);
  for (const SortedRun& run : runs_) bytes += run.bytes();
  return bytes;
}

std::uint64_t Gathering::bytes_on_disk() const {
  std::uint64_t bytes = 0;
  for (const SortedRun& run : runs_) bytes += run.bytes_on_disk();
  return bytes;
}

void RunSet::add(std::shared_ptr<const SortedRun> run,
                 const std::function<bool()>& go_on) {
  if (run->size() == 0) return;
  runs_.push_back(std::move(run));
  while (runs_.size() > 1) {
    const auto& last = runs_.back();
    const auto& before = runs_[runs_.size() - 2];
    if (before->size() / 2 > last->size()) break;
    RunWriter writer(scratch_);
    std::uint64_t count = 0;
    for (RunMerge merge({before.get(), last.get()}); !merge.is_at_end();
         merge.advance()) {
      if (++count % kWordsBetweenQuestions == 0 && !go_on()) return;
      writer.add(merge.word());
    }
    runs_.pop_back();
    runs_.back() = std::make_shared<const SortedRun>(writer.finish());
  }
}

std::size_t RunSet::bytes() const {
  std::size_t bytes = 0;
  for (const auto& run : runs_) bytes += run->bytes();
  return bytes;
}

std::uint64_t RunSet::bytes_on_disk() const {
  std::uint64_t bytes = 0;
  for (const auto& run : runs_) bytes += run->bytes_on_disk();
  return bytes;
}

}  // namespace btcheck
