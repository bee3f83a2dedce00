// SPDX-License-Identifier: MIT
//
// Reachability, breadth first, by several threads.
//
// All states of one depth are expanded before any of the next, as in LTSmin and
// most other parallel searches. The order within a depth does not matter, so
// counts, depth and answers are the same with any number of threads. A state is
// the pair of its halves' numbers and is kept in the visited set alone: a path
// is found afterwards, backwards, by expanding its depths again. The threads
// work in rounds, which end when the depth is done or the visited set has to
// grow; between rounds there is only one.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "explore/halves/pair_set.hpp"
#include "explore/large/pair_search.hpp"
#include "explore/state/transition_system.hpp"

namespace btcheck {

// The states of one depth, as pairs, in blocks that threads take and fill.
class Frontier {
 public:
  using Block = std::vector<Word>;

  void add(Word pair) {
    if (blocks_.empty() || blocks_.back().size() == kMost) {
      blocks_.emplace_back().reserve(kMost);
    }
    blocks_.back().push_back(pair);
  }
  // Moves all of another's blocks behind one's own.
  void take(Frontier& other) {
    std::move(other.blocks_.begin(), other.blocks_.end(),
              std::back_inserter(blocks_));
    other.blocks_.clear();
  }
  const std::vector<Block>& blocks() const { return blocks_; }
  std::uint64_t size() const {
    std::uint64_t size = 0;
    for (const Block& block : blocks_) size += block.size();
    return size;
  }
  std::size_t bytes() const {
    return blocks_.size() * (kMost * sizeof(Word) + sizeof(Block));
  }

 private:
  static constexpr std::size_t kMost = 512;

  std::vector<Block> blocks_;
};

template <PairSystem System, PairSet Set>
class ParallelBreadthFirst {
 public:
  // System and limits must outlive the search.
  ParallelBreadthFirst(System& system, const Limits& limits, unsigned threads,
                       KeepDepths keep = KeepDepths::No)
      : system_(system), limits_(limits), keep_(keep), workers_(threads) {
    for (unsigned i = 0; i < threads; ++i) {
      threads_.emplace_back(system, visited_);
    }
  }

  // To be called once.
  template <class Visitor>
  ParallelResult run(Visitor& visitor) {
    auto parts = parts_of(visitor, threads_.size());
    begin();
    GoOn go_on = GoOn::Yes;
    while (go_on == GoOn::Yes && stopped_ == StopReason::None &&
           !frontier_.blocks().empty()) {
      expand_depth(visitor, parts);
      if (stopped_ != StopReason::None) break;
      go_on = visitor.depth_done();
      next_depth();
      if (!frontier_.blocks().empty()) ++progress_.depth;
    }
    poll(visitor, bytes(visitor, visited_.bytes()));
    const bool is_complete = stopped_ == StopReason::None && go_on == GoOn::Yes;
    result_.reachability = {stopped_, is_complete, progress_};
    return result_;
  }

  bool is_visited(Word pair) const { return visited_.contains(pair); }

  // The states of a shortest path to one of this depth, an initial one first.
  // Of several predecessors it is the one with the least vector, with any
  // number of threads. The depths must have been kept, and are expanded again.
  std::vector<Word> path_to(Word pair, std::size_t depth) {
    assert(depth <= depths_.size());
    return path_back(pair, depth, [&](Word to, std::size_t at) {
      return least_predecessor(to, depths_[at]);
    });
  }

 private:
  // What belongs to one thread. The counts are those not added up yet.
  struct Thread {
    Thread(System& system, Set& visited) : worker(system), inserter(visited) {}

    void offer(Word pair) {
      inserter.offer(pair, [this](Word is_new) { keep(is_new); });
    }
    void settle() {
      inserter.flush([this](Word is_new) { keep(is_new); });
    }
    void keep(Word pair) {
      found.add(pair);
      ++states;
    }

    typename System::Worker worker;
    Inserter<Set> inserter;
    Frontier found;
    std::uint64_t states = 0;
    std::uint64_t expanded = 0;
    std::uint64_t transitions = 0;
  };
  // The same of all threads, as each adds them up block by block.
  struct Counts {
    std::atomic<std::uint64_t> states = 0;
    std::atomic<std::uint64_t> expanded = 0;
    std::atomic<std::uint64_t> transitions = 0;
  };

  Word least_predecessor(Word pair, const Frontier& depth) {
    std::vector<std::optional<Predecessor>> least(threads_.size());
    next_block_ = 0;
    workers_.each([&](std::size_t i) {
      const auto& blocks = depth.blocks();
      for (std::size_t b; (b = next_block_++) < blocks.size();) {
        look_among(blocks[b], pair, system_, threads_[i].worker, least[i]);
      }
    });
    return least_of(std::move(least));
  }

  void begin() {
    Thread& first = threads_.front();
    system_.initial_states(first.worker, [&](Word pair) { first.offer(pair); });
    first.settle();
    add_up(first);
    next_depth();
  }

