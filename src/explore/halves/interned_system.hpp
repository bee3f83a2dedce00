// SPDX-License-Identifier: MIT
//
// Any transition system, searched by pairs.
//
// A system whose steps are computed on whole vectors, a reduced one for
// instance, gets its states numbered here: both halves of every vector that it
// hands out go into the dictionaries. Slower than SplitNetwork, which knows
// successors by number, but the same search and the same visited set.
#pragma once

#include "explore/halves/half_dictionary.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// May be used by several threads, each with a Worker of its own, if the
// system's const members may. Both must outlive it.
template <TransitionSystem System>
class InternedSystem {
 public:
  // `network` knows the clocks of the system's vectors.
  InternedSystem(const System& system, const CompiledNetwork& network)
      : system_(system), network_(network), states_(system.word_count()) {}

  // What a thread needs for itself: the state being expanded.
  struct Worker {
    explicit Worker(const InternedSystem& system)
        : state(system.word_count()) {}

    StateVector state;
  };

  std::size_t word_count() const { return states_.word_count(); }

  template <class Found>
  void initial_states(Worker&, Found&& found) {
    system_.initial_states(
        [&](StateView state) { found(states_.intern(state)); });
  }

  // Calls stepped(target) for each step but the idle one that leads back.
  template <class Stepped>
  void successors(Word pair, Worker& worker, Stepped&& stepped) {
    states_.load(pair, worker.state.data());
    system_.successors(worker.state, [&](StateView target, Step step) {
      const Word to = states_.intern(target, pair);
      if (step.edge != kTimeStep || to != pair) stepped(to);
    });
  }

  // The same state with every clock at 0.
  Word without_clocks(Word pair, Worker& worker) {
    states_.load(pair, worker.state.data());
    network_.clear_clocks(worker.state);
    return states_.intern(worker.state, pair);
  }

  void prefetch(Word) const {}
  void load(Word pair, Word* out) const { states_.load(pair, out); }

  HalfCounts counts() const { return states_.counts(); }
  std::size_t bytes() const { return states_.bytes(); }

 private:
  const System& system_;
  const CompiledNetwork& network_;
  PairDictionary states_;
};

}  // namespace btcheck
