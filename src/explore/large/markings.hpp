// SPDX-License-Identifier: MIT
//
// Counts the markings and the dead states of a parallel search, in memory and
// on disk.
//
// A marking is a state without its clocks (what TINA calls so). A state whose
// clocks are all 0 is its own marking; only the others' are kept, in a second
// set, and in the end those that are reached themselves are not counted twice.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "explore/large/pair_search.hpp"
#include "explore/large/parallel_breadth_first.hpp"
#include "explore/large/run_merge.hpp"

namespace btcheck {

// Of a PairSystem that knows each state `without_clocks`.
template <PairSystem System, PairSet Set>
class PairMarkings : public PairVisitor {
  struct Counts {
    std::uint64_t dead = 0;
    std::uint64_t clockless = 0;
    std::uint64_t cleared = 0;
  };

 public:
  explicit PairMarkings(System& system) : system_(system) {}

  class Part {
   public:
    explicit Part(PairMarkings& all) : all_(all), inserter_(all.cleared_) {}

    void expanded(Word pair, std::size_t steps,
                  typename System::Worker& worker) {
      counts_.dead += steps == 0;
      const Word marking = all_.system_.without_clocks(pair, worker);
      if (marking == pair) {
        ++counts_.clockless;
      } else {
        keep(marking);
      }
      if (++expanded_ % kInterval == 0) all_.add_up(counts_);
    }
    void keep(Word marking) {
      inserter_.offer(marking, [&](Word) { ++counts_.cleared; });
    }
    void rest() {
      inserter_.flush([&](Word) { ++counts_.cleared; });
      all_.add_up(counts_);
      all_.wait(inserter_.take_turned_away());
    }

   private:
    static constexpr std::uint64_t kInterval = 512;

    PairMarkings& all_;
    Inserter<Set> inserter_;
    std::uint64_t expanded_ = 0;
    Counts counts_;
  };

  Part part() { return Part(*this); }
  bool is_crowded() const {
    return cleared_.is_crowded(
               cleared_count_.load(std::memory_order_relaxed)) ||
           has_waiting_.load(std::memory_order_relaxed);
  }
  void make_room(HalfCounts halves) {
    cleared_.make_room(cleared_count_ + cleared_count_ / 8, halves);
    has_waiting_ = false;
    Part again(*this);
    for (const Word pair : std::exchange(waiting_, {})) again.keep(pair);
    again.rest();
  }
  std::size_t bytes() const { return cleared_.bytes(); }

  std::uint64_t dead() const { return dead_; }
  // When the search is over; `is_visited` tells of pairs.
  template <class IsVisited>
  std::uint64_t count(IsVisited&& is_visited) const {
    std::uint64_t count = clockless_;
    cleared_.for_each([&](Word pair) { count += !is_visited(pair); });
    return count;
  }

 private:
  void add_up(Counts& counts) {
    constexpr auto order = std::memory_order_relaxed;
    dead_.fetch_add(std::exchange(counts.dead, 0), order);
    clockless_.fetch_add(std::exchange(counts.clockless, 0), order);
    cleared_count_.fetch_add(std::exchange(counts.cleared, 0), order);
  }
  void wait(const std::vector<Word>& pairs) {
    if (pairs.empty()) return;
    const std::lock_guard<std::mutex> lock(waiting_mutex_);
    waiting_.insert(waiting_.end(), pairs.begin(), pairs.end());
    has_waiting_ = true;
  }

  System& system_;
  Set cleared_;
  std::atomic<std::uint64_t> dead_ = 0;
  std::atomic<std::uint64_t> clockless_ = 0;
  std::atomic<std::uint64_t> cleared_count_ = 0;
  std::mutex waiting_mutex_;
  std::vector<Word> waiting_;  // found no place, until there is more room
  std::atomic<bool> has_waiting_ = false;
};

// The same where the states are on disk.
template <PairSystem System>
class DiskMarkings : public PairVisitor {
 public:
  // Holds about so many words in memory. Both must outlive it.
  DiskMarkings(System& system, const Scratch& scratch, std::size_t words)
      : system_(system), cleared_(scratch, words) {}

  class Part {
   public:
    explicit Part(DiskMarkings& all) : all_(all) {}

    void expanded(Word pair, std::size_t steps,
                  typename System::Worker& worker) {
      dead_ += steps == 0;
      const Word marking = all_.system_.without_clocks(pair, worker);
      if (marking == pair) {
        ++clockless_;
      } else {
        cleared_.push_back(marking);
      }
    }
    void rest() {
      all_.dead_ += std::exchange(dead_, 0);
      all_.clockless_ += std::exchange(clockless_, 0);
      all_.waiting_.insert(all_.waiting_.end(), cleared_.begin(),
                           cleared_.end());
      cleared_.clear();
    }

   private:
    DiskMarkings& all_;
    std::uint64_t dead_ = 0;
    std::uint64_t clockless_ = 0;
    std::vector<Word> cleared_;
  };

  Part part() { return Part(*this); }
  bool is_crowded() const { return !waiting_.empty(); }
  void make_room(HalfCounts) { cleared_.take(waiting_); }
  std::size_t bytes() const { return cleared_.bytes(); }

  std::uint64_t dead() const { return dead_; }
  // When the search is over; to be asked once. Throws ScratchFault.
  std::uint64_t count(const RunSet& visited) {
    std::uint64_t count = clockless_;
    RunSet::Cursor known(visited);
    for (RunMerge merge = cleared_.merged(); !merge.is_at_end();
         merge.advance()) {
      count += !known.contains(merge.word());
    }
    return count;
  }

 private:
  System& system_;
  Gathering cleared_;
  std::vector<Word> waiting_;
  std::uint64_t dead_ = 0;
  std::uint64_t clockless_ = 0;
};

}  // namespace btcheck
