// SPDX-License-Identifier: MIT
//
// Tarjan's algorithm with an explicit stack.
#include "ltl/buchi/components.hpp"

#include <algorithm>
#include <utility>

namespace btcheck {

namespace {

// One depth-first search; results are collected by component.
class Search {
 public:
  explicit Search(const BuchiAutomaton& automaton)
      : automaton_(automaton),
        number_(automaton.state_count(), 0),
        lowest_(automaton.state_count(), 0),
        is_open_(automaton.state_count(), false) {}

  std::vector<std::vector<std::uint32_t>> run() {
    enter(automaton_.initial);
    while (!path_.empty()) {
      const std::uint32_t state = path_.back().state;
      const auto& transitions = automaton_.transitions[state];
      if (path_.back().next == transitions.size()) {
        leave();
        continue;
      }
      const std::uint32_t target = transitions[path_.back().next++].target;
      if (number_[target] == 0) {
        enter(target);
      } else if (is_open_[target]) {
        lowest_[state] = std::min(lowest_[state], number_[target]);
      }
    }
    return std::move(components_);
  }

 private:
  struct Frame {
    std::uint32_t state;
    std::size_t next;  // the transition to follow next
  };

  void enter(std::uint32_t state) {
    number_[state] = lowest_[state] = ++last_number_;
    is_open_[state] = true;
    open_.push_back(state);
    path_.push_back({state, 0});
  }

  void leave() {
    const std::uint32_t state = path_.back().state;
    path_.pop_back();
    if (!path_.empty()) {
      std::uint32_t& lowest = lowest_[path_.back().state];
      lowest = std::min(lowest, lowest_[state]);
    }
    if (lowest_[state] != number_[state]) return;
    const auto first = std::find(open_.rbegin(), open_.rend(), state).base();
    components_.emplace_back(first - 1, open_.end());
    open_.erase(first - 1, open_.end());
    for (const std::uint32_t member : components_.back()) {
      is_open_[member] = false;
    }
  }

  const BuchiAutomaton& automaton_;
  std::vector<std::uint32_t> number_;  // in order of discovery, from 1
  std::vector<std::uint32_t> lowest_;
  std::vector<bool> is_open_;
  std::vector<std::uint32_t> open_;
  std::vector<Frame> path_;
  std::uint32_t last_number_ = 0;
  std::vector<std::vector<std::uint32_t>> components_;
};

}  // namespace

Components::Components(const BuchiAutomaton& automaton)
    : component_(automaton.state_count(), kUnreachable),
      members_(Search(automaton).run()),
      cyclic_(members_.size()),
      accepting_(members_.size()) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    for (const std::uint32_t state : members_[i]) {
      component_[state] = static_cast<std::uint32_t>(i);
    }
  }
  judge(automaton);
}

void Components::judge(const BuchiAutomaton& automaton) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    AcceptanceSet sets = 0;
    for (const std::uint32_t state : members_[i]) {
      for (const BuchiTransition& transition : automaton.transitions[state]) {
        if (!is_inside(state, transition)) continue;
        cyclic_[i] = true;
        sets |= transition.accepting;
      }
    }
    accepting_[i] = cyclic_[i] && sets == automaton.all_sets();
  }
}

}  // namespace btcheck
