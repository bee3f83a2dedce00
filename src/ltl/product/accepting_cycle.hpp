// SPDX-License-Identifier: MIT
//
// Emptiness of a system with acceptance sets: is there a fair run?
//
// One depth-first search that keeps the strongly connected components found
// so far on a stack, each with the union of the acceptance sets of its steps,
// and merges those that a step back closes into one (Couvreur, "On-the-fly
// verification of linear temporal logic", FM 1999; open_components.hpp). It
// stops at the first component that has every set, often long before all
// states are stored. Where we differ: the steps of a new state are looked at at
// once, not when the search comes back to them, so that a closing step counts
// as soon as it is known, and only steps to new states wait on the stack. With
// strong fairness, a component with every set is only a candidate
// (component_refinement.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "explore/state/limits.hpp"
#include "explore/store/growing_array.hpp"
#include "explore/store/state_store.hpp"
#include "ltl/product/component_refinement.hpp"
#include "ltl/product/fair_system.hpp"
#include "ltl/product/open_components.hpp"
#include "ltl/product/short_lasso.hpp"
#include "ltl/product/strong_fairness.hpp"

namespace btcheck {

// Over which states a run may be led into the component that was found: those
// the search has met, or any that lie nearer, which it then meets.
enum class WayIn : unsigned char { OverKnownStates, OverAllStates };

// A depth-first search for a reachable component with every acceptance set, and
// a part in which a run can stay and be strongly fair.
template <FairSystem System>
class AcceptingCycleSearch {
 public:
  // All must outlive the search.
  AcceptingCycleSearch(const System& system, const Limits& limits,
                       const StrongFairness& fairness = kEveryRunIsFair,
                       WayIn way_in = WayIn::OverKnownStates)
      : system_(system),
        limits_(limits),
        way_in_(way_in),
        store_(system.word_count()),
        present_(system.word_count()),
        marks_(fairness, store_),
        refinement_(system, store_, marks_) {}

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
  // A step of the state being expanded, its target not looked up yet.
  struct FoundStep {
    StateStore::Key key = 0;
    AcceptanceSet sets = 0;
  };
  struct WaitingStep {
    std::uint32_t sets;  // their number
    StateId target;
  };

  static constexpr int kMostRunsTold = 5;

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
        examine_growing();
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
    examine_growing();
    if (++progress_.expanded % kPollInterval == 0) poll();
  }

  // Computes the steps of a state, and only then looks their targets up, so
  // that the waits for memory overlap.
  void expand(StateId state) {
    store_.load(state, present_);
    found_.clear();
    system_.successors(present_,
                       [&](StateView target, Step, AcceptanceSet sets) {
                         const StateStore::Key key = store_.key(target, state);
                         store_.prefetch_slot(key);
                         found_.push_back({key, sets});
                       });
    for (const FoundStep& step : found_) store_.prefetch_pair(step.key);
    for (const FoundStep& step : found_) take_up(state, step);
  }

  // Takes up a step: it closes a cycle, waits for its new target to be entered,
  // or leads to a complete component and is dropped.
  void take_up(StateId from, const FoundStep& step) {
    const StateId id = store_.insert(step.key).id;
    if (index(id) >= numbers_.size()) numbers_.resize(index(id) + 1);
    progress_.transitions += id != from;
    const std::uint32_t number = numbers_[index(id)];
    if (number == kNew) {
      waiting_.push_back({set_numbers_.number(step.sets), id});
      ++path_.back().steps_waiting;
    } else if (number != kClosed) {
      close_cycle(number, step.sets);
    }
  }

  void close_cycle(std::uint32_t number, AcceptanceSet sets) {
    const AcceptanceSet all = system_.all_sets();
    if ((components_.merge(number, sets) & all) != all) return;
    if (marks_.has_conditions()) {
      candidates_.closed_cycle(components_.root());
    } else {
      result_.outcome = SearchOutcome::Found;
    }
  }

  // Takes the last state off the path, with its component if it is the root.
  void leave() {
    const StateId state = path_.back().state;
    path_.pop_back();
    const std::uint32_t root = components_.root();
    if (numbers_[index(state)] != root) return;
    if (marks_.has_conditions()) {
      if (candidates_.is_due_when_complete(root)) examine();
      if (result_.outcome != SearchOutcome::Empty) return;
    }
    components_.close();
    while (open_.size() >= root) {
      numbers_[index(open_.back())] = kClosed;
      open_.pop_back();
    }
  }

  // Looks for a fair part before the innermost component is complete.
  void examine_growing() {
    const std::uint32_t root = components_.root();
    if (marks_.has_conditions() &&
        candidates_.is_due(root, innermost().size())) {
      examine();
    }
  }

