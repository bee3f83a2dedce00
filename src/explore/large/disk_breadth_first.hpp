// SPDX-License-Identifier: MIT
//
// Reachability, breadth first, with the visited states on disk.
//
// Delayed duplicate detection (Korf, "Best-first frontier search with delayed
// duplicate detection", 2004; Stern and Dill, "Using magnetic disk instead of
// main memory in the Murphi verifier", 1998): the states a depth leads to are
// gathered and sorted, and a merge with the visited ones removes what is known.
// Memory holds only what is being gathered and the halves of the vectors.
// States, steps, depths and answers are those of ParallelBreadthFirst.
#pragma once

#include <atomic>
#include <cassert>
#include <deque>
#include <memory>
#include <vector>

#include "explore/large/pair_search.hpp"
#include "explore/large/run_merge.hpp"

namespace btcheck {

// Remembers some of the latest words, in little memory.
class RecentWords {
 public:
  RecentWords() : words_(std::size_t{1} << kBits, kNone) {}

  // Whether it surely was told of before. It is remembered.
  bool was_told(Word word) {
    constexpr Word kScatter = 0x9e3779b97f4a7c15;
    Word& slot = words_[(word * kScatter) >> (64 - kBits)];
    const bool was = slot == word;
    slot = word;
    return was;
  }

 private:
  static constexpr int kBits = 14;
  static constexpr Word kNone = ~Word{0};  // no pair: halves are fewer

  std::vector<Word> words_;
};

template <PairSystem System>
class DiskBreadthFirst {
 public:
  // System and limits must outlive the search.
  DiskBreadthFirst(System& system, const Limits& limits, unsigned threads,
                   const Scratch& scratch, KeepDepths keep = KeepDepths::No)
      : system_(system),
        limits_(limits),
        scratch_(scratch.within(limits.max_bytes)),
        keep_(keep),
        workers_(threads),
        visited_(scratch_) {
    for (unsigned i = 0; i < threads; ++i) threads_.emplace_back(system);
  }

  // To be called once. The disk's faults end the search as a limit does.
  template <class Visitor>
  ParallelResult run(Visitor& visitor) {
    GoOn go_on = GoOn::Yes;
    try {
      go_on = explore(visitor);
    } catch (const ScratchFault&) {
      stopped_ = StopReason::Disk;
    }
    const bool is_complete = stopped_ == StopReason::None && go_on == GoOn::Yes;
    result_.reachability = {stopped_, is_complete, progress_};
    return result_;
  }

  // Who knows the visited states, when the search is over.
  const RunSet& visited() const { return visited_; }

  // As ParallelBreadthFirst::path_to. Throws ScratchFault.
  std::vector<Word> path_to(Word pair, std::size_t depth) {
    assert(depth < depths_.size());
    return path_back(pair, depth, [&](Word to, std::size_t at) {
      return least_predecessor(to, *depths_[at]);
    });
  }

 private:
  static constexpr std::size_t kWordsPerRound = std::size_t{1} << 16;
  static constexpr std::size_t kWordsPerShare = 512;
  static constexpr std::uint64_t kWordsBetweenPolls = std::uint64_t{1} << 20;

  struct Thread {
    explicit Thread(System& system) : worker(system) {}

    typename System::Worker worker;
    RecentWords recent;
    std::vector<Word> found;
    std::uint64_t transitions = 0;
  };

  template <class Visitor>
  GoOn explore(Visitor& visitor) {
    auto parts = parts_of(visitor, threads_.size());
    if (keep_ == KeepDepths::Yes) {
      depths_file_ = std::make_shared<ScratchFile>(scratch_.folder);
    }
    Thread& first = threads_.front();
    system_.initial_states(first.worker,
                           [&](Word pair) { first.found.push_back(pair); });
    Gathering initial(scratch_, scratch_.fewest_gathered);
    initial.take(first.found);
    next_depth(visitor, initial);
    GoOn go_on = GoOn::Yes;
    while (go_on == GoOn::Yes && stopped_ == StopReason::None &&
           frontier_->size() > 0) {
      Gathering found(scratch_, room_to_gather(visitor));
      expand_depth(visitor, parts, found);
      if (stopped_ != StopReason::None) break;
      go_on = visitor.depth_done();
      next_depth(visitor, found);
      if (frontier_->size() > 0) ++progress_.depth;
    }
    return go_on;
  }

  template <class Visitor, class Part>
  void expand_depth(Visitor& visitor, std::vector<Part>& parts,
                    Gathering& found) {
    RunCursor cursor(*frontier_);
    while (stopped_ == StopReason::None && read_round(cursor)) {
      share_round([&](std::size_t i, std::span<const Word> states) {
        Thread& thread = threads_[i];
        thread.transitions += expand_all(
            system_, states, thread.worker, parts[i], [&](Word target) {
              if (!thread.recent.was_told(target)) {
                thread.found.push_back(target);
              }
            });
      });
      for (Part& part : parts) part.rest();
      progress_.expanded += round_.size();
      gather(visitor, found);
      poll(visitor, &found);
    }
  }

