// SPDX-License-Identifier: MIT
//
// Storing steps, and the questions that strongly connected components answer.
// "Can still reach": components come out with successors first, so one pass
// over them carries the answer back along all steps. "Zero-time loop": a
// component of the steps that take no time which a step of a tree node stays
// inside.
#include "explore/search/stored_graph.hpp"

#include <algorithm>
#include <cassert>

#include "explore/search/strong_components.hpp"

namespace btcheck {

void StoredGraph::add(StateId from, Step step, StateId to) {
  assert(index(from) + 1 >= first_.size());
  while (first_.size() <= index(from)) first_.push_back(arcs_.size());
  arcs_.push_back(Arc(step, to));
}

void StoredGraph::close(std::size_t states) {
  while (first_.size() <= states) first_.push_back(arcs_.size());
}

template <class Follow>
std::vector<std::uint32_t> StoredGraph::components_along(Follow follow) const {
  ComponentSearch search(size(), [this](std::uint32_t s) { return arcs(s); });
  for (std::uint32_t s = 0; s < size(); ++s) {
    search.search_from(
        s, [&](Arc arc) { return follow(arc) ? arc.target() : kOutside; });
  }
  return search.take_components();
}

std::vector<std::uint32_t> StoredGraph::components(
    const StateSet& within) const {
  assert(within.size() == size());
  ComponentSearch search(size(), [this](std::uint32_t s) { return arcs(s); });
  for_each(within, [&](std::uint32_t s) {
    search.search_from(s, [&](Arc arc) {
      return within[arc.target()] ? arc.target() : kOutside;
    });
  });
  return search.take_components();
}

std::vector<bool> StoredGraph::can_reach(const std::vector<bool>& goal) const {
  const std::vector<std::uint32_t> component =
      components_along([](Arc) { return true; });
  std::vector<std::uint32_t> by_component(size());
  for (std::uint32_t s = 0; s < size(); ++s) by_component[s] = s;
  std::stable_sort(by_component.begin(), by_component.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return component[a] < component[b];
                   });
  std::vector<bool> reaches(size(), false);  // by component
  for (const std::uint32_t state : by_component) {
    const std::span<const Arc> out = arcs(state);
    const bool can =
        goal[state] || std::any_of(out.begin(), out.end(), [&](Arc arc) {
          return reaches[component[arc.target()]];
        });
    if (can) reaches[component[state]] = true;
  }
  std::vector<bool> result(size());
  for (std::uint32_t s = 0; s < size(); ++s) result[s] = reaches[component[s]];
  return result;
}

std::optional<StateId> StoredGraph::on_zero_time_loop() const {
  const std::vector<std::uint32_t> component =
      components_along([](Arc arc) { return !arc.takes_time(); });
  for (std::uint32_t state = 0; state < size(); ++state) {
    for (const Arc arc : arcs(state)) {
      if (!arc.takes_time() && arc.is_progress() &&
          component[arc.target()] == component[state]) {
        return StateId{state};
      }
    }
  }
  return std::nullopt;
}

namespace {

// A breadth-first search over numbered places, each visited once. The queue is
// kept, and memory grows with what is seen, not with the graph.
class PathSearch {
 public:
  explicit PathSearch(std::size_t places) : seen_(places) {}

  // Places found from now on come from the place taken last.
  void found(std::uint32_t place) {
    if (seen_.test_set(place)) return;
    queue_.push_back({place, taken_});
  }
  bool has_next() const { return next_ < queue_.size(); }
  std::uint32_t take() {
    taken_ = next_++;
    return queue_[taken_].place;
  }

  // From the place that began it all to the one taken last; a state has so many
  // places.
  std::vector<StateId> path(std::uint32_t places_of_state) const {
    std::vector<StateId> states;
    for (std::uint32_t i = taken_; i != kStart; i = queue_[i].from) {
      states.push_back(StateId{queue_[i].place / places_of_state});
    }
    std::reverse(states.begin(), states.end());
    return states;
  }

 private:
  static constexpr std::uint32_t kStart = 0xffffffff;
  struct Entry {
    std::uint32_t place;
    std::uint32_t from;  // number of an entry, or kStart
  };

  StateSet seen_;
  std::vector<Entry> queue_;
  std::uint32_t next_ = 0;
  std::uint32_t taken_ = kStart;
};

// Where a path has to make progress, places are pairs of a state and whether
// progress was made on the way; state numbers leave a bit free for that.
std::uint32_t before_progress(std::uint32_t state) { return 2 * state; }
std::uint32_t after_progress(std::uint32_t state) { return 2 * state + 1; }
bool is_after_progress(std::uint32_t place) { return place % 2 != 0; }

}  // namespace

std::vector<StateId> StoredGraph::shortest_path(StateId from,
                                                const StateSet& through,
                                                const StateSet& goal) const {
  assert(through.size() == size() && goal.size() == size());
  PathSearch search(size());
  search.found(index(from));
  while (search.has_next()) {
    const std::uint32_t state = search.take();
    if (goal[state]) return search.path(1);
    if (!through[state]) continue;
    for (const Arc arc : arcs(state)) search.found(arc.target());
  }
  return {};
}

template <class Follow>
std::vector<StateId> StoredGraph::progress_along(StateId from, StateId to,
                                                 Follow follow) const {
  PathSearch search(2 * size());
  search.found(before_progress(index(from)));
  while (search.has_next()) {
    const std::uint32_t place = search.take();
    if (place == after_progress(index(to))) return search.path(2);
    for (const Arc arc : arcs(place / 2)) {
      if (!follow(arc)) continue;
      const bool progress = is_after_progress(place) || arc.is_progress();
      search.found(progress ? after_progress(arc.target())
                            : before_progress(arc.target()));
    }
  }
  return {};
}

std::vector<StateId> StoredGraph::path_with_progress(
    StateId from, StateId to, const StateSet& within) const {
  assert(within.size() == size() && within[index(from)]);
  return progress_along(from, to,
                        [&](Arc arc) { return within[arc.target()]; });
}

std::vector<StateId> StoredGraph::zero_time_loop(StateId state) const {
  std::vector<StateId> cycle =
      progress_along(state, state, [](Arc arc) { return !arc.takes_time(); });
  if (!cycle.empty()) cycle.pop_back();
  return cycle;
}

}  // namespace btcheck
