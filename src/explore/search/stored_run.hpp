// SPDX-License-Identifier: MIT
//
// Paths of stored states: who was reached from whom, and how a path becomes a
// run.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "explore/store/growing_array.hpp"
#include "explore/store/state_store.hpp"

namespace btcheck {

// A step of the system from one state to another, with progress if any has.
// There must be one. Systems whose steps are in acceptance sets will do.
template <class System>
Step step_between(const System& system, StateView from, StateView to) {
  std::optional<Step> found;
  system.successors(from, [&](StateView target, Step step, auto&&...) {
    const bool is_better = !found || (step.progress && !found->progress);
    if (is_better && std::equal(target.begin(), target.end(), to.begin())) {
      found = step;
    }
  });
  assert(found);
  return found.value_or(Step{});
}

// The run over places each of which follows from the one before. The places
// are what a search calls its states by; `load` writes the words of one.
template <class System, class Places, class Load>
std::vector<RunState> tell_run(const System& system, const Places& places,
                               Load load) {
  std::vector<RunState> run;
  StateVector words(system.word_count());
  for (const auto place : places) {
    load(place, words);
    const Step step =
        run.empty() ? Step{} : step_between(system, run.back().state, words);
    run.push_back({words, step});
  }
  return run;
}

// The same over stored states.
template <class System>
std::vector<RunState> run_along(const System& system, const StateStore& store,
                                std::span<const StateId> states) {
  return tell_run(system, states, [&](StateId id, StateVector& words) {
    store.load(id, words);
  });
}

// Who was reached first from whom: four bytes for each stored state. The step
// between the two is not kept; the system is asked for it again when a path is
// told, which saves twelve bytes for each state.
class BreadthFirstTree {
 public:
  // Reaches a state from another, or a root from itself; false when it has
  // been reached before.
  bool reach(StateId state, StateId from) {
    const std::uint32_t number = index(state);
    if (number >= parents_.size()) parents_.resize(number + 1, kUnreached);
    if (parents_[number] != kUnreached) return false;
    parents_[number] = index(from);
    return true;
  }

  bool is_reached(StateId state) const {
    return index(state) < parents_.size() &&
           parents_[index(state)] != kUnreached;
  }

  // The state it was reached from; a root from itself.
  StateId parent(StateId state) const {
    return StateId{parents_[index(state)]};
  }

  // The states from a root to `state`, both included.
  std::vector<StateId> path_to(StateId state) const {
    std::vector<StateId> path{state};
    while (parent(path.back()) != path.back()) {
      assert(is_reached(path.back()));
      path.push_back(parent(path.back()));
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  std::size_t bytes() const { return parents_.bytes(); }

 private:
  static constexpr std::uint32_t kUnreached = UINT32_MAX;

  GrowingArray<std::uint32_t> parents_;
};

}  // namespace btcheck
