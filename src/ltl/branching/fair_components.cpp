// SPDX-License-Identifier: MIT
//
// A component is good when a step of progress stays inside and no condition is
// requested in it without being granted in it. Where one is, no fair run of
// the component may see the states that request it infinitely often: they are
// taken out, and what remains falls into smaller components. In those that
// condition is no longer requested; hence the number of rounds.
#include "ltl/branching/ctl.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace btcheck {

// The reverse adjacency is made by counting: how many steps enter each state,
// where each state's sources therefore begin, and then every source into its
// place. Going backwards is a search with a stack that starts at one target
// after the other; each step is looked at once.
Predecessors::Predecessors(const StoredGraph& graph)
    : first_(graph.size() + 1), sources_(graph.arc_count()) {
  const auto states = static_cast<std::uint32_t>(graph.size());
  for (std::uint32_t s = 0; s < states; ++s) {
    for (const Arc arc : graph.arcs(s)) ++first_[arc.target()];
  }
  // Now each entry is moved to the end of its state's sources …
  for (std::uint32_t s = 0; s < states; ++s) first_[s + 1] += first_[s];
  // … and, source by source, back to their beginning.
  for (std::uint32_t s = states; s-- > 0;) {
    for (const Arc arc : graph.arcs(s)) sources_[--first_[arc.target()]] = s;
  }
}

StateSet Predecessors::before(const StateSet& target) const {
  StateSet found(target.size());
  for_each(target, [&](std::uint32_t s) {
    for (const std::uint32_t source : of(s)) found.set(source);
  });
  return found;
}

StateSet Predecessors::leading_to(const StateSet& hold,
                                  const StateSet& target) const {
  StateSet found = target;
  std::vector<std::uint32_t> waiting;
  const auto look_behind = [&](std::uint32_t state) {
    for (const std::uint32_t source : of(state)) {
      if (hold[source] && !found.test_set(source)) waiting.push_back(source);
    }
  };
  for_each(target, [&](std::uint32_t s) {
    look_behind(s);
    while (!waiting.empty()) {
      const std::uint32_t state = waiting.back();
      waiting.pop_back();
      look_behind(state);
    }
  });
  return found;
}

namespace {

// One round of the refinement; what it knows of components is bits by their
// number.
class Round {
 public:
  Round(const StoredGraph& graph, StateSet states)
      : graph_(graph),
        states_(std::move(states)),
        component_(graph.components(states_)) {}

  // Drops the components that no run can stay in and make progress.
  void keep_moving() {
    StateSet moving(graph_.size());
    for_each(states_, [&](std::uint32_t s) {
      for (const Arc arc : graph_.arcs(s)) {
        if (arc.is_progress() && component_[arc.target()] == component_[s]) {
          moving.set(component_[s]);
        }
      }
    });
    for_each(states_, [&](std::uint32_t s) {
      if (!moving[component_[s]]) states_.reset(s);
    });
  }

  // Drops requesting states where nothing is granted, and returns what remains
  // of the components that have lost some. What one condition takes away, the
  // next need not count as granted: no fair run sees it for ever.
  StateSet refine(std::span<const FairnessSets> conditions) {
    StateSet touched(graph_.size());
    for (const FairnessSets& condition : conditions) {
      StateSet refused = components_of(condition.requested);
      refused -= components_of(condition.granted);
      if (refused.none()) continue;
      touched |= refused;
      for_each(states_ & condition.requested, [&](std::uint32_t s) {
        if (refused[component_[s]]) states_.reset(s);
      });
    }
    StateSet remains(graph_.size());
    for_each(states_, [&](std::uint32_t s) {
      if (touched[component_[s]]) remains.set(s);
    });
    return remains;
  }

  const StateSet& states() const { return states_; }

 private:
  StateSet components_of(const StateSet& some) const {
    StateSet found(graph_.size());
    for_each(states_ & some,
             [&](std::uint32_t s) { found.set(component_[s]); });
    return found;
  }

  const StoredGraph& graph_;
  StateSet states_;
  std::vector<std::uint32_t> component_;
};

bool makes_progress(const StoredGraph& graph, std::span<const StateId> walk) {
  for (std::size_t i = 0; i + 1 < walk.size(); ++i) {
    for (const Arc arc : graph.arcs(index(walk[i]))) {
      if (arc.is_progress() && arc.target() == index(walk[i + 1])) return true;
    }
  }
  return false;
}

}  // namespace

StateSet fair_components(const StoredGraph& graph, const StateSet& within,
                         std::span<const FairnessSets> conditions) {
  StateSet fair(graph.size());
  StateSet undecided = within;
  while (undecided.any()) {
    Round round(graph, std::move(undecided));
    round.keep_moving();
    undecided = round.refine(conditions);
    fair |= round.states() - undecided;
  }
  return fair;
}

std::vector<StateId> fair_cycle(const StoredGraph& graph,
                                const StateSet& fair_components, StateId state,
                                std::span<const FairnessSets> conditions) {
  assert(fair_components[index(state)]);
  const std::vector<std::uint32_t> component =
      graph.components(fair_components);
  StateSet mine(graph.size());
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    if (component[s] == component[index(state)]) mine.set(s);
  }
  std::vector<StateId> walk{state};
  const auto append = [&](const std::vector<StateId>& leg) {
    assert(!leg.empty() && leg.front() == walk.back());
    walk.insert(walk.end(), leg.begin() + 1, leg.end());
  };
  for (const auto& [requested, granted] : conditions) {
    const auto grants = [&set = granted](StateId s) { return set[index(s)]; };
    if (mine.intersects(requested) && std::ranges::none_of(walk, grants)) {
      append(graph.shortest_path(walk.back(), mine, mine & granted));
    }
  }
  StateSet start(graph.size());
  start.set(index(state));
  append(makes_progress(graph, walk)
             ? graph.shortest_path(walk.back(), mine, start)
             : graph.path_with_progress(walk.back(), state, mine));
  walk.pop_back();
  return walk;
}

}  // namespace btcheck
