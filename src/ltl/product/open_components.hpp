// SPDX-License-Identifier: MIT
//
// The stack of components of a path-based depth-first search.
//
// Each component that may still grow is kept with the union of the acceptance
// sets of its steps; a step back into the path merges all components from
// there on into one (Gabow, "Path-based depth-first search for strong and
// biconnected components", 2000; with acceptance sets: Couvreur, FM 1999).
// The search of a whole system uses it (accepting_cycle.hpp), and the search
// for parts of one component (component_refinement.hpp).
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// Numbers for the acceptance sets that occur together, which are few: the
// searches keep four bytes for a step instead of eight.
class SetNumbers {
 public:
  std::uint32_t number(AcceptanceSet sets) {
    if (sets == sets_[last_]) return last_;
    const auto next = static_cast<std::uint32_t>(sets_.size());
    const auto [place, is_new] = numbers_.emplace(sets, next);
    if (is_new) sets_.push_back(sets);
    return last_ = place->second;
  }
  AcceptanceSet operator[](std::uint32_t number) const { return sets_[number]; }

 private:
  std::vector<AcceptanceSet> sets_{0};
  std::unordered_map<AcceptanceSet, std::uint32_t> numbers_{{0, 0}};
  std::uint32_t last_ = 0;
};

// The components that are not known to be complete, outermost first. States
// are numbered from 1 along the search; a component is named by its lowest.
class OpenComponents {
 public:
  // A state of its own, entered by a step in the sets `incoming`.
  void open(std::uint32_t number, AcceptanceSet incoming) {
    assert(stack_.empty() || stack_.back().root < number);
    stack_.push_back({number, numbers_.number(incoming), numbers_.number(0)});
  }

  // A step in the sets `closing` leads back to the state `number`: all
  // components from there on are one. Returns the sets of its steps.
  AcceptanceSet merge(std::uint32_t number, AcceptanceSet closing) {
    while (stack_.back().root > number) {
      closing |= numbers_[stack_.back().incoming];
      closing |= numbers_[stack_.back().inside];
      stack_.pop_back();
      assert(!stack_.empty());
    }
    closing |= numbers_[stack_.back().inside];
    stack_.back().inside = numbers_.number(closing);
    return closing;
  }

  // Forgets the innermost component.
  void close() { stack_.pop_back(); }

  // The lowest number in the innermost component, and the sets of its steps.
  std::uint32_t root() const { return stack_.back().root; }
  AcceptanceSet sets() const { return numbers_[stack_.back().inside]; }

  std::size_t bytes() const { return stack_.capacity() * sizeof(Component); }

 private:
  struct Component {
    std::uint32_t root;
    std::uint32_t incoming;  // number of the sets of the step that entered it
    std::uint32_t inside;    // and of those of the steps within it
  };

  std::vector<Component> stack_;
  SetNumbers numbers_;
};

}  // namespace btcheck
