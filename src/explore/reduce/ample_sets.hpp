// SPDX-License-Identifier: MIT
//
// Which steps of one automaton may be taken alone, ahead of all others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "explore/reduce/observed.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The static half of a partial-order reduction: read off the tables once.
//
// Let automaton A stand in a location that has a Rule, with an edge enabled and
// due, no timer due, no fault, and no rival of the rule a danger. Then
// the enabled edges of A, if `is_visible` is false for each of them, are an
// ample set: it is enough to explore these and to leave every other automaton's
// steps for later (Peled 1993; Clarke, Grumberg, Peled, Model Checking, chapter
// 10). Preserved are LTL without next step, dead states, whether an edge can
// ever fire, and at which unit of time each observed change happens. The
// argument stands in ample_sets.cpp.
class AmpleSets {
 public:
  // An automaton that may yet, before time passes, touch what the edges touch,
  // or call one that may: when it has been called, is not at rest, and stands
  // in one of these locations.
  struct Rival {
    AutomatonId automaton{};
    std::vector<bool> dangerous;  // by location
  };
  // When the edges of a location may be taken alone.
  struct Rule {
    bool may_be_ample = false;
    int due = 0;  // at which clock all edges are due; 0 where no clock runs
    std::vector<Rival> rivals;
  };

  AmpleSets(const Network& network, const Observed& observed);

  const Rule& rule(AutomatonId automaton, LocationId location) const {
    return rules_[first_location_[index(automaton)] + index(location)];
  }
  // Whether firing the edge can be noticed by a question.
  bool is_visible(std::uint32_t edge) const { return visible_[edge]; }
  // Who is likely to move after the edge: the child it calls, its parent where
  // it ends its turn, else itself.
  AutomatonId next_mover(std::uint32_t edge) const { return next_[edge]; }
  // Whether in every state at most one node's automaton can move: a tree
  // without a Parallel that calls its children side by side.
  bool is_sequential() const { return is_sequential_; }
  // Whether any location at all has a rule.
  bool empty() const {
    return std::ranges::none_of(rules_, &Rule::may_be_ample);
  }

 private:
  std::vector<std::uint32_t> first_location_;  // by AutomatonId
  std::vector<Rule> rules_;                    // by automaton, then location
  std::vector<bool> visible_;                  // by edge
  std::vector<AutomatonId> next_;              // by edge
  bool is_sequential_ = false;
};

}  // namespace btcheck
