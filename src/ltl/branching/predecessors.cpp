// SPDX-License-Identifier: MIT
//
// The reverse adjacency is made by counting: how many steps enter each state,
// where each state's sources therefore begin, and then every source into its
// place. Going backwards is a search with a stack that starts at one target
// after the other; each step is looked at once.
#include "ltl/branching/predecessors.hpp"

namespace btcheck {

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
  for (auto s = target.find_first(); s != StateSet::npos;
       s = target.find_next(s)) {
    for (const std::uint32_t source : of(s)) found.set(source);
  }
  return found;
}

StateSet Predecessors::leading_to(const StateSet& hold,
                                  const StateSet& target) const {
  StateSet found = target;
  std::vector<std::uint32_t> waiting;
  const auto look_behind = [&](std::size_t state) {
    for (const std::uint32_t source : of(state)) {
      if (hold[source] && !found.test_set(source)) waiting.push_back(source);
    }
  };
  for (auto s = target.find_first(); s != StateSet::npos;
       s = target.find_next(s)) {
    look_behind(s);
    while (!waiting.empty()) {
      const std::uint32_t state = waiting.back();
      waiting.pop_back();
      look_behind(state);
    }
  }
  return found;
}

}  // namespace btcheck
