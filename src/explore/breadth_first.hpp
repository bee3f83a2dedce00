// SPDX-License-Identifier: MIT
//
// Reachability, breadth first: every path it tells is a shortest one.
//
// States are numbered as they are found, so the queue is nothing but the
// range of numbers not yet expanded, and the only thing kept beside the
// visited set is the number of the state each was reached from (four bytes).
// One search serves any number of questions: a visitor is shown each state
// and each step and says when it has seen enough.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "explore/breadth_first_tree.hpp"
#include "explore/limits.hpp"
#include "explore/state_store.hpp"
#include "explore/transition_system.hpp"

namespace btcheck {

enum class GoOn : std::uint8_t { Yes, No };

// What a search shows to who runs it. Every member may be hidden by one of the
// same name.
struct BreadthFirstVisitor {
  // A step from the state being expanded. The target is stored already.
  void stepped(StateId /*from*/, Step, StateId /*to*/) {}
  // A state with all its steps known. `is_dead`: none but an idle one.
  GoOn expanded(StateId, StateView, bool /*is_dead*/) { return GoOn::Yes; }
  // Memory held by the visitor, for the limit.
  std::size_t bytes() const { return 0; }
};

struct BreadthFirstResult {
  StopReason stopped = StopReason::None;
  bool is_complete = false;  // every reachable state was expanded
  SearchProgress progress;
};

template <TransitionSystem System>
class BreadthFirst {
 public:
  BreadthFirst(const System& system, const Limits& limits)
      : system_(system),
        limits_(limits),
        store_(system.word_count()),
        present_(system.word_count()) {}

  // To be called once.
  template <class Visitor>
  BreadthFirstResult run(Visitor& visitor) {
    system_.initial_states([&](StateView state) {
      const StateId id = store_.insert(state).id;
      tree_.reach(id, id);
    });
    std::uint32_t level_end = static_cast<std::uint32_t>(store_.size());
    std::uint32_t next = 0;
    for (; next < store_.size(); ++next) {
      if (next == level_end) {
        level_end = static_cast<std::uint32_t>(store_.size());
        ++progress_.depth;
      }
      if (next % kPollInterval == 0 && !may_go_on(next, visitor)) break;
      if (expand(StateId{next}, visitor) == GoOn::No) {
        ++next;
        break;
      }
    }
    update_progress(next, visitor);
    return {stopped_, next == store_.size() && stopped_ == StopReason::None,
            progress_};
  }

  const StateStore& store() const { return store_; }

  // A shortest run from an initial state to a stored one.
  std::vector<RunState> path_to(StateId state) const {
    std::vector<RunState> run;
    StateVector words(system_.word_count());
    for (const StateId id : tree_.path_to(state)) {
      store_.load(id, words);
      Step step;
      if (!run.empty()) step = step_between(run.back().state, words);
      run.push_back({words, step});
    }
    return run;
  }

 private:
  template <class Visitor>
  GoOn expand(StateId state, Visitor& visitor) {
    store_.load(state, present_);
    bool is_dead = true;
    system_.successors(present_, [&](StateView target, Step step) {
      const auto [id, is_new] = store_.insert(target);
      if (is_new) tree_.reach(id, state);
      if (step.edge != kTimeStep || id != state) {
        is_dead = false;
        ++progress_.transitions;
      }
      visitor.stepped(state, step, id);
    });
    return visitor.expanded(state, present_, is_dead);
  }

  template <class Visitor>
  bool may_go_on(std::uint32_t expanded, const Visitor& visitor) {
    update_progress(expanded, visitor);
    stopped_ = limits_.reached(progress_);
    if (progress_.states >= kMostStates) stopped_ = StopReason::MaxStates;
    return stopped_ == StopReason::None;
  }

  template <class Visitor>
  void update_progress(std::uint32_t expanded, const Visitor& visitor) {
    progress_.states = store_.size();
    progress_.expanded = expanded;
    progress_.bytes = store_.bytes() + tree_.bytes() + visitor.bytes();
  }

  // The first step that leads from one state to another.
  Step step_between(const StateVector& from, const StateVector& to) const {
    Step found;
    bool is_found = false;
    system_.successors(from, [&](StateView target, Step step) {
      if (is_found || !std::equal(target.begin(), target.end(), to.begin())) {
        return;
      }
      found = step;
      is_found = true;
    });
    return found;
  }

  static constexpr std::uint64_t kMostStates = UINT32_MAX - kPollInterval * 64;

  const System& system_;
  const Limits& limits_;
  StateStore store_;
  BreadthFirstTree tree_;
  StateVector present_;
  SearchProgress progress_;
  StopReason stopped_ = StopReason::None;
};

}  // namespace btcheck