  // Fills `round_` from the run; whether there was anything.
  bool read_round(RunCursor& cursor) {
    round_.clear();
    for (; !cursor.is_at_end() && round_.size() < kWordsPerRound;
         cursor.advance()) {
      round_.push_back(cursor.word());
    }
    return !round_.empty();
  }

  // Calls work(i, states) for shares of the round, each thread its own i.
  template <class Work>
  void share_round(Work&& work) {
    next_share_ = 0;
    const auto take_shares = [&](std::size_t i) {
      const std::span<const Word> all = round_;
      for (std::size_t begin;
           (begin = next_share_.fetch_add(kWordsPerShare)) < all.size();) {
        const std::size_t count = std::min(kWordsPerShare, all.size() - begin);
        work(i, all.subspan(begin, count));
      }
    };
    // A narrow depth is not worth waking anybody.
    if (round_.size() <= kWordsPerShare) {
      take_shares(0);
    } else {
      workers_.each(take_shares);
    }
  }

  template <class Visitor>
  void gather(Visitor& visitor, Gathering& found) {
    for (Thread& thread : threads_) {
      progress_.transitions += std::exchange(thread.transitions, 0);
    }
    workers_.execute([&] {
      for (Thread& thread : threads_) found.take(thread.found);
      if (visitor.is_crowded()) visitor.make_room(system_.counts());
    });
  }

  // Takes what is known out of what was found; the rest is the next depth.
  template <class Visitor>
  void next_depth(const Visitor& visitor, Gathering& found) {
    RunSet::Cursor known(visited_);
    RunWriter fresh(scratch_, depths_file_);
    std::uint64_t passed = 0;
    workers_.execute([&] {
      for (RunMerge merge = found.merged(); !merge.is_at_end();
           merge.advance()) {
        if (!known.contains(merge.word())) fresh.add(merge.word());
        if (++passed % kWordsBetweenPolls != 0) continue;
        if (!poll(visitor, &found)) return;
      }
    });
    frontier_ = std::make_shared<const SortedRun>(fresh.finish());
    progress_.states += frontier_->size();
    result_.largest_frontier =
        std::max(result_.largest_frontier, frontier_->size());
    if (keep_ == KeepDepths::Yes) depths_.push_back(frontier_);
    visited_.add(frontier_, [&] { return poll(visitor, &found); });
    poll(visitor, nullptr);
  }

  // Whether to go on.
  template <class Visitor>
  bool poll(const Visitor& visitor, const Gathering* found) {
    std::size_t bytes = system_.bytes() + visited_.bytes();
    std::uint64_t on_disk = visited_.bytes_on_disk();
    if (frontier_) on_disk += frontier_->bytes_on_disk();
    if (depths_file_) on_disk += depths_file_->size();
    if (found != nullptr) {
      bytes += found->bytes();
      on_disk += found->bytes_on_disk();
    }
    result_.peak_bytes = std::max(result_.peak_bytes, bytes);
    result_.peak_bytes_on_disk = std::max(result_.peak_bytes_on_disk, on_disk);
    progress_.bytes = bytes + visitor.bytes();
    if (stopped_ == StopReason::None) stopped_ = limits_.reached(progress_);
    return stopped_ == StopReason::None;
  }

  // A quarter of what is left, so that there is room for a growing vector, for
  // the visitor's own and for the halves to come.
  template <class Visitor>
  std::size_t room_to_gather(const Visitor& visitor) const {
    const std::uint64_t held =
        system_.bytes() + visited_.bytes() + visitor.bytes();
    const std::uint64_t left =
        limits_.max_bytes - std::min(limits_.max_bytes, held);
    return scratch_.words_within(left / 4);
  }

  Word least_predecessor(Word pair, const SortedRun& depth) {
    std::vector<std::optional<Predecessor>> least(threads_.size());
    for (RunCursor cursor(depth); read_round(cursor);) {
      share_round([&](std::size_t i, std::span<const Word> states) {
        look_among(states, pair, system_, threads_[i].worker, least[i]);
      });
    }
    return least_of(std::move(least));
  }

  System& system_;
  const Limits& limits_;
  const Scratch scratch_;
  KeepDepths keep_;
  SearchThreads workers_;
  std::deque<Thread> threads_;
  std::shared_ptr<const SortedRun> frontier_;
  RunSet visited_;
  std::vector<std::shared_ptr<const SortedRun>> depths_;  // where they are kept
  std::shared_ptr<ScratchFile> depths_file_;
  std::vector<Word> round_;
  std::atomic<std::size_t> next_share_ = 0;
  StopReason stopped_ = StopReason::None;
  SearchProgress progress_;
  ParallelResult result_;
};

}  // namespace btcheck
