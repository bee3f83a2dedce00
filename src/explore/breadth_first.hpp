// SPDX-License-Identifier: MIT
//
// Reachability, breadth first: every path it tells is a shortest one.
//
// States are numbered as they are found, so the queue is nothing but the range
// of numbers not yet expanded.
#pragma once

#include <cstdint>

#include "explore/reachability.hpp"

namespace btcheck {

template <TransitionSystem System>
class BreadthFirst : public Reachability<System> {
 public:
  using Reachability<System>::Reachability;

  // To be called once.
  template <class Visitor>
  ReachabilityResult run(Visitor& visitor) {
    this->store_initial(
        [&](StateId state) { this->tree_.reach(state, state); });
    std::size_t level_end = this->store_.size();
    std::uint32_t next = 0;
    for (; next < this->store_.size(); ++next) {
      if (next == level_end) {
        level_end = this->store_.size();
        ++this->progress_.depth;
      }
      if (next % kPollInterval == 0 && !this->may_go_on(next, visitor, 0)) {
        break;
      }
      const StateId state{next};
      const GoOn go_on =
          this->expand(state, visitor, [&](StateId target, bool is_new) {
            if (is_new) this->tree_.reach(target, state);
          });
      if (go_on == GoOn::No) {
        ++next;
        break;
      }
    }
    return this->result(next, visitor, 0, next == this->store_.size());
  }
};

template <class System>
BreadthFirst(const System&, const Limits&) -> BreadthFirst<System>;

}  // namespace btcheck
