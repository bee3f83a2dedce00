// SPDX-License-Identifier: MIT
//
// Emptiness of a system with acceptance sets: is there a fair run?
//
// One depth-first search that keeps the strongly connected components found
// so far on a stack, each with the union of the acceptance sets of its steps,
// and merges those that a step back closes into one (Couvreur, "On-the-fly
// verification of linear temporal logic", FM 1999; the path-based search is
// Gabow's, 2000). It stops at the first component that has every set, often
// long before all states are stored. Generalised acceptance costs nothing
// here, where nested depth-first search would need a copy of the states for
// each set. Where we differ: the steps of a new state are looked at at once,
// not when the search comes back to them, so that a closing step counts as
// soon as it is known, and only steps to new states wait on the stack.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "explore/limits.hpp"
#include "explore/state_store.hpp"
#include "ltl/fair_system.hpp"
#include "ltl/short_lasso.hpp"

namespace btcheck {

// Numbers for the acceptance sets that occur together, which are few: the
// search keeps four bytes on its stacks instead of eight.
class SetNumbers {
 public:
  std::uint32_t number(AcceptanceSet sets) {
    if (sets == sets_[last_]) return last_;
    const auto next = static_cast<std::uint32_t>(sets_.size());
    const auto [place, is_new] = numbers_.emplace(sets, next);
    if (is_new) sets_.push_back(sets);
    return last_ = place->second;
  }
  AcceptanceSet operator[](std::uint32_t number) const { return sets_[number]; }

 private:
  std::vector<AcceptanceSet> sets_{0};
  std::unordered_map<AcceptanceSet, std::uint32_t> numbers_{{0, 0}};
  std::uint32_t last_ = 0;
};

// The components that are not known to be complete, outermost first. States
// are numbered from 1 along the search; a component is named by its lowest.
class OpenComponents {
 public:
  // A state of its own, entered by a step in the sets `incoming`.
  void open(std::uint32_t number, AcceptanceSet incoming);

  // A step in the sets `closing` leads back to the state `number`: all
  // components from there on are one. Returns the sets of its steps.
  AcceptanceSet merge(std::uint32_t number, AcceptanceSet closing);

  // Forgets the innermost component.
  void close();

  // The lowest number in the innermost component.
  std::uint32_t root() const { return stack_.back().root; }

  std::size_t bytes() const { return stack_.capacity() * sizeof(Component); }

 private:
  struct Component {
    std::uint32_t root;
    std::uint32_t incoming;  // number of the sets of the step that entered it
    std::uint32_t inside;    // and of those of the steps within it
  };

  std::vector<Component> stack_;
  SetNumbers numbers_;
};

// A depth-first search for a reachable component with every acceptance set.
template <FairSystem System>
class AcceptingCycleSearch {
 public:
  // The system must outlive the search.
  AcceptingCycleSearch(const System& system, const Limits& limits)
      : system_(system),
        limits_(limits),
        store_(system.word_count()),
        present_(system.word_count()) {}

  // To be called once. The states of the lasso are those of `System`.
  RunSearch run() {
    std::vector<StateId> initial;
    system_.initial_states(
        [&](StateView state) { initial.push_back(store_.insert(state).id); });
    numbers_.resize(store_.size());
    poll();
    for (const StateId state : initial) {
      if (result_.outcome != SearchOutcome::Empty) break;
      if (numbers_[index(state)] == kNew) search_from(state);
    }
    update_progress();
    if (result_.outcome == SearchOutcome::Found) tell(initial);
    return std::move(result_);
  }

 private:
  // A state on the search path; the steps it still has to take are on top of
  // waiting_ when it is the last of the path.
  struct Frame {
    StateId state;
    std::uint32_t steps_waiting;
  };
  struct WaitingStep {
    std::uint32_t sets;  // their number
    StateId target;
  };

  static constexpr std::uint32_t kNew = 0;
  static constexpr std::uint32_t kClosed = UINT32_MAX;
  static constexpr std::uint64_t kMostStates = UINT32_MAX - 2;

  void search_from(StateId initial) {
    enter(initial, 0);
    while (!path_.empty() && result_.outcome == SearchOutcome::Empty) {
      if (path_.back().steps_waiting == 0) {
        leave();
        continue;
      }
      const WaitingStep step = waiting_.back();
      waiting_.pop_back();
      --path_.back().steps_waiting;
      const std::uint32_t number = numbers_[index(step.target)];
      if (number == kNew) {
        enter(step.target, set_numbers_[step.sets]);
      } else if (number != kClosed) {
        close_cycle(number, set_numbers_[step.sets]);
      }
    }
  }

