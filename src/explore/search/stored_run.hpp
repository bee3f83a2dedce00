// SPDX-License-Identifier: MIT
//
// A path of stored states, told as a run.
//
// Searches keep the number of the state each was reached from and nothing of
// the step that led there: a step is asked for again when a run is told.
#pragma once

#include <algorithm>
#include <cassert>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/transition_system.hpp"
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

}  // namespace btcheck
