// SPDX-License-Identifier: MIT
//
// Storing steps, and the questions that strongly connected components answer.
// "Can still reach": components come out with successors first, so one pass
// over them carries the answer back along all steps. "Zero-time loop": a
// component of the steps that take no time which a step of a tree node stays
// inside. The components are Tarjan's (1972), with an explicit stack and one
// number for each state, as Pearce does it (2016): open states count upwards
// from 1, components downwards from the greatest number, so one comparison also
// tells whether a state is already in a component.
#include "explore/search/stored_graph.hpp"

#include <algorithm>
#include <cassert>

namespace btcheck {

namespace {

class ComponentSearch {
 public:
  explicit ComponentSearch(const StoredGraph& graph)
      : graph_(graph), number_(graph.size(), kUnseen) {}

  template <class Follow>
  void search_from(std::uint32_t start, Follow follow) {
    if (number_[start] != kUnseen) return;
    enter(start);
    while (!path_.empty()) {
      Frame& frame = path_.back();
      if (frame.next == end_of(frame.state)) {
        leave();
        continue;
      }
      const Arc arc = *frame.next;
      if (!follow(arc)) {
        ++frame.next;
      } else if (number_[arc.target()] == kUnseen) {
        enter(arc.target());  // and look at this arc once more afterwards
      } else {
        ++frame.next;
        if (number_[arc.target()] < number_[frame.state]) {
          number_[frame.state] = number_[arc.target()];
          frame.is_root = false;
        }
      }
    }
  }

  // The first component becomes 0, a state never entered kOutside.
  std::vector<std::uint32_t> take_components() {
    for (std::uint32_t& number : number_) number = ~number;
    return std::move(number_);
  }

 private:
  static constexpr std::uint32_t kUnseen = 0;
  static_assert(~kUnseen == StoredGraph::kOutside);

  struct Frame {
    const Arc* next;
    std::uint32_t state;
    bool is_root;  // nothing older was found to be reachable
  };

  void enter(std::uint32_t state) {
    number_[state] = ++last_seen_;
    path_.push_back({graph_.arcs(state).data(), state, true});
  }

  const Arc* end_of(std::uint32_t state) const {
    const std::span<const Arc> arcs = graph_.arcs(state);
    return arcs.data() + arcs.size();
  }

  void leave() {
    const std::uint32_t state = path_.back().state;
    const bool is_root = path_.back().is_root;
    path_.pop_back();
    if (!is_root) {
      open_.push_back(state);
      return;
    }
    while (!open_.empty() && number_[open_.back()] >= number_[state]) {
      number_[open_.back()] = next_component_;
      open_.pop_back();
    }
    number_[state] = next_component_--;
  }

  const StoredGraph& graph_;
  std::vector<std::uint32_t> number_;  // by state
  std::vector<std::uint32_t> open_;    // left, and in no component yet
  std::vector<Frame> path_;
  std::uint32_t last_seen_ = kUnseen;
  std::uint32_t next_component_ = ~std::uint32_t{0};
};

}  // namespace

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
  ComponentSearch search(*this);
  for (std::uint32_t s = 0; s < size(); ++s) search.search_from(s, follow);
  return search.take_components();
}

std::vector<std::uint32_t> StoredGraph::components(
    const StateSet& within) const {
  assert(within.size() == size());
  ComponentSearch search(*this);
  const auto follow = [&](Arc arc) { return within[arc.target()]; };
  for (auto s = within.find_first(); s != StateSet::npos;
       s = within.find_next(s)) {
    search.search_from(static_cast<std::uint32_t>(s), follow);
  }
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

// Shortest paths in a stored graph, breadth first. The queue is kept and each
// entry remembers which one it came from: memory grows with what is seen, not
// with the graph. Where a path has to make progress, the search runs over
// pairs of a state and whether progress was made on the way; state numbers
// leave a bit free for that.

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
