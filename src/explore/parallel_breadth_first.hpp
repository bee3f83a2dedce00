// SPDX-License-Identifier: MIT
//
// Reachability, breadth first, by several threads.
//
// All states of one depth are expanded before any of the next (as in LTSmin's
// and most other parallel searches: the order within a depth is nobody's
// business, so states, steps, depth and what is asked of states come out the
// same with any number of threads). A state is the pair of its halves' numbers
// and is kept in the visited set and nowhere else: who was reached from whom
// is found out afterwards, depth by depth, where a path is told. The threads
// work in rounds, which end when the depth is done or the visited set has to
// grow; between rounds there is only one.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <concepts>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "explore/frontier.hpp"
#include "explore/in_parallel.hpp"
#include "explore/limits.hpp"
#include "explore/pair_set.hpp"
#include "explore/reachability.hpp"

namespace btcheck {

// A system over pairs (pair_coding.hpp), as SplitNetwork and InternedSystem.
// `successors` calls stepped(pair) for each step but the idle one that leads
// back to the same state.
template <class System>
concept PairSystem = requires(System& system, const System& known, Word pair,
                              Word* words, typename System::Worker& worker,
                              void (*found)(Word)) {
  { known.word_count() } -> std::convertible_to<std::size_t>;
  system.initial_states(worker, found);
  system.successors(pair, worker, found);
  known.prefetch(pair);
  known.load(pair, words);
  { known.counts() } -> std::same_as<HalfCounts>;
  { known.bytes() } -> std::same_as<std::size_t>;
};

// What a parallel search shows to who runs it. Every member may be hidden by
// one of the same name. A part is used by one thread at a time.
struct PairVisitor {
  struct Part {
    // A state with the number of its steps; 0: it is dead.
    template <class Worker>
    void expanded(Word /*pair*/, std::size_t /*steps*/, Worker&) {}
    // The round is over: what waits has to be done.
    void rest() {}
  };
  Part part() { return {}; }
  // Whether a round should end early, asked by every thread now and then.
  bool is_crowded() const { return false; }
  // Between rounds: has all it needs for the next one.
  void make_room(HalfCounts) {}
  // After each depth, which is complete.
  GoOn depth_done() { return GoOn::Yes; }
  // Memory held, for the limit.
  std::size_t bytes() const { return 0; }
};

// What is kept of a depth when it is done. Paths can be told only from all.
enum class KeepDepths : std::uint8_t { No, Yes };

struct ParallelResult {
  ReachabilityResult reachability;
  std::uint64_t largest_frontier = 0;
  std::size_t peak_bytes = 0;  // held by the search, the visitor's aside
};

template <PairSystem System, PairSet Set>
class ParallelBreadthFirst {
 public:
  // System and limits must outlive the search.
  ParallelBreadthFirst(System& system, const Limits& limits, unsigned threads,
                       KeepDepths keep = KeepDepths::No)
      : system_(system),
        limits_(limits),
        keep_(keep),
        parallelism_(
            tbb::global_control::max_allowed_parallelism,
            std::max<std::size_t>(
                threads, tbb::global_control::active_value(
                             tbb::global_control::max_allowed_parallelism))),
        arena_(static_cast<int>(threads)) {
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

  // Calls work(i) for each thread, all at once.
  template <class Work>
  void in_parallel(Work&& work) {
    arena_.execute([&] { btcheck::in_parallel(threads_.size(), work); });
  }

  // A state with its vector.
  struct KnownState {
    Word pair = 0;
    StateVector words;
  };

  Word least_predecessor(Word pair, const Frontier& depth);
  void look_for_predecessor(Word pair, const FrontierBlock& block,
                            Thread& thread, std::optional<KnownState>& least);
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
  // The memory held, the visited set's given.
  template <class Visitor>
  std::size_t bytes(const Visitor& visitor, std::size_t visited) const;
  template <class Visitor>
  void poll(const Visitor& visitor, std::size_t bytes);
  void next_depth();

  System& system_;
  const Limits& limits_;
  KeepDepths keep_;
  tbb::global_control parallelism_;
  tbb::task_arena arena_;
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
  using Part = decltype(visitor.part());
  std::vector<Part> parts;
  parts.reserve(threads_.size());
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    parts.push_back(visitor.part());
  }
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
      in_parallel([&](std::size_t i) { work(visitor, parts[i], i); });
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

// Between rounds. What growing will take is counted before it is taken.
template <PairSystem System, PairSet Set>
template <class Visitor>
void ParallelBreadthFirst<System, Set>::make_room(Visitor& visitor) {
  if (visitor.is_crowded()) {
    arena_.execute([&] { visitor.make_room(system_.counts()); });
  }
  std::vector<Word> again;
  for (Thread& thread : threads_) {
    const std::vector<Word> pairs = thread.inserter.take_turned_away();
    again.insert(again.end(), pairs.begin(), pairs.end());
  }
  const std::uint64_t states = counts_.states;
  if (again.empty() && !visited_.is_crowded(states)) return;
  poll(visitor, bytes(visitor, visited_.bytes_for(states)));
  if (stopped_ != StopReason::None) return;
  // Where some found no place, all segments are made larger.
  const std::uint64_t wanted = again.empty() ? states : states + states / 4;
  arena_.execute([&] { visited_.make_room(wanted, system_.counts()); });
  Thread& first = threads_.front();
  for (const Word pair : again) first.offer(pair);
  first.settle();
  add_up(first);
  if (first.inserter.has_turned_away()) make_room(visitor);
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
  std::vector<Word> path{pair};
  for (std::size_t before = depth; before > 0; --before) {
    path.push_back(least_predecessor(path.back(), depths_[before - 1]));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

template <PairSystem System, PairSet Set>
Word ParallelBreadthFirst<System, Set>::least_predecessor(
    Word pair, const Frontier& depth) {
  std::vector<std::optional<KnownState>> least(threads_.size());
  next_block_ = 0;
  in_parallel([&](std::size_t i) {
    const std::vector<FrontierBlock>& blocks = depth.blocks();
    for (std::size_t b = next_block_++; b < blocks.size(); b = next_block_++) {
      look_for_predecessor(pair, blocks[b], threads_[i], least[i]);
    }
  });
  const auto found = std::min_element(
      least.begin(), least.end(), [](const auto& one, const auto& other) {
        return one && (!other || one->words < other->words);
      });
  assert(*found);
  return (*found)->pair;
}

template <PairSystem System, PairSet Set>
void ParallelBreadthFirst<System, Set>::look_for_predecessor(
    Word pair, const FrontierBlock& block, Thread& thread,
    std::optional<KnownState>& least) {
  for (const Word from : block.pairs()) {
    bool leads_there = false;
    system_.successors(from, thread.worker,
                       [&](Word target) { leads_there |= target == pair; });
    if (!leads_there) continue;
    KnownState state{from, StateVector(system_.word_count())};
    system_.load(from, state.words.data());
    if (!least || state.words < least->words) least = std::move(state);
  }
}

}  // namespace btcheck
