// SPDX-License-Identifier: MIT
//
// A short run into a component and around in it, through every set.
//
// The shortest accepting lasso is NP-hard to find where there are several
// acceptance sets (Clarke, Grumberg, McMillan and Zhao, DAC 1995, on fair
// witnesses), so this is the usual greedy way: breadth-first from the initial
// states to the nearest state of the component; from there breadth-first to
// the nearest step in a set not yet passed, until all are; then back by the
// shortest way. Where we go on: the same is tried from each state where a set
// was passed, and the shortest lasso in all is kept; turns of the cycle that
// add no set are cut out.
#pragma once

#include <cassert>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "explore/breadth_first_tree.hpp"
#include "explore/state_store.hpp"
#include "explore/transition_system.hpp"
#include "ltl/fair_system.hpp"

namespace btcheck {

// A step between two stored states.
struct Hop {
  StateId from{};
  StateId to{};
  Step step;
  AcceptanceSet sets = 0;
};

// The sets that the hops pass through.
AcceptanceSet union_of_sets(std::span<const Hop> hops);

// Removes turns from a closed walk as long as it passes through all of `sets`.
// Never removes the whole walk.
void cut_useless_turns(std::vector<Hop>& cycle, AcceptanceSet sets);

// Where the prefix ends with the state that also ends the cycle, drops it from
// the prefix and lets the cycle begin with it, unless it is the whole prefix.
void begin_cycle_at_entry(Lasso& lasso);

template <FairSystem System>
class ShortLasso {
 public:
  // States met that are not stored yet are added to the store.
  ShortLasso(const System& system, StateStore& store)
      : system_(system), store_(store), present_(system.word_count()) {}

  // `is_known` says which stored states may be used, `is_inside` which of them
  // are in the component: strongly connected, with every acceptance set, and
  // reachable over known states.
  template <class IsKnown, class IsInside>
  Lasso find(std::span<const StateId> initial, IsKnown&& is_known,
             IsInside&& is_inside) {
    const std::vector<Hop> prefix = way_in(initial, is_known, is_inside);
    const StateId entry = prefix.back().to;
    Parts best{prefix, around(entry, is_inside)};
    for (const StateId other : turning_points(best.cycle)) {
      Parts parts;
      parts.prefix = way_in(initial, is_known,
                            [&](StateId state) { return state == other; });
      if (parts.prefix.size() >= best.size()) continue;
      parts.cycle = around(other, is_inside);
      if (parts.size() < best.size()) best = std::move(parts);
    }
    return told(best);
  }

 private:
  // The prefix begins with a hop from its first state to itself.
  struct Parts {
    std::vector<Hop> prefix;
    std::vector<Hop> cycle;

    std::size_t size() const { return prefix.size() + cycle.size(); }
  };

  static constexpr std::size_t kMostTurningPoints = 8;

  // The shortest way from an initial state to one inside.
  template <class IsKnown, class IsInside>
  std::vector<Hop> way_in(std::span<const StateId> initial, IsKnown&& is_known,
                          IsInside&& is_inside) {
    for (const StateId state : initial) {
      if (is_inside(state)) return {Hop{state, state, {}, 0}};
    }
    std::vector<Hop> path = nearest(
        initial, is_known, [&](const Hop& hop) { return is_inside(hop.to); });
    path.insert(path.begin(), {path[0].from, path[0].from, {}, 0});
    return path;
  }

  // A short closed walk from `entry` through all sets.
  template <class IsInside>
  std::vector<Hop> around(StateId entry, IsInside&& is_inside) {
    std::vector<Hop> cycle;
    StateId present = entry;
    const auto append = [&](std::vector<Hop> leg) {
      cycle.insert(cycle.end(), leg.begin(), leg.end());
      present = cycle.back().to;
    };
    AcceptanceSet missing = system_.all_sets();
    while (missing != 0) {
      append(nearest({&present, 1}, is_inside, [&](const Hop& hop) {
        return (hop.sets & missing) != 0;
      }));
      missing &= ~union_of_sets(cycle);
    }
    if (cycle.empty() || present != entry) {
      append(nearest({&present, 1}, is_inside,
                     [&](const Hop& hop) { return hop.to == entry; }));
    }
    cut_useless_turns(cycle, system_.all_sets());
    return cycle;
  }

  // Where the cycle passes through a set it has not passed before.
  static std::vector<StateId> turning_points(std::span<const Hop> cycle) {
    std::vector<StateId> points;
    AcceptanceSet passed = 0;
    for (const Hop& hop : cycle) {
      if ((hop.sets & ~passed) != 0 && points.size() < kMostTurningPoints) {
        points.push_back(hop.from);
      }
      passed |= hop.sets;
    }
    return points;
  }

  // The shortest path from a source, over allowed states, whose last hop is a
  // goal. There must be one; it has at least one hop.
  template <class IsAllowed, class IsGoal>
  std::vector<Hop> nearest(std::span<const StateId> sources,
                           IsAllowed&& is_allowed, IsGoal&& is_goal) {
    BreadthFirstTree tree;
    std::vector<StateId> queue;
    for (const StateId source : sources) {
      if (tree.reach(source, source)) queue.push_back(source);
    }
    std::optional<Hop> goal;
    for (std::size_t i = 0; !goal && i < queue.size(); ++i) {
      for_each_hop(queue[i], [&](const Hop& hop) {
        if (!is_allowed(hop.to)) return;
        if (!goal && is_goal(hop)) goal = hop;
        if (tree.reach(hop.to, hop.from)) queue.push_back(hop.to);
      });
    }
    assert(goal);
    return hops_along(tree.path_to(goal->from), *goal);
  }

  // The path as hops, and one more at its end.
  std::vector<Hop> hops_along(std::span<const StateId> path, const Hop& last) {
    std::vector<Hop> hops;
    for (std::size_t i = 1; i < path.size(); ++i) {
      std::optional<Hop> found;
      for_each_hop(path[i - 1], [&](const Hop& hop) {
        if (!found && hop.to == path[i]) found = hop;
      });
      assert(found);
      hops.push_back(*found);
    }
    hops.push_back(last);
    return hops;
  }

  template <class Visit>
  void for_each_hop(StateId from, Visit&& visit) {
    store_.load(from, present_);
    system_.successors(present_,
                       [&](StateView target, Step step, AcceptanceSet sets) {
                         visit(Hop{from, store_.insert(target).id, step, sets});
                       });
  }

  // The run. Where it can, the cycle begins with the state it is entered by.
  Lasso told(const Parts& parts) const {
    Lasso lasso;
    for (const Hop& hop : parts.prefix) lasso.prefix.push_back(reached(hop));
    for (const Hop& hop : parts.cycle) lasso.cycle.push_back(reached(hop));
    lasso.closing = parts.cycle.front().step;
    begin_cycle_at_entry(lasso);
    return lasso;
  }

  RunState reached(const Hop& hop) const {
    RunState moment{StateVector(store_.word_count()), hop.step};
    store_.load(hop.to, moment.state);
    return moment;
  }

  const System& system_;
  StateStore& store_;
  StateVector present_;
};

}  // namespace btcheck
