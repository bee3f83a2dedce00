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
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "explore/halves/pair_set.hpp"
#include "explore/large/pair_search.hpp"
#include "explore/state/transition_system.hpp"

namespace btcheck {

// Up to 512 states, as pairs (pair_coding.hpp): threads take and fill the
// states of a depth in such blocks.
class FrontierBlock {
 public:
  static constexpr std::size_t kMost = 512;

  FrontierBlock() : pairs_(new Word[kMost]) {}

  bool is_full() const { return count_ == kMost; }
  void add(Word pair) { pairs_[count_++] = pair; }
  std::span<const Word> pairs() const { return {pairs_.get(), count_}; }

 private:
  std::unique_ptr<Word[]> pairs_;
  std::size_t count_ = 0;
};

// The states of one depth.
class Frontier {
 public:
  void add(Word pair) {
    if (blocks_.empty() || blocks_.back().is_full()) blocks_.emplace_back();
    blocks_.back().add(pair);
  }
  // Moves all of another's blocks behind one's own.
  void take(Frontier& other) {
    for (FrontierBlock& block : other.blocks_) {
      blocks_.push_back(std::move(block));
    }
    other.blocks_.clear();
  }
  const std::vector<FrontierBlock>& blocks() const { return blocks_; }
  std::uint64_t size() const {
    std::uint64_t size = 0;
    for (const FrontierBlock& block : blocks_) size += block.pairs().size();
    return size;
  }
  std::size_t bytes() const {
    return blocks_.size() *
           (FrontierBlock::kMost * sizeof(Word) + sizeof(FrontierBlock));
  }

 private:
  std::vector<FrontierBlock> blocks_;
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
  ParallelResult run(Visitor& visitor);

  bool is_visited(Word pair) const { return visited_.contains(pair); }

  // The states of a shortest path to one of this depth, an initial one first.
  // Of several predecessors it is the one with the least vector, with any
  // number of threads. The depths must have been kept, and are expanded again.
  std::vector<Word> path_to(Word pair, std::size_t depth);

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

