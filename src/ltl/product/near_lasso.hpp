// SPDX-License-Identifier: MIT
//
// A fair run that stays near where runs begin.
//
// A depth-first search finds a fair run early, but may have gone a long way to
// it. Once it is known that there is one, the system is searched again as far
// as breadth-first search has come, with twice as many states each time: the
// first part that holds a fair run has the least depth to within that factor,
// and the run told from it is short. All searches together cost little more
// than the last one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "explore/search/reachability.hpp"
#include "explore/state/limits.hpp"
#include "explore/store/state_store.hpp"
#include "ltl/product/accepting_cycle.hpp"
#include "ltl/product/fair_system.hpp"
#include "ltl/product/short_lasso.hpp"
#include "ltl/product/strong_fairness.hpp"

namespace btcheck {

// The states of a system with numbers below `count` in a store, and the steps
// between them.
template <FairSystem System>
class StoredPart {
 public:
  StoredPart(const System& system, const StateStore& store, std::size_t count)
      : system_(system), store_(store), count_(count) {}

  std::size_t word_count() const { return system_.word_count(); }
  AcceptanceSet all_sets() const { return system_.all_sets(); }

  template <class Found>
  void initial_states(Found&& found) const {
    system_.initial_states([&](StateView state) {
      if (is_inside(state)) found(state);
    });
  }
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    system_.successors(state,
                       [&](StateView target, Step step, AcceptanceSet sets) {
                         if (is_inside(target)) stepped(target, step, sets);
                       });
  }

 private:
  bool is_inside(StateView state) const {
    const auto id = store_.find(state);
    return id && index(*id) < count_;
  }

  const System& system_;
  const StateStore& store_;
  std::size_t count_;
};

template <FairSystem System>
class NearLasso : public ReachabilityVisitor {
 public:
  // All must outlive it.
  NearLasso(const System& system, const Limits& limits,
            const StrongFairness& fairness)
      : system_(system),
        limits_(limits),
        fairness_(fairness),
        search_(system, limits) {}

  // Nothing when there is none among the first `most` states, or after some ten
  // times as many steps, or a limit is reached before.
  std::optional<Lasso> find(std::size_t most) {
    most_ = most;
    search_.run(*this);
    return std::move(lasso_);
  }

  // For the search.
  void stepped(StateId, Step, StateId) { ++steps_; }
  GoOn expanded(StateId state, StateView, bool) {
    const std::size_t expanded = index(state) + 1;
    const bool is_last = expanded == search_.store().size();
    if (expanded < std::min(count_, most_) && !is_last) return GoOn::Yes;
    lasso_ = search_first(expanded);
    if (lasso_) lasso_ = least(count_ / 2, expanded, std::move(*lasso_));
    count_ *= 2;
    const bool is_enough =
        lasso_ || expanded >= most_ || steps_ >= kMostBranching * most_;
    return is_enough ? GoOn::No : GoOn::Yes;
  }

 private:
  static constexpr std::size_t kFirst = 64;
  static constexpr int kHalvings = 8;
  // Steps that lead from a state, on average: more of them take too long.
  static constexpr std::size_t kMostBranching = 10;

  // A fair run within the first `count` states.
  std::optional<Lasso> search_first(std::size_t count) const {
    const StoredPart part(system_, search_.store(), count);
    return AcceptingCycleSearch(part, limits_, fairness_, WayIn::OverAllStates)
        .run()
        .lasso;
  }

  // The run in the smallest part that has one, between `without` and `with`
  // states, to within a 256th of the difference.
  std::optional<Lasso> least(std::size_t without, std::size_t with,
                             Lasso lasso) const {
    for (int i = 0; i < kHalvings && with - without > 1; ++i) {
      const std::size_t middle = without + (with - without) / 2;
      if (auto found = search_first(middle)) {
        with = middle;
        if (length(*found) < length(lasso)) lasso = std::move(*found);
      } else {
        without = middle;
      }
    }
    return lasso;
  }

  const System& system_;
  const Limits& limits_;
  const StrongFairness& fairness_;
  BreadthFirst<System> search_;
  std::size_t most_ = 0;
  std::size_t count_ = kFirst;  // of states expanded before the next try
  std::size_t steps_ = 0;       // from the states expanded
  std::optional<Lasso> lasso_;
};

// How many states it is worth to look at for a shorter run than the one found:
// as many again as the first search stored, and enough where it stored few.
inline std::size_t worth_of_shortening(const RunSearch& first) {
  constexpr std::size_t kAlways = 30'000;
  return std::max(kAlways, static_cast<std::size_t>(first.progress.states));
}

// As find_accepting_cycle, but where there is a run a short one is looked for.
template <FairSystem System>
RunSearch find_short_run(const System& product, const Limits& limits,
                         const StrongFairness& fairness = kEveryRunIsFair) {
  RunSearch result = AcceptingCycleSearch(product, limits, fairness).run();
  if (!result.lasso) return result;
  auto near =
      NearLasso(product, limits, fairness).find(worth_of_shortening(result));
  if (near && length(*near) < length(*result.lasso)) {
    result.lasso = std::move(near);
  }
  drop_last_word(*result.lasso);
  return result;
}

}  // namespace btcheck