  template <class Visitor, class Part>
  void expand_depth(Visitor& visitor, std::vector<Part>& parts) {
    bool is_done = false;
    while (!is_done && stopped_ == StopReason::None) {
      // A narrow depth is not worth waking anybody.
      if (frontier_.blocks().size() < 2) {
        work(visitor, parts[0], 0);
      } else {
        workers_.each([&](std::size_t i) { work(visitor, parts[i], i); });
      }
      make_room(visitor);
      is_done = next_block_ >= frontier_.blocks().size();
    }
  }

  // One thread's share of a round.
  template <class Visitor, class Part>
  void work(const Visitor& visitor, Part& part, std::size_t number) {
    Thread& thread = threads_[number];
    while (!must_rest(visitor)) {
      const std::size_t block =
          next_block_.fetch_add(1, std::memory_order_relaxed);
      if (block >= frontier_.blocks().size()) break;
      const std::span<const Word> pairs = frontier_.blocks()[block];
      thread.transitions +=
          expand_all(system_, pairs, thread.worker, part,
                     [&](Word target) { thread.offer(target); });
      thread.expanded += pairs.size();
      add_up(thread);
      if (number == 0) poll(visitor, bytes(visitor, visited_.bytes()));
    }
    thread.settle();
    add_up(thread);
    part.rest();
  }

  void add_up(Thread& thread) {
    constexpr auto order = std::memory_order_relaxed;
    counts_.states.fetch_add(std::exchange(thread.states, 0), order);
    counts_.expanded.fetch_add(std::exchange(thread.expanded, 0), order);
    counts_.transitions.fetch_add(std::exchange(thread.transitions, 0), order);
  }

  template <class Visitor>
  bool must_rest(const Visitor& visitor) const {
    const std::uint64_t states = counts_.states.load(std::memory_order_relaxed);
    return stopped_.load(std::memory_order_relaxed) != StopReason::None ||
           states >= limits_.max_states || visited_.is_crowded(states) ||
           visitor.is_crowded();
  }

  // Between rounds.
  template <class Visitor>
  void make_room(Visitor& visitor) {
    // Also when nobody had a block to expand: a limit may be what all rest for.
    poll(visitor, bytes(visitor, visited_.bytes()));
    if (visitor.is_crowded()) {
      workers_.execute([&] { visitor.make_room(system_.counts()); });
    }
    std::vector<Word> again;
    for (Thread& thread : threads_) {
      const std::vector<Word> pairs = thread.inserter.take_turned_away();
      again.insert(again.end(), pairs.begin(), pairs.end());
    }
    const std::uint64_t states = counts_.states;
    if (again.empty() && !visited_.is_crowded(states)) return;
    grow(visitor, states);
    // Where some still find no place, all segments are made larger.
    Thread& first = threads_.front();
    for (std::uint64_t more = 1; !again.empty(); ++more) {
      if (stopped_ != StopReason::None) return;
      for (const Word pair : again) first.offer(pair);
      first.settle();
      add_up(first);
      again = first.inserter.take_turned_away();
      if (!again.empty()) grow(visitor, states + more * (states / 16 + 1024));
    }
  }

  // What it will take is counted before it is taken.
  template <class Visitor>
  void grow(const Visitor& visitor, std::uint64_t states) {
    const auto planned = [&](HalfCounts counts) {
      return bytes(visitor, visited_.bytes_for(states, counts));
    };
    // Coding anew saves memory in the long run, and takes some first.
    HalfCounts counts = system_.counts();
    if (planned(counts) >= limits_.max_bytes) counts = {};
    poll(visitor, planned(counts));
    if (stopped_ != StopReason::None) return;
    workers_.execute([&] { visited_.make_room(states, counts); });
  }

  // The memory held, the visited set's given.
  template <class Visitor>
  std::size_t bytes(const Visitor& visitor, std::size_t visited) const {
    // The next depth is about as large as this one.
    return visited + system_.bytes() + 2 * frontier_.bytes() + kept_bytes_ +
           visitor.bytes();
  }

  template <class Visitor>
  void poll(const Visitor& visitor, std::size_t bytes) {
    progress_.states = counts_.states;
    progress_.expanded = counts_.expanded;
    progress_.transitions = counts_.transitions;
    progress_.bytes = bytes;
    result_.peak_bytes = std::max(result_.peak_bytes, bytes - visitor.bytes());
    const StopReason reason = limits_.reached(progress_);
    if (reason != StopReason::None) stopped_ = reason;
  }

  void next_depth() {
    if (keep_ == KeepDepths::Yes && !frontier_.blocks().empty()) {
      kept_bytes_ += frontier_.bytes();
      depths_.push_back(std::move(frontier_));
    }
    frontier_ = Frontier();
    for (Thread& thread : threads_) frontier_.take(thread.found);
    next_block_ = 0;
    result_.largest_frontier =
        std::max(result_.largest_frontier, frontier_.size());
  }

  System& system_;
  const Limits& limits_;
  KeepDepths keep_;
  SearchThreads workers_;
  Set visited_;
  std::deque<Thread> threads_;
  Frontier frontier_;
  std::vector<Frontier> depths_;  // where they are kept
  std::size_t kept_bytes_ = 0;
  std::atomic<std::size_t> next_block_ = 0;
  Counts counts_;
  std::atomic<StopReason> stopped_ = StopReason::None;
  SearchProgress progress_;
  ParallelResult result_;
};

}  // namespace btcheck