  Word least_predecessor(Word pair, const Frontier& depth);
  void begin();
  template <class Visitor, class Part>
  void expand_depth(Visitor& visitor, std::vector<Part>& parts);
  template <class Visitor, class Part>
  void work(const Visitor& visitor, Part& part, std::size_t number);
  template <class Part>
  void expand(Thread& thread, const FrontierBlock& block, Part& part);
  void add_up(Thread& thread);
  template <class Visitor>
  bool must_rest(const Visitor& visitor) const;
  template <class Visitor>
  void make_room(Visitor& visitor);
  template <class Visitor>
  void grow(const Visitor& visitor, std::uint64_t states);
  // The memory held, the visited set's given.
  template <class Visitor>
  std::size_t bytes(const Visitor& visitor, std::size_t visited) const;
  template <class Visitor>
  void poll(const Visitor& visitor, std::size_t bytes);
  void next_depth();

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

template <PairSystem System, PairSet Set>
template <class Visitor>
ParallelResult ParallelBreadthFirst<System, Set>::run(Visitor& visitor) {
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
  result_.reachability = {
      stopped_, stopped_ == StopReason::None && go_on == GoOn::Yes, progress_};
  return result_;
}

template <PairSystem System, PairSet Set>
void ParallelBreadthFirst<System, Set>::begin() {
  Thread& first = threads_.front();
  system_.initial_states(first.worker, [&](Word pair) { first.offer(pair); });
  first.settle();
  add_up(first);
  next_depth();
}

template <PairSystem System, PairSet Set>
template <class Visitor, class Part>
void ParallelBreadthFirst<System, Set>::expand_depth(Visitor& visitor,
                                                     std::vector<Part>& parts) {
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
template <PairSystem System, PairSet Set>
template <class Visitor, class Part>
void ParallelBreadthFirst<System, Set>::work(const Visitor& visitor, Part& part,
                                             std::size_t number) {
  Thread& thread = threads_[number];
  while (!must_rest(visitor)) {
    const std::size_t block =
        next_block_.fetch_add(1, std::memory_order_relaxed);
    if (block >= frontier_.blocks().size()) break;
    expand(thread, frontier_.blocks()[block], part);
    add_up(thread);
    if (number == 0) poll(visitor, bytes(visitor, visited_.bytes()));
  }
  thread.settle();
  add_up(thread);
  part.rest();
}

template <PairSystem System, PairSet Set>
template <class Part>
void ParallelBreadthFirst<System, Set>::expand(Thread& thread,
                                               const FrontierBlock& block,
                                               Part& part) {
  constexpr std::size_t kAhead = 4;
  const std::span<const Word> pairs = block.pairs();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i + kAhead < pairs.size()) system_.prefetch(pairs[i + kAhead]);
    std::size_t steps = 0;
    system_.successors(pairs[i], thread.worker, [&](Word target) {
      ++steps;
      thread.offer(target);
    });
    thread.transitions += steps;
    part.expanded(pairs[i], steps, thread.worker);
  }
  thread.expanded += pairs.size();
}

template <PairSystem System, PairSet Set>
void ParallelBreadthFirst<System, Set>::add_up(Thread& thread) {
  constexpr auto order = std::memory_order_relaxed;
  counts_.states.fetch_add(std::exchange(thread.states, 0), order);
  counts_.expanded.fetch_add(std::exchange(thread.expanded, 0), order);
  counts_.transitions.fetch_add(std::exchange(thread.transitions, 0), order);
}

template <PairSystem System, PairSet Set>
template <class Visitor>
bool ParallelBreadthFirst<System, Set>::must_rest(
    const Visitor& visitor) const {
  const std::uint64_t states = counts_.states.load(std::memory_order_relaxed);
  return stopped_.load(std::memory_order_relaxed) != StopReason::None ||
         states >= limits_.max_states || visited_.is_crowded(states) ||
         visitor.is_crowded();
}

// Between rounds.
template <PairSystem System, PairSet Set>
template <class Visitor>
void ParallelBreadthFirst<System, Set>::make_room(Visitor& visitor) {
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
template <PairSystem System, PairSet Set>
template <class Visitor>
void ParallelBreadthFirst<System, Set>::grow(const Visitor& visitor,
                                             std::uint64_t states) {
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

template <PairSystem System, PairSet Set>
template <class Visitor>
std::size_t ParallelBreadthFirst<System, Set>::bytes(
    const Visitor& visitor, std::size_t visited) const {
  // The next depth is about as large as this one.
  const std::size_t own =
      visited + system_.bytes() + 2 * frontier_.bytes() + kept_bytes_;
  return own + visitor.bytes();
}

template <PairSystem System, PairSet Set>
template <class Visitor>
void ParallelBreadthFirst<System, Set>::poll(const Visitor& visitor,
                                             std::size_t bytes) {
  progress_.states = counts_.states;
  progress_.expanded = counts_.expanded;
  progress_.transitions = counts_.transitions;
  progress_.bytes = bytes;
  result_.peak_bytes = std::max(result_.peak_bytes, bytes - visitor.bytes());
  const StopReason reason = limits_.reached(progress_);
  if (reason != StopReason::None) stopped_ = reason;
}

template <PairSystem System, PairSet Set>
void ParallelBreadthFirst<System, Set>::next_depth() {
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

template <PairSystem System, PairSet Set>
std::vector<Word> ParallelBreadthFirst<System, Set>::path_to(
    Word pair, std::size_t depth) {
  assert(depth <= depths_.size());
  return path_back(pair, depth, [&](Word to, std::size_t at) {
    return least_predecessor(to, depths_[at]);
  });
}

template <PairSystem System, PairSet Set>
Word ParallelBreadthFirst<System, Set>::least_predecessor(
    Word pair, const Frontier& depth) {
  std::vector<LeastPredecessor<System>> least(threads_.size(), {system_, pair});
  next_block_ = 0;
  workers_.each([&](std::size_t i) {
    const std::vector<FrontierBlock>& blocks = depth.blocks();
    for (std::size_t b = next_block_++; b < blocks.size(); b = next_block_++) {
      least[i].look_among(blocks[b].pairs(), threads_[i].worker);
    }
  });
  return least_of(least);
}

}  // namespace btcheck
