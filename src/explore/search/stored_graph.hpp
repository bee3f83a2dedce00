// SPDX-License-Identifier: MIT
//
// The steps of a state space, kept: for questions that need them twice.
#pragma once

#include <boost/dynamic_bitset.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "explore/store/growing_array.hpp"

namespace btcheck {

// A set of states by number, one bit each.
using StateSet = boost::dynamic_bitset<std::uint64_t>;

template <class Visit>
void for_each(const StateSet& states, Visit visit) {
  for (auto s = states.find_first(); s != StateSet::npos;
       s = states.find_next(s)) {
    visit(static_cast<std::uint32_t>(s));
  }
}

// A step without its source: the target and what kind of step it is.
class Arc {
 public:
  Arc(Step step, StateId to)
      : bits_(index(to) | (step.elapsed != 0 ? kTime : 0) |
              (step.progress ? 0 : kFree)) {}

  std::uint32_t target() const { return bits_ & ~(kTime | kFree); }
  bool takes_time() const { return (bits_ & kTime) != 0; }
  bool is_progress() const { return (bits_ & kFree) == 0; }

 private:
  static constexpr std::uint32_t kTime = 1u << 31;
  static constexpr std::uint32_t kFree = 1u << 30;

  std::uint32_t bits_;
};

// Steps by source, four bytes each. Sources must be added in ascending order,
// as a breadth-first search expands them; at most 2^30 states.
class StoredGraph {
 public:
  // Instead of a component: the state was left out.
  static constexpr std::uint32_t kOutside = 0xffffffff;

  StoredGraph() { first_.push_back(0); }

  void add(StateId from, Step step, StateId to);
  // Called once all steps are in.
  void close(std::size_t states);

  std::size_t size() const { return first_.size() - 1; }
  std::size_t arc_count() const { return arcs_.size(); }
  // With the room that a question about components will take.
  std::size_t bytes() const {
    return first_.bytes() + arcs_.bytes() + size() * kAskedBytes;
  }
  std::span<const Arc> arcs(std::uint32_t state) const {
    return {arcs_.data() + first_[state], arcs_.data() + first_[state + 1]};
  }

  // By state: whether some run leads from it to a state in `goal`.
  std::vector<bool> can_reach(const std::vector<bool>& goal) const;

  // A state on a cycle that no time step is part of and that contains an edge
  // of a tree node; the one of least number, if there is any.
  std::optional<StateId> on_zero_time_loop() const;

  // The states of a shortest such cycle through `state`, which comes first;
  // the last one leads back to it. Where two states are joined by several
  // steps, one of a tree node is meant. Empty: there is no such cycle.
  std::vector<StateId> zero_time_loop(StateId state) const;

  // The strongly connected components of the graph cut down to the states
  // `within`, by state; kOutside for the others. A component that another
  // leads to has the smaller number, and the numbers begin at 0. Needs 4 bytes
  // a state, and 16 for each on the longest path of the search.
  std::vector<std::uint32_t> components(const StateSet& within) const;

  // A shortest path from `from` into `goal`, both ends included, of which all
  // states but the last lie in `through`; just `from` when it is a goal
  // itself. Empty: there is none. Needs 8 bytes for each state it sees.
  std::vector<StateId> shortest_path(StateId from, const StateSet& through,
                                     const StateSet& goal) const;

  // A shortest path of at least one step from `from` to `to`, both ends
  // included, that takes some step of progress and stays `within`. Empty:
  // there is none. As to memory see shortest_path.
  std::vector<StateId> path_with_progress(StateId from, StateId to,
                                          const StateSet& within) const;

 private:
  // The components of the steps that `follow` admits, over all states.
  template <class Follow>
  std::vector<std::uint32_t> components_along(Follow follow) const;
  // path_with_progress over the steps that `follow` admits.
  template <class Follow>
  std::vector<StateId> progress_along(StateId from, StateId to,
                                      Follow follow) const;

  static constexpr std::size_t kAskedBytes = 8;

  GrowingArray<std::uint64_t> first_;  // by state: its first arc
  GrowingArray<Arc> arcs_;
};

}  // namespace btcheck
