// SPDX-License-Identifier: MIT
//
// Many sorted runs as one, and words in any order made into sorted runs.
#pragma once

#include <functional>
#include <memory>
#include <queue>
#include <vector>

#include "explore/large/sorted_run.hpp"

namespace btcheck {

using Runs = std::vector<std::shared_ptr<const SortedRun>>;
std::size_t bytes_of(const Runs& runs);
std::uint64_t bytes_on_disk_of(const Runs& runs);

// Walks the words of several runs in ascending order, each word once. The runs
// must outlive it. Throws ScratchFault.
class RunMerge {
 public:
  explicit RunMerge(std::span<const std::shared_ptr<const SortedRun>> runs);

  bool is_at_end() const { return heads_.empty(); }
  Word word() const { return heads_.top().word; }
  void advance() {
    const Word passed = word();
    while (!is_at_end() && word() == passed) pass_one();
  }

 private:
  // The next word of one run.
  struct Head {
    Word word = 0;
    std::size_t run = 0;
    bool operator<(const Head& other) const { return word > other.word; }
  };

  void pass_one();

  std::vector<RunCursor> cursors_;
  std::priority_queue<Head> heads_;  // the least on top
};

// Takes words in any order and any number of times, and gives them back in
// ascending order, each once. When too many are held they go to disk, as a
// sorted run. Sorts on the threads of the present arena. Throws ScratchFault.
class Gathering {
 public:
  // So many words are held at most before some go to disk. `scratch` must
  // outlive it.
  Gathering(const Scratch& scratch, std::size_t most_held)
      : scratch_(scratch), most_held_(most_held) {}

  // Leaves `words` empty.
  void take(std::vector<Word>& words);
  // All that were taken. Nothing is taken after that.
  RunMerge merged();

  std::size_t bytes() const {
    return held_.capacity() * sizeof(Word) + bytes_of(runs_);
  }
  std::uint64_t bytes_on_disk() const { return bytes_on_disk_of(runs_); }

 private:
  void sort();
  void spill();

  const Scratch& scratch_;
  std::size_t most_held_;
  std::vector<Word> held_;
  Runs runs_;
};

// A set that grows by whole runs. Runs of about the same length are merged, so
// there are never many. Throws ScratchFault.
class RunSet {
 public:
  // `scratch` must outlive it.
  explicit RunSet(const Scratch& scratch) : scratch_(scratch) {}

  // None of the run's words may be in the set yet. `go_on` is asked now and
  // then; where it says no, the runs stay as they are.
  void add(std::shared_ptr<const SortedRun> run,
           const std::function<bool()>& go_on);

  // Asked in ascending order, as a RunCursor. The set must stay as it is.
  class Cursor {
   public:
    explicit Cursor(const RunSet& set) {
      for (const auto& run : set.runs_) cursors_.emplace_back(*run);
    }
    bool contains(Word word) {
      for (RunCursor& cursor : cursors_) {
        if (cursor.contains(word)) return true;
      }
      return false;
    }

   private:
    std::vector<RunCursor> cursors_;
  };

  std::size_t bytes() const { return bytes_of(runs_); }
  std::uint64_t bytes_on_disk() const { return bytes_on_disk_of(runs_); }

 private:
  const Scratch& scratch_;
  Runs runs_;  // the longest first
};

}  // namespace btcheck
