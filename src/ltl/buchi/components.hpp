// SPDX-License-Identifier: MIT
//
// The strongly connected components of a Büchi automaton.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// The components reachable from the initial state, numbered such that no
// transition leads to a component with a higher number (Tarjan 1972).
class Components {
 public:
  static constexpr std::uint32_t kUnreachable = UINT32_MAX;

  // The automaton is not empty.
  explicit Components(const BuchiAutomaton& automaton);

  std::size_t count() const { return members_.size(); }
  // The component of a state, or kUnreachable.
  std::uint32_t of(std::uint32_t state) const { return component_[state]; }
  const std::vector<std::uint32_t>& members(std::size_t component) const {
    return members_[component];
  }
  bool is_inside(std::uint32_t source, const BuchiTransition& t) const {
    return component_[source] == component_[t.target];
  }
  // A run can stay in it for ever and be accepted.
  bool is_accepting(std::size_t component) const {
    return accepting_[component];
  }
  // A run can stay in it for ever.
  bool has_cycle(std::size_t component) const { return cyclic_[component]; }

 private:
  std::vector<std::uint32_t> component_;  // by state
  std::vector<std::vector<std::uint32_t>> members_;
  std::vector<bool> cyclic_;
  std::vector<bool> accepting_;
};

}  // namespace btcheck
