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
// add no set are cut out. What the cycle requests under strong fairness and
// does not grant is gone for in the same way, the nearest grant first.
#pragma once

#include <cassert>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "explore/search/stored_run.hpp"
#include "explore/state/transition_system.hpp"
#include "explore/store/state_store.hpp"
#include "ltl/product/fair_system.hpp"
#include "ltl/product/strong_fairness.hpp"

namespace btcheck {

// A step between two stored states.
struct Hop {
  StateId from{};
  StateId to{};
  Step step;
  AcceptanceSet sets = 0;
  std::uint32_t marks = MarkTable::kNothing;  // of `to`, within a cycle
};

// What a walk passes.
struct Passage {
  AcceptanceSet sets = 0;
  ConditionTally conditions;

  explicit Passage(const MarkTable& table) : conditions(table) {}

  // One hop more. True when it is in a set, or grants a condition, that none
  // before it did.
  bool add(const Hop& hop) {
    const bool is_new = (hop.sets & ~sets) != 0;
    sets |= hop.sets;
    return conditions.add(hop.marks) || is_new;
  }
  // Repeated for ever, the walk is accepted.
  bool is_enough(AcceptanceSet all_sets) const {
    return (sets & all_sets) == all_sets && conditions.is_fair();
  }
};

// Removes turns from a closed walk as long as what is left is enough. Never
// removes the whole walk.
void cut_useless_turns(std::vector<Hop>& cycle, AcceptanceSet all_sets,
                       const MarkTable& table);

// Where the prefix ends with the state that also ends the cycle, drops it from
// the prefix and lets the cycle begin with it, unless it is the whole prefix.
void begin_cycle_at_entry(Lasso& lasso);

// States and steps.
inline std::size_t length(const Lasso& lasso) {
  return lasso.prefix.size() + lasso.cycle.size();
}

// A run, and what its cycle requested and had to go out of its way to grant.
struct ShortRun {
  Lasso lasso;
  ConditionTally detours;
};

template <FairSystem System>
class ShortLasso {
 public:
  // States met that are not stored yet are added to the store.
  ShortLasso(const System& system, StateStore& store, StateMarks& marks)
      : system_(system),
        store_(store),
        marks_(marks),
        present_(system.word_count()) {}

  // `is_known` says which stored states may be used, `is_inside` which of them
  // are in the component: strongly connected, with every acceptance set, a
  // grant of each condition requested, and reachable over known states.
  template <class IsKnown, class IsInside>
  ShortRun find(std::span<const StateId> initial, IsKnown&& is_known,
                IsInside&& is_inside) {
    const std::vector<Hop> prefix = way_in(initial, is_known, is_inside);
    const StateId entry = prefix.back().to;
    Parts best{prefix, around(entry, is_inside)};
    for (const StateId other : turning_points(best.around.cycle)) {
      if (is_late()) break;
      std::vector<Hop> way = way_in(
          initial, is_known, [&](StateId state) { return state == other; });
      if (way.size() >= best.size()) continue;
      Parts parts{std::move(way), around(other, is_inside)};
      if (parts.size() < best.size()) best = std::move(parts);
    }
    return {told(best), std::move(best.around.detours)};
  }

  // So many grants were gone for that a shorter run is not worth the search.
  bool is_late() const {
    return marks_.has_conditions() && visits_ > kMostVisits;
  }

 private:
  struct Around {
    std::vector<Hop> cycle;
    ConditionTally detours;  // as in ShortRun
  };
  // The prefix begins with a hop from its first state to itself.
  struct Parts {
    std::vector<Hop> prefix;
    Around around;

    std::size_t size() const { return prefix.size() + around.cycle.size(); }
  };

  static constexpr std::size_t kMostTurningPoints = 8;
  static constexpr std::size_t kMostVisits = std::size_t{1} << 20;

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

  // A short closed walk from `entry` through all sets, strongly fair.
  template <class IsInside>
  Around around(StateId entry, IsInside&& is_inside) {
    const AcceptanceSet all = system_.all_sets();
    Passage passed(marks_.table());
    Around result{{}, ConditionTally(marks_.table())};
    StateId present = entry;
    const auto go = [&](auto&& is_goal) {
      for (Hop& hop : nearest({&present, 1}, is_inside, is_goal)) {
        hop.marks = marks_.number(hop.to);
        passed.add(hop);
        result.cycle.push_back(hop);
      }
      present = result.cycle.back().to;
    };
    while ((all & ~passed.sets) != 0) {
      go([&](const Hop& hop) { return (hop.sets & all & ~passed.sets) != 0; });
    }
    do {
      result.detours.add_unanswered(passed.conditions);
      while (!passed.conditions.is_fair()) {
        go([&](const Hop& hop) {
          return passed.conditions.grants_missing(marks_.number(hop.to));
        });
      }
      if (result.cycle.empty() || present != entry) {
        go([&](const Hop& hop) { return hop.to == entry; });
      }
    } while (!passed.conditions.is_fair());
    cut_useless_turns(result.cycle, all, marks_.table());
    return result;
  }

  // Where the cycle passes a set or a grant that it has not passed before.
  std::vector<StateId> turning_points(std::span<const Hop> cycle) const {
    std::vector<StateId> points;
    Passage passed(marks_.table());
    for (const Hop& hop : cycle) {
      if (passed.add(hop) && points.size() < kMostTurningPoints) {
        points.push_back(hop.from);
      }
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
    for (std::size_t i = 0; !goal && i < queue.size(); ++i, ++visits_) {
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
    for (const Hop& hop : parts.around.cycle) {
      lasso.cycle.push_back(reached(hop));
    }
    lasso.closing = parts.around.cycle.front().step;
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
  StateMarks& marks_;
  StateVector present_;
  std::size_t visits_ = 0;  // of states, by all breadth-first searches
};

}  // namespace btcheck
