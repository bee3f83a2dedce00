// SPDX-License-Identifier: MIT
//
// Is a real-time pattern violated? The observed system, and its search.
//
// The search is breadth-first, so the first violation found has the fewest
// steps. What is left are runs on which an answer is due for ever (time stands
// still, or the interval has no end): fair cycles of stored states where one is
// due.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "explore/search/stored_run.hpp"
#include "explore/state/limits.hpp"
#include "explore/store/growing_array.hpp"
#include "explore/store/state_store.hpp"
#include "ltl/product/accepting_cycle.hpp"
#include "ltl/product/fair_system.hpp"
#include "ltl/product/product.hpp"
#include "ltl/product/short_lasso.hpp"
#include "ltl/timed/timed_pattern.hpp"

namespace btcheck {

// Found: the pattern is violated. The lasso is a finite run (empty cycle) that
// ends with the step that makes it so (the step of time too much, or the
// forbidden state), or an infinite one in whose cycle the answer stays due.
struct PatternRun : RunSearch {
  // Where the violated occurrence is: number of the state in the run, prefix
  // and cycle counted through, from 0; the last one when there is none.
  std::size_t trigger_index = 0;
  // Over all that was searched: states of the system with the trigger, or
  // steps that open a scope without one.
  std::uint64_t triggers = 0;
  // Over all that was searched: whether the scope opens, and closes again.
  bool opens = false;
  bool closes = false;
  // The longest time an answer took, -1 when there was none. Answers are only
  // waited for by the demands Answer and FirstAnswer.
  int longest_answer = -1;
};

// A system with the observer around it: one word more, its mode, and one more
// proposition, `due_bit`, true where is_due(mode). A satisfied state has no
// steps.
template <TransitionSystem System>
class ObservedSystem {
 public:
  // The proposition number `due` must not be used by the system.
  ObservedSystem(const System& system, const TimedPattern& pattern,
                 int due = kMaxPropositions - 1)
      : system_(system),
        observer_(pattern),
        due_bit_(PropositionSet{1} << due) {}

  const PatternObserver& observer() const { return observer_; }
  std::size_t word_count() const { return system_.word_count() + 1; }
  PropositionSet label(StateView state) const {
    const PropositionSet own = system_.label(state.first(state.size() - 1));
    return own | (observer_.is_due(state.back()) ? due_bit_ : 0);
  }

  // Propositions of steps, where the system has them.
  bool has_step_propositions() const requires MayHaveStepPropositions<System> {
    return system_.has_step_propositions();
  }
  PropositionSet step_label(StateView from, StateView to, Step step)
      const requires MayHaveStepPropositions<System> {
    return system_.step_label(from.first(from.size() - 1),
                              to.first(to.size() - 1), step);
  }

  template <class Found>
  void initial_states(Found&& found) const {
    Buffer observed(word_count());
    system_.initial_states([&](StateView state) {
      std::ranges::copy(state, observed.begin());
      observer_.follow(PatternObserver::kShut, 0, system_.label(state),
                       [&](Word mode) {
                         observed.back() = mode;
                         found(view_of(observed));
                       });
    });
  }

  // Calls stepped(StateView target, Step).
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    const Word mode = state.back();
    if (mode == PatternObserver::kSatisfied) return;
    Buffer observed(state.size());
    system_.successors(
        state.first(state.size() - 1), [&](StateView target, Step step) {
          std::ranges::copy(target, observed.begin());
          observer_.follow(mode, step.elapsed, system_.label(target),
                           [&](Word next) {
                             observed.back() = next;
                             stepped(view_of(observed), step);
                           });
        });
  }

 private:
  using Buffer = boost::container::small_vector<Word, 32>;

  const System& system_;
  PatternObserver observer_;
  PropositionSet due_bit_;
};

// The stored states where an answer is due, with the steps between them; all
// are initial. A fair run makes progress for ever.
template <TransitionSystem System>
class StayingDue {
 public:
  StayingDue(const ObservedSystem<System>& observed, const StateStore& store,
             const GrowingArray<StateId>& due)
      : observed_(observed), store_(store), due_(due) {}

  std::size_t word_count() const { return observed_.word_count(); }
  AcceptanceSet all_sets() const { return 1; }

  template <class Found>
  void initial_states(Found&& found) const {
    StateVector state(word_count());
    for (const StateId id : due_) {
      store_.load(id, state);
      found(StateView(state));
    }
  }

  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    observed_.successors(state, [&](StateView target, Step step) {
      if (observed_.observer().is_due(target.back())) {
        stepped(target, step, AcceptanceSet{step.progress});
      }
    });
  }

 private:
  const ObservedSystem<System>& observed_;
  const StateStore& store_;
  const GrowingArray<StateId>& due_;
};

template <TransitionSystem System>
class TimedPatternSearch {
 public:
  // The system and the limits must outlive the search.
  TimedPatternSearch(const System& system, const TimedPattern& pattern,
                     const Limits& limits)
      : observed_(system, pattern),
        limits_(limits),
        store_(observed_.word_count()),
        present_(observed_.word_count()) {}

