// SPDX-License-Identifier: MIT
//
// Counts the markings and the dead states of a search whose states are on disk
// (pair_markings.hpp tells what a marking is).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "explore/large/pair_search.hpp"
#include "explore/large/run_merge.hpp"

namespace btcheck {

// Of a PairSystem that knows each state `without_clocks`.
template <PairSystem System>
class DiskMarkings : public PairVisitor {
 public:
  // Holds about so many words in memory. Both must outlive it.
  DiskMarkings(System& system, const Scratch& scratch, std::size_t words)
      : system_(system), cleared_(scratch) {
    cleared_.hold_at_most(words);
  }

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
