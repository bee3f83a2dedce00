// SPDX-License-Identifier: MIT
//
// Reachability, breadth first: every path it tells is a shortest one.
//
// States are numbered as they are found, so the queue is nothing but the range
// of numbers not yet expanded. They are expanded in small batches: first the
// successors of all are computed, then they are looked up, so that the waits
// for memory, which at some million states are most of the time, overlap. The
// order in which states are found is the same as one by one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "explore/search/reachability.hpp"

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
    level_end_ = this->store_.size();
    while (next_ < this->store_.size()) {
      if (!expand_batch(visitor)) break;
    }
    return this->result(next_, visitor, 0, next_ == this->store_.size());
  }

 private:
  using Expansion = typename Reachability<System>::Expansion;
  static constexpr std::size_t kBatch = 32;
  static_assert(kPollInterval % kBatch == 0);

  // Expands the next states in order; false when the search is to end.
  template <class Visitor>
  bool expand_batch(Visitor& visitor) {
    if (next_ >= next_poll_) {
      next_poll_ = next_ + kPollInterval;
      if (!this->may_go_on(next_, visitor, 0)) return false;
    }
    const std::size_t count =
        std::min(kBatch, this->store_.size() - std::size_t{next_});
    for (std::size_t i = 0; i < count; ++i) {
      this->compute(StateId{next_ + static_cast<std::uint32_t>(i)}, batch_[i],
                    visitor);
    }
    for (std::size_t i = 0; i < count; ++i) this->prefetch(batch_[i]);
    for (std::size_t i = 0; i < count; ++i) {
      if (next_ == level_end_) {
        level_end_ = this->store_.size();
        ++this->progress_.depth;
      }
      const StateId state{next_++};
      const GoOn go_on =
          this->commit(batch_[i], visitor, [&](StateId target, bool is_new) {
            if (is_new) {
              this->tree_.reach(target, state);
            }
          });
      if (go_on == GoOn::No) return false;
    }
    return true;
  }

  std::array<Expansion, kBatch> batch_;
  std::uint32_t next_ = 0;       // the state to be expanded next
  std::uint64_t next_poll_ = 0;  // when to ask the limits
  std::size_t level_end_ = 0;    // one past the last state of this depth
};

template <class System>
BreadthFirst(const System&, const Limits&) -> BreadthFirst<System>;

}  // namespace btcheck
