// SPDX-License-Identifier: MIT
//
// P leadsto Q within [from, to]: is every P answered in time?
//
// An observer guesses which occurrence of P is the one that is not answered
// and from then on counts the units of time. The guess makes the observer
// nondeterministic but small: one idle state and one for each age, where a
// deterministic one would remember a set of ages. It has seen a violation when
// time passes `to`, or when time can stand still for ever while an answer is
// due (the idea of Abid, Dal Zilio and Le Botlan, "Real-time specification
// patterns and tools", FMICS 2012, whose observers are guessing automata too;
// ours is not a process of the network but a layer around it). The search is
// breadth-first, so the first violation found has the fewest steps; the
// cycles where time stands still are searched afterwards, among the states
// where an answer is due.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "explore/breadth_first_tree.hpp"
#include "explore/limits.hpp"
#include "explore/state_store.hpp"
#include "ltl/accepting_cycle.hpp"
#include "ltl/fair_system.hpp"
#include "ltl/short_lasso.hpp"

namespace btcheck {

// Every state with the proposition `trigger` at time t is followed, itself
// included, by one with the proposition `answer` at a time from t + from to
// t + to.
struct BoundedResponse {
  PropositionSet trigger = 1;  // one bit
  PropositionSet answer = 2;   // one bit
  int from = 0;                // 0 <= from <= to, units of time
  int to = 0;
};

// Found: an occurrence of `trigger` without an answer. The lasso is a finite
// run (empty cycle) that ends with the step of time too much, or an infinite
// one in whose cycle no time passes.
struct ResponseSearch : RunSearch {
  // Where the occurrence is: number of the state in the run, prefix and cycle
  // counted through, from 0.
  std::size_t trigger_index = 0;
  // Over all that was searched: states of the system with the trigger, and
  // the longest time an answer took, -1 when there was none.
  std::uint64_t triggers = 0;
  int longest_answer = -1;
};

// What the last word of an observed state says.
class ResponseMode {
 public:
  explicit ResponseMode(const BoundedResponse& response)
      : response_(response) {}

  static constexpr Word kIdle = 0;
  Word pending(Word age) const { return age + 1; }
  Word answered() const { return Word(response_.to) + 2; }
  Word violated() const { return Word(response_.to) + 3; }

  bool is_pending(Word mode) const {
    return mode != kIdle && mode < answered();
  }
  bool triggers(PropositionSet label) const {
    return (label & response_.trigger) != 0;
  }

  // The mode at a state with this label, `elapsed` after an answer was due for
  // mode - 1 units of time.
  Word after(Word mode, Word elapsed, PropositionSet label) const {
    assert(is_pending(mode));
    const Word age = mode - 1 + elapsed;
    if (age > Word(response_.to)) return violated();
    if (age >= Word(response_.from) && (label & response_.answer) != 0) {
      return answered();
    }
    return pending(age);
  }

 private:
  BoundedResponse response_;
};

// A system with the observer around it: one word more, its mode.
template <TransitionSystem System>
class ObservedSystem {
 public:
  ObservedSystem(const System& system, const BoundedResponse& response)
      : system_(system), mode_(response) {}

  const ResponseMode& mode() const { return mode_; }
  std::size_t word_count() const { return system_.word_count() + 1; }
  bool triggers(StateView state) const {
    return mode_.triggers(system_.label(state.first(state.size() - 1)));
  }

  template <class Found>
  void initial_states(Found&& found) const {
    Buffer observed(word_count());
    system_.initial_states(
        [&](StateView state) { watch(observed, state, found); });
  }

  // Calls stepped(StateView target, Step). A target whose mode is answered()
  // or violated() has no successors of interest.
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    const Word mode = state.back();
    Buffer observed(state.size());
    system_.successors(state.first(state.size() - 1), [&](StateView target,
                                                          Step step) {
      if (mode == ResponseMode::kIdle) {
        watch(observed, target, [&](StateView next) { stepped(next, step); });
        return;
      }
      std::copy(target.begin(), target.end(), observed.begin());
      observed.back() = mode_.after(mode, step.elapsed, system_.label(target));
      stepped(view(observed), step);
    });
  }

 private:
  using Buffer = boost::container::small_vector<Word, 32>;

  static StateView view(const Buffer& words) {
    return {words.data(), words.size()};
  }

  // Stays idle at a state, and where it triggers also begins to wait.
  template <class Found>
  void watch(Buffer& observed, StateView state, Found&& found) const {
    std::copy(state.begin(), state.end(), observed.begin());
    observed.back() = ResponseMode::kIdle;
    found(view(observed));
    const PropositionSet label = system_.label(state);
    if (!mode_.triggers(label)) return;
    observed.back() = mode_.after(mode_.pending(0), 0, label);
    found(view(observed));
  }

  const System& system_;
  ResponseMode mode_;
};

// The stored states where an answer is due, with the steps that take no time;
// all are initial. A fair run makes progress for ever.
template <TransitionSystem System>
class TimeStandingStill {
 public:
  TimeStandingStill(const ObservedSystem<System>& observed,
                    const StateStore& store,
                    const std::vector<StateId>& pending)
      : observed_(observed), store_(store), pending_(pending) {}

  std::size_t word_count() const { return observed_.word_count(); }
  AcceptanceSet all_sets() const { return 1; }

