// SPDX-License-Identifier: MIT
//
// Both questions are answered with strongly connected components (Tarjan
// 1972, with an explicit stack). "Can still reach": components come out with
// successors first, so one pass over them carries the answer back along all
// steps. "Zero-time loop": a component of the steps that take no time which a
// step of a tree node stays inside.
#include "explore/stored_graph.hpp"

#include <algorithm>
#include <cassert>

namespace btcheck {

void StoredGraph::add(StateId from, Step step, StateId to) {
  assert(index(from) + 1 >= first_.size());
  while (first_.size() <= index(from)) first_.push_back(arcs_.size());
  arcs_.push_back(index(to) | (step.elapsed != 0 ? kTime : 0) |
                  (step.progress ? 0 : kFree));
}

void StoredGraph::close(std::size_t states) {
  while (first_.size() <= states) first_.push_back(arcs_.size());
}

template <class Follow>
std::vector<std::uint32_t> StoredGraph::components(Follow follow) const {
  constexpr std::uint32_t kUnseen = 0xffffffff;
  struct Frame {
    std::uint32_t state;
    std::uint64_t next_arc;
  };
  std::vector<std::uint32_t> component(size(), kUnseen);
  std::vector<std::uint32_t> low(size(), kUnseen);  // kUnseen: not visited
  std::vector<std::uint32_t> open;
  std::vector<Frame> path;
  std::uint32_t visited = 0;
  std::uint32_t closed = 0;
  std::vector<std::uint32_t> order(size(), 0);
  auto enter = [&](std::uint32_t state) {
    order[state] = low[state] = visited++;
    open.push_back(state);
    path.push_back({state, first_[state]});
  };
  for (std::uint32_t start = 0; start < size(); ++start) {
    if (low[start] != kUnseen) continue;
    enter(start);
    while (!path.empty()) {
      Frame& frame = path.back();
      if (frame.next_arc < first_[frame.state + 1]) {
        const Arc step = arc(frame.next_arc++);
        if (!follow(step)) continue;
        if (low[step.target] == kUnseen) {
          enter(step.target);
        } else if (component[step.target] == kUnseen) {
          low[frame.state] = std::min(low[frame.state], order[step.target]);
        }
        continue;
      }
      const std::uint32_t state = frame.state;
      path.pop_back();
      if (!path.empty()) {
        std::uint32_t& parent = low[path.back().state];
        parent = std::min(parent, low[state]);
      }
      if (low[state] != order[state]) continue;
      std::uint32_t member = 0;
      do {
        member = open.back();
        open.pop_back();
        component[member] = closed;
      } while (member != state);
      ++closed;
    }
  }
  return component;
}

std::vector<bool> StoredGraph::can_reach(const std::vector<bool>& goal) const {
  const std::vector<std::uint32_t> component =
      components([](const Arc&) { return true; });
  std::vector<std::uint32_t> by_component(size());
  for (std::uint32_t s = 0; s < size(); ++s) by_component[s] = s;
  std::stable_sort(by_component.begin(), by_component.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return component[a] < component[b];
                   });
  std::vector<bool> reaches(size(), false);  // by component
  for (const std::uint32_t state : by_component) {
    bool can = goal[state];
    for (std::uint64_t a = first_[state]; a < first_[state + 1] && !can; ++a) {
      can = reaches[component[arc(a).target]];
    }
    if (can) reaches[component[state]] = true;
  }
  std::vector<bool> result(size());
  for (std::uint32_t s = 0; s < size(); ++s) result[s] = reaches[component[s]];
  return result;
}

std::optional<StateId> StoredGraph::on_zero_time_loop() const {
  const std::vector<std::uint32_t> component =
      components([](const Arc& step) { return !step.takes_time; });
  for (std::uint32_t state = 0; state < size(); ++state) {
    for (std::uint64_t a = first_[state]; a < first_[state + 1]; ++a) {
      const Arc step = arc(a);
      if (!step.takes_time && step.progress &&
          component[step.target] == component[state]) {
        return StateId{state};
      }
    }
  }
  return std::nullopt;
}

}  // namespace btcheck
