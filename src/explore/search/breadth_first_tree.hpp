// SPDX-License-Identifier: MIT
//
// Who was reached first from whom in a breadth-first search.
//
// Four bytes for each stored state: the number of the state it was reached
// from. The step between the two is not kept; when a path is told, the system
// is asked for it again. Paths are short and states are many, so this costs
// nothing that can be measured and saves twelve bytes for each state.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "explore/store/growing_array.hpp"

namespace btcheck {

class BreadthFirstTree {
 public:
  // Reaches a state from another, or a root from itself; false when it has
  // been reached before.
  bool reach(StateId state, StateId from) {
    const std::uint32_t number = index(state);
    if (number >= parents_.size()) parents_.resize(number + 1, kUnreached);
    if (parents_[number] != kUnreached) return false;
    parents_[number] = index(from);
    return true;
  }

  bool is_reached(StateId state) const {
    return index(state) < parents_.size() &&
           parents_[index(state)] != kUnreached;
  }

  // The state it was reached from; a root from itself.
  StateId parent(StateId state) const {
    return StateId{parents_[index(state)]};
  }

  // The states from a root to `state`, both included.
  std::vector<StateId> path_to(StateId state) const {
    std::vector<StateId> path{state};
    while (parents_[index(path.back())] != index(path.back())) {
      assert(parents_[index(path.back())] != kUnreached);
      path.push_back(StateId{parents_[index(path.back())]});
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  std::size_t bytes() const { return parents_.bytes(); }

 private:
  static constexpr std::uint32_t kUnreached = UINT32_MAX;

  GrowingArray<std::uint32_t> parents_;
};

}  // namespace btcheck