  template <class Found>
  void initial_states(Found&& found) const {
    StateVector state(word_count());
    for (const StateId id : pending_) {
      store_.load(id, state);
      found(StateView(state));
    }
  }

  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    observed_.successors(state, [&](StateView target, Step step) {
      if (step.elapsed == 0 && observed_.mode().is_pending(target.back())) {
        stepped(target, step, AcceptanceSet{step.progress});
      }
    });
  }

 private:
  const ObservedSystem<System>& observed_;
  const StateStore& store_;
  const std::vector<StateId>& pending_;
};

template <TransitionSystem System>
class BoundedResponseSearch {
 public:
  // The system and the limits must outlive the search.
  BoundedResponseSearch(const System& system, const BoundedResponse& response,
                        const Limits& limits)
      : observed_(system, response),
        limits_(limits),
        store_(observed_.word_count()),
        present_(observed_.word_count()) {
    assert(0 <= response.from && response.from <= response.to);
  }

  // To be called once. The states of the lasso are those of the system.
  ResponseSearch run() {
    observed_.initial_states([&](StateView state) {
      if (is_answer(state)) {
        note_answer(0);
      } else {
        arrive(state, std::nullopt);
      }
    });
    while (next_ < store_.size() && may_go_on()) expand(StateId{next_++});
    update_progress();
    if (violation_) tell_time_out();
    if (result_.outcome == SearchOutcome::Empty) search_standing_still();
    if (result_.lasso) drop_last_word(*result_.lasso);
    return std::move(result_);
  }

 private:
  static constexpr std::uint64_t kMostStates = UINT32_MAX - 2;

  bool is_answer(StateView state) const {
    return state.back() == observed_.mode().answered();
  }

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
    result_.progress.bytes =
        store_.bytes() + tree_.bytes() + pending_.capacity() * sizeof(StateId);
  }

  void expand(StateId state) {
    if (next_ > layer_end_) {
      layer_end_ = static_cast<std::uint32_t>(store_.size());
      ++result_.progress.depth;
    }
    store_.load(state, present_);
    const Word mode = present_.back();
    if (mode == ResponseMode::kIdle && observed_.triggers(present_)) {
      ++result_.triggers;
    }
    ++result_.progress.expanded;
    observed_.successors(present_, [&](StateView target, Step step) {
      if (is_answer(target)) {
        note_answer(mode == ResponseMode::kIdle ? 0 : mode - 1 + step.elapsed);
      } else {
        result_.progress.transitions += arrive(target, state) != state;
      }
    });
  }

  StateId arrive(StateView state, std::optional<StateId> from) {
    const auto [id, is_new] = store_.insert(state);
    if (!is_new) return id;
    tree_.reach(id, from.value_or(id));
    if (observed_.mode().is_pending(state.back())) pending_.push_back(id);
    if (state.back() == observed_.mode().violated() && !violation_) {
      violation_ = id;
    }
    return id;
  }

  void note_answer(Word age) {
    result_.longest_answer =
        std::max(result_.longest_answer, static_cast<int>(age));
  }

  void tell_time_out() {
    result_.outcome = SearchOutcome::Found;
    result_.lasso = Lasso{run_to(*violation_), {}, {}};
    locate_trigger();
  }

  // Looks for a cycle in which an answer is due and no time passes.
  void search_standing_still() {
    const TimeStandingStill still(observed_, store_, pending_);
    Limits rest = limits_;
    rest.max_bytes -= std::min(rest.max_bytes, result_.progress.bytes);
    RunSearch search = AcceptingCycleSearch(still, rest).run();
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
    locate_trigger();
  }

  void locate_trigger() {
    const auto is_idle = [](const RunState& moment) {
      return moment.state.back() == ResponseMode::kIdle;
    };
    const std::vector<RunState>& prefix = result_.lasso->prefix;
    result_.trigger_index = static_cast<std::size_t>(
        std::find_if_not(prefix.begin(), prefix.end(), is_idle) -
        prefix.begin());
  }

  // The run with the fewest steps to a stored state.
  std::vector<RunState> run_to(StateId state) {
    std::vector<RunState> run;
    StateVector target(store_.word_count());
    for (const StateId id : tree_.path_to(state)) {
      store_.load(id, target);
      const Step step = run.empty() ? Step{} : step_to(run.back(), target);
      run.push_back({target, step});
    }
    return run;
  }

  Step step_to(const RunState& from, StateView target) const {
    std::optional<Step> found;
    observed_.successors(from.state, [&](StateView state, Step step) {
      if (!found && std::equal(state.begin(), state.end(), target.begin())) {
        found = step;
      }
    });
    assert(found);
    return *found;
  }

  ObservedSystem<System> observed_;
  const Limits& limits_;
  StateStore store_;
  StateVector present_;  // the state being expanded
  BreadthFirstTree tree_;
  std::vector<StateId> pending_;  // stored states where an answer is due
  std::optional<StateId> violation_;
  std::uint32_t next_ = 0;       // the state to be expanded next
  std::uint32_t layer_end_ = 0;  // one past the last state of this depth
  ResponseSearch result_;
};

// Searches for a run with an occurrence of the trigger that is not answered in
// time. The limits must outlive the call.
template <TransitionSystem System>
ResponseSearch find_late_response(const System& system,
                                  const BoundedResponse& response,
                                  const Limits& limits) {
  return BoundedResponseSearch(system, response, limits).run();
}

}  // namespace btcheck