  // Once. The states of the lasso are those of the system.
  PatternRun run() {
    observed_.initial_states(
        [&](StateView state) { meet(state, {}, std::nullopt); });
    while (next_ < store_.size() && may_go_on()) expand(StateId{next_++});
    update_progress();
    if (violation_) {
      result_.outcome = SearchOutcome::Found;
      result_.lasso = Lasso{run_to(*violation_), {}, {}};
    }
    if (result_.outcome == SearchOutcome::Empty) search_staying_due();
    if (result_.lasso) {
      locate_trigger();
      drop_last_word(*result_.lasso);
    }
    return std::move(result_);
  }

 private:
  static constexpr std::uint64_t kMostStates = UINT32_MAX - 2;

  bool may_go_on() {
    if (violation_) return false;
    if ((next_ + 1) % kPollInterval != 0) return true;
    update_progress();
    StopReason reason = limits_.reached(result_.progress);
    if (store_.size() >= kMostStates) reason = StopReason::MaxStates;
    if (reason == StopReason::None) return true;
    result_.outcome = SearchOutcome::GaveUp;
    result_.stopped = reason;
    return false;
  }

  void update_progress() {
    result_.progress.states = store_.size();
    result_.progress.bytes = store_.bytes() + tree_.bytes() + due_.bytes();
  }

  void expand(StateId state) {
    if (next_ > layer_end_) {
      layer_end_ = static_cast<std::uint32_t>(store_.size());
      ++result_.progress.depth;
    }
    store_.load(state, present_);
    result_.triggers +=
        present_.back() == PatternObserver::kIdle &&
        observed_.observer().triggers(observed_.label(present_));
    ++result_.progress.expanded;
    observed_.successors(present_, [&](StateView target, Step step) {
      meet(target, step, state);
    });
  }

  // A state is found, by a step from an expanded one or as an initial one.
  void meet(StateView state, Step step, std::optional<StateId> from) {
    const Word mode = from ? present_.back() : PatternObserver::kShut;
    const bool was_pending = PatternObserver::is_pending(mode);
    result_.triggers += mode == PatternObserver::kShut &&
                        PatternObserver::has_begun(state.back()) &&
                        observed_.observer().pattern().trigger == 0;
    note_scope(state);
    if (state.back() == PatternObserver::kSatisfied) {
      const Word age = was_pending ? PatternObserver::age(mode) : 0;
      note_answer(age + step.elapsed * was_pending, state);
      return;
    }
    const auto [id, is_new] = store_.insert(state);
    result_.progress.transitions += from && id != *from;
    if (!is_new) return;
    tree_.reach(id, from.value_or(id));
    if (observed_.observer().is_due(state.back())) due_.push_back(id);
    if (state.back() == PatternObserver::kViolated && !violation_) {
      violation_ = id;
    }
  }

  void note_scope(StateView state) {
    if (state.back() == PatternObserver::kShut) return;
    result_.opens = true;
    const PropositionSet closing = observed_.observer().pattern().closing;
    if (closing == 0 || result_.closes) return;
    result_.closes = (observed_.label(state) & closing) != 0;
  }

  // A state that satisfies may also close the scope, and is no answer then.
  void note_answer(Word age, StateView state) {
    if (!observed_.observer().waits_for_answer()) return;
    const TimedPattern& pattern = observed_.observer().pattern();
    const PropositionSet label = observed_.label(state);
    const bool is_answer =
        (label & pattern.answer) != 0 && (label & pattern.closing) == 0;
    if (!is_answer || pattern.to == kNoEnd) return;
    result_.longest_answer =
        std::max(result_.longest_answer, static_cast<int>(age));
  }

  // Looks for a cycle in which an answer stays due.
  void search_staying_due() {
    const StayingDue staying(observed_, store_, due_);
    Limits rest = limits_;
    rest.max_bytes -= std::min(rest.max_bytes, result_.progress.bytes);
    RunSearch search = AcceptingCycleSearch(staying, rest).run();
    result_.outcome = search.outcome;
    result_.stopped = search.stopped;
    result_.progress.bytes += search.progress.bytes;
    if (!search.lasso) return;
    const StateView begin = search.lasso->prefix.front().state;
    std::vector<RunState> way = run_to(store_.insert(begin).id);
    way.insert(way.end(), search.lasso->prefix.begin() + 1,
               search.lasso->prefix.end());
    search.lasso->prefix = std::move(way);
    begin_cycle_at_entry(*search.lasso);
    result_.lasso = std::move(search.lasso);
  }

  void locate_trigger() {
    std::size_t at = 0;
    for (const auto* part : {&result_.lasso->prefix, &result_.lasso->cycle}) {
      for (const RunState& next : *part) {
        result_.trigger_index = at++;
        if (PatternObserver::has_begun(next.state.back())) return;
      }
    }
  }

  // The run with the fewest steps to a stored state.
  std::vector<RunState> run_to(StateId state) const {
    return run_along(observed_, store_, tree_.path_to(state));
  }

  ObservedSystem<System> observed_;
  const Limits& limits_;
  StateStore store_;
  StateVector present_;  // the state being expanded
  BreadthFirstTree tree_;
  GrowingArray<StateId> due_;  // stored states where an answer is due
  std::optional<StateId> violation_;
  std::uint32_t next_ = 0;       // the state to be expanded next
  std::uint32_t layer_end_ = 0;  // one past the last state of this depth
  PatternRun result_;
};

template <TransitionSystem System>
PatternRun find_violation(const System& system, const TimedPattern& pattern,
                          const Limits& limits) {
  return TimedPatternSearch(system, pattern, limits).run();
}

}  // namespace btcheck
