// SPDX-License-Identifier: MIT
//
// What the searches over pairs of half numbers have in common: the system's
// interface, the visitor, threads, and finding a state's predecessor.
#pragma once

#include <algorithm>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "explore/halves/pair_coding.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/limits.hpp"
#include "explore/store/search_threads.hpp"

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

// Watches a parallel search. A visitor derives from this and redefines the
// members it needs. A part is used by one thread at a time.
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
  // Between rounds: makes room for the next one.
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
  std::uint64_t peak_bytes_on_disk = 0;
};

// A state that leads to the one whose predecessor is looked for.
using Predecessor = std::pair<StateVector, Word>;

// Of the states that lead to `target`, finds that with the least vector: the
// same one, however the states are numbered and whoever looks at which.
template <PairSystem System>
void look_among(std::span<const Word> states, Word target, System& system,
                typename System::Worker& worker,
                std::optional<Predecessor>& least) {
  for (const Word from : states) {
    bool leads_there = false;
    system.successors(from, worker,
                      [&](Word to) { leads_there |= to == target; });
    if (!leads_there) continue;
    Predecessor found{StateVector(system.word_count()), from};
    system.load(from, found.first.data());
    if (!least || found < *least) least = std::move(found);
  }
}

// The least of what several threads have found; one of them has found any.
inline Word least_of(std::vector<std::optional<Predecessor>> found) {
  std::erase(found, std::nullopt);
  assert(!found.empty());
  return (*std::min_element(found.begin(), found.end()))->second;
}

// A visitor's parts, one for each thread.
template <class Visitor>
auto parts_of(Visitor& visitor, std::size_t threads) {
  std::vector<decltype(visitor.part())> parts;
  parts.reserve(threads);
  for (std::size_t i = 0; i < threads; ++i) parts.push_back(visitor.part());
  return parts;
}

// Expands states in turn, and shows each to the part; calls found(target) for
// each step. Returns how many steps there are.
template <PairSystem System, class Part, class Found>
std::uint64_t expand_all(System& system, std::span<const Word> states,
                         typename System::Worker& worker, Part& part,
                         Found&& found) {
  constexpr std::size_t kAhead = 4;
  std::uint64_t all_steps = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i + kAhead < states.size()) system.prefetch(states[i + kAhead]);
    std::size_t steps = 0;
    system.successors(states[i], worker, [&](Word target) {
      ++steps;
      found(target);
    });
    all_steps += steps;
    part.expanded(states[i], steps, worker);
  }
  return all_steps;
}

// The path to a state of this depth, found backwards: `predecessor(pair,
// depth)` is a state of that depth that leads to the pair.
template <class Predecessor>
std::vector<Word> path_back(Word pair, std::size_t depth,
                            Predecessor&& predecessor) {
  std::vector<Word> path{pair};
  while (depth > 0) path.push_back(predecessor(path.back(), --depth));
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace btcheck
