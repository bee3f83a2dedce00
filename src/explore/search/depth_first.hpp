// SPDX-License-Identifier: MIT
//
// Reachability, depth first: goes deep at once, where breadth-first first sees
// everything near. Finds some run, not a shortest one.
//
// A state's successors are stored when it is entered and wait on a stack; the
// one on top is entered next unless it has been entered meanwhile. The parent
// of a state is the one it was entered from, so the paths told are those of
// the search.
#pragma once

#include <cstdint>

#include "explore/search/reachability.hpp"
#include "explore/store/growing_array.hpp"

namespace btcheck {

// The same questions and answers as BreadthFirst.
template <TransitionSystem System>
class DepthFirst : public Reachability<System> {
 public:
  using Reachability<System>::Reachability;

  // To be called once.
  template <class Visitor>
  ReachabilityResult run(Visitor& visitor) {
    this->store_initial([&](StateId state) {
      waiting_.push_back({state, state, 0});
    });
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      if (!this->tree_.reach(next.state, next.from)) continue;
      if (expanded_++ % kPollInterval == 0 &&
          !this->may_go_on(expanded_ - 1, visitor, own_bytes())) {
        --expanded_;
        break;
      }
      this->progress_.depth =
          std::max<std::uint64_t>(this->progress_.depth, next.depth);
      this->compute(next.state, expansion_, visitor);
      const GoOn go_on =
          this->commit(expansion_, visitor, [&](StateId target, bool is_new) {
            // One that is stored but not entered yet may as well be entered
            // from here.
            if (is_new || !this->tree_.is_reached(target)) {
              waiting_.push_back({target, next.state, next.depth + 1});
            }
          });
      if (go_on == GoOn::No) {
        waiting_.push_back(next);
        break;
      }
    }
    return this->result(expanded_, visitor, own_bytes(), waiting_.empty());
  }

 private:
  struct Waiting {
    StateId state;
    StateId from;
    std::uint32_t depth;
  };

  std::size_t own_bytes() const { return waiting_.bytes(); }

  GrowingArray<Waiting> waiting_;
  typename Reachability<System>::Expansion expansion_;
  std::uint64_t expanded_ = 0;
};

template <class System>
DepthFirst(const System&, const Limits&) -> DepthFirst<System>;

}  // namespace btcheck