  void examine() {
    fair_part_ = refinement_.fair_part(
        innermost(), place_in_innermost(), [&](auto held) {
          examination_bytes_ = held;
          poll();
          return result_.outcome == SearchOutcome::Empty;
        });
    examination_bytes_ = 0;
    if (!fair_part_.empty()) result_.outcome = SearchOutcome::Found;
  }

  // The states of the innermost component.
  std::span<const StateId> innermost() const {
    return std::span(open_).subspan(components_.root() - 1);
  }

  // For states whose numbers are known; no place for those of other components.
  auto place_in_innermost() const {
    return [this, root = components_.root()](StateId state) {
      return numbers_[index(state)] - root;
    };
  }

  void poll() {
    if (result_.outcome != SearchOutcome::Empty) return;
    result_.stopped = limit_reached();
    if (result_.stopped != StopReason::None) {
      result_.outcome = SearchOutcome::GaveUp;
    }
  }

  StopReason limit_reached() {
    update_progress();
    const StopReason reason = limits_.reached(result_.progress);
    return progress_.states >= kMostStates ? StopReason::MaxStates : reason;
  }

  void update_progress() {
    progress_.states = store_.size();
    progress_.bytes = store_.bytes() + components_.bytes() + numbers_.bytes() +
                      open_.bytes() + path_.bytes() + waiting_.bytes();
    if (marks_.has_conditions()) {
      progress_.bytes +=
          marks_.bytes() + candidates_.bytes() + examination_bytes_;
    }
    result_.progress = progress_;
  }

  // Tells a short run into the component that was found, and around in it. With
  // conditions the shortest of some runs: after each, a part is looked for that
  // stays clear of the requests that it had to go out of its way for.
  void tell(std::span<const StateId> initial) {
    const auto is_known = [known = numbers_.size()](StateId state) {
      return index(state) < known;
    };
    const auto may_use = [&](StateId state) {
      return way_in_ == WayIn::OverAllStates || is_known(state);
    };
    const auto may_go_on = [&](auto) {
      return limit_reached() == StopReason::None;
    };
    ShortLasso teller(system_, store_, marks_);
    std::span<const StateId> part = innermost();
    if (marks_.has_conditions()) part = fair_part_;
    for (int told = 0; told < kMostRunsTold && !part.empty(); ++told) {
      std::vector<bool> inside(numbers_.size());
      for (const StateId state : part) inside[index(state)] = true;
      ShortRun run = teller.find(initial, may_use, [&](StateId state) {
        return is_known(state) && inside[index(state)];
      });
      if (!result_.lasso || length(run.lasso) < length(*result_.lasso)) {
        result_.lasso = std::move(run.lasso);
      }
      const std::size_t avoided = std::erase_if(fair_part_, [&](StateId state) {
        return run.detours.requests_in_vain(marks_.number(state));
      });
      if (avoided == 0 || teller.is_late()) return;
      fair_part_ = refinement_.fair_part_among(fair_part_, innermost().size(),
                                               place_in_innermost(), may_go_on);
      part = fair_part_;
    }
  }

  const System& system_;
  const Limits& limits_;
  WayIn way_in_;
  StateStore store_;
  StateVector present_;  // the state being expanded
  std::vector<FoundStep> found_;
  // By state: its place in open_ counted from 1, kNew or kClosed.
  GrowingArray<std::uint32_t> numbers_;
  GrowingArray<StateId> open_;  // states of the open components, as entered
  GrowingArray<Frame> path_;
  GrowingArray<WaitingStep> waiting_;
  SetNumbers set_numbers_;
  OpenComponents components_;
  // What follows is for strong fairness only.
  StateMarks marks_;
  ComponentRefinement<System> refinement_;
  Candidates candidates_;
  std::vector<StateId> fair_part_;  // once found
  std::size_t examination_bytes_ = 0;

  SearchProgress progress_;
  RunSearch result_;
};

// Drops the last word of each state: from runs of a product to the system's.
inline void drop_last_word(Lasso& lasso) {
  for (RunState& moment : lasso.prefix) moment.state.pop_back();
  for (RunState& moment : lasso.cycle) moment.state.pop_back();
}

// Searches a product for a fair run. The states of the lasso are those of the
// system: the state of the automaton, their last word, is dropped. `fairness`
// is asked of states of the product. All must outlive the call.
template <FairSystem System>
RunSearch find_accepting_cycle(
    const System& product, const Limits& limits,
    const StrongFairness& fairness = kEveryRunIsFair) {
  RunSearch result = AcceptingCycleSearch(product, limits, fairness).run();
  if (result.lasso) drop_last_word(*result.lasso);
  return result;
}

}  // namespace btcheck