  // Puts a new state on the search path.
  void enter(StateId state, AcceptanceSet sets) {
    open_.push_back(state);
    const auto number = static_cast<std::uint32_t>(open_.size());
    numbers_[index(state)] = number;
    components_.open(number, sets);
    path_.push_back({state, 0});
    progress_.depth = std::max<std::uint64_t>(progress_.depth, path_.size());
    expand(state);
    if (++progress_.expanded % kPollInterval == 0) poll();
  }

  // Sorts the steps of a state: back into the path, done with, or waiting.
  void expand(StateId state) {
    store_.load(state, present_);
    system_.successors(present_,
                       [&](StateView target, Step, AcceptanceSet sets) {
                         const StateId id = store_.insert(target).id;
                         if (index(id) >= numbers_.size())
                           numbers_.resize(index(id) + 1);
                         progress_.transitions += id != state;
                         const std::uint32_t number = numbers_[index(id)];
                         if (number == kNew) {
                           waiting_.push_back({set_numbers_.number(sets), id});
                           ++path_.back().steps_waiting;
                         } else if (number != kClosed) {
                           close_cycle(number, sets);
                         }
                       });
  }

  void close_cycle(std::uint32_t number, AcceptanceSet sets) {
    const AcceptanceSet all = system_.all_sets();
    if ((components_.merge(number, sets) & all) == all) {
      result_.outcome = SearchOutcome::Found;
    }
  }

  // Takes the last state off the path, with its component if it is the root.
  void leave() {
    const StateId state = path_.back().state;
    path_.pop_back();
    const std::uint32_t root = components_.root();
    if (numbers_[index(state)] != root) return;
    components_.close();
    while (open_.size() >= root) {
      numbers_[index(open_.back())] = kClosed;
      open_.pop_back();
    }
  }

  void poll() {
    update_progress();
    result_.stopped = limits_.reached(result_.progress);
    if (progress_.states >= kMostStates) {
      result_.stopped = StopReason::MaxStates;
    }
    if (result_.outcome == SearchOutcome::Empty &&
        result_.stopped != StopReason::None) {
      result_.outcome = SearchOutcome::GaveUp;
    }
  }

  void update_progress() {
    progress_.states = store_.size();
    progress_.bytes = store_.bytes() + components_.bytes() +
                      numbers_.capacity() * sizeof(std::uint32_t) +
                      open_.capacity() * sizeof(StateId) +
                      path_.capacity() * sizeof(Frame) +
                      waiting_.capacity() * sizeof(WaitingStep);
    result_.progress = progress_;
  }

  // Tells a short run into the component that was found, and around in it.
  void tell(std::span<const StateId> initial) {
    const std::uint32_t root = components_.root();
    const auto known = static_cast<std::uint32_t>(numbers_.size());
    result_.stopped = StopReason::None;
    result_.lasso =
        ShortLasso(system_, store_)
            .find(
                initial, [&](StateId state) { return index(state) < known; },
                [&](StateId state) {
                  return index(state) < known &&
                         numbers_[index(state)] != kClosed &&
                         numbers_[index(state)] >= root;
                });
  }

  const System& system_;
  const Limits& limits_;
  StateStore store_;
  StateVector present_;  // the state being expanded
  // By state: its place in open_ counted from 1, kNew or kClosed.
  std::vector<std::uint32_t> numbers_;
  std::vector<StateId> open_;  // states of the open components, as entered
  std::vector<Frame> path_;
  std::vector<WaitingStep> waiting_;
  SetNumbers set_numbers_;
  OpenComponents components_;
  SearchProgress progress_;
  RunSearch result_;
};

// Drops the last word of each state: from runs of a product to the system's.
void drop_last_word(Lasso& lasso);

// Searches a product for a fair run. The states of the lasso are those of the
// system: the state of the automaton, their last word, is dropped. The limits
// bound the states stored; they must outlive the call.
template <FairSystem System>
RunSearch find_accepting_cycle(const System& product, const Limits& limits) {
  RunSearch result = AcceptingCycleSearch(product, limits).run();
  if (result.lasso) drop_last_word(*result.lasso);
  return result;
}

}  // namespace btcheck
