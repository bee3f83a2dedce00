// SPDX-License-Identifier: MIT
//
// Storing steps, and the questions that strongly connected components answer.
// "Can still reach": components come out with successors first, so one pass
// over them carries the answer back along all steps. "Zero-time loop": a
// component of the steps that take no time which a step of a tree node stays
// inside. The components are Tarjan's (1972), with an explicit stack and one
// number for each state, as Pearce does it (2016): below the states that are
// still open count upwards, components downwards from the greatest number, so
// "already in a component" is no question of its own.
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

}  // namespace btcheck
