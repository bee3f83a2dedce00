// SPDX-License-Identifier: MIT
//
// Shortest paths in a stored graph, breadth first. The queue is kept and each
// entry remembers which one it came from: memory grows with what is seen, not
// with the graph. Where a path has to make progress, the search runs over
// pairs of a state and whether progress was made on the way; state numbers
// leave a bit free for that.
#include <algorithm>
#include <cassert>

#include "explore/search/stored_graph.hpp"

namespace btcheck {

namespace {

// A breadth-first search over numbered places, each visited once.
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

  // The places from the one that began it all to the one taken last.
  std::vector<std::uint32_t> path() const {
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = taken_; i != kStart; i = queue_[i].from) {
      places.push_back(queue_[i].place);
    }
    std::reverse(places.begin(), places.end());
    return places;
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

// Pairs as places.
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
    if (goal[state]) {
      std::vector<StateId> path;
      for (const std::uint32_t s : search.path()) path.push_back(StateId{s});
      return path;
    }
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
    if (place == after_progress(index(to))) {
      std::vector<StateId> path;
      for (const std::uint32_t p : search.path())
        path.push_back(StateId{p / 2});
      return path;
    }
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
