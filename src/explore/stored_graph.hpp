// SPDX-License-Identifier: MIT
//
// The steps of a state space, kept: for questions that need them twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "explore/transition_system.hpp"

namespace btcheck {

// Steps by source, four bytes each: the target's number and what kind of step
// it is. Sources must be added in ascending order, as a breadth-first search
// expands them; at most 2^30 states.
class StoredGraph {
 public:
  void add(StateId from, Step step, StateId to);
  // Called once all steps are in.
  void close(std::size_t states);

  std::size_t size() const { return first_.size() - 1; }
  std::size_t bytes() const {
    return first_.capacity() * sizeof(std::uint64_t) +
           arcs_.capacity() * sizeof(std::uint32_t);
  }

  // By state: whether some run leads from it to a state in `goal`.
  std::vector<bool> can_reach(const std::vector<bool>& goal) const;

  // A state on a cycle that no time step is part of and that contains an edge
  // of a tree node; the one of least number, if there is any.
  std::optional<StateId> on_zero_time_loop() const;

 private:
  struct Arc {
    std::uint32_t target;
    bool takes_time;
    bool progress;
  };
  static constexpr std::uint32_t kTime = 1u << 31;
  static constexpr std::uint32_t kFree = 1u << 30;

  Arc arc(std::uint64_t number) const {
    const std::uint32_t bits = arcs_[number];
    return {bits & ~(kTime | kFree), (bits & kTime) != 0, (bits & kFree) == 0};
  }

  // Numbers the strongly connected components of the steps that `follow`
  // admits: a component that another leads to has the smaller number.
  template <class Follow>
  std::vector<std::uint32_t> components(Follow follow) const;

  std::vector<std::uint64_t> first_{0};  // by state: its first arc
  std::vector<std::uint32_t> arcs_;
};

}  // namespace btcheck
