// SPDX-License-Identifier: MIT
//
// Smaller Büchi automata for the same words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// In which sets to put the transitions between components. The words are the
// same either way; which is better for merging differs.
enum class PassingMarks : std::uint8_t { None, All };

// Keeps only reachable states from which a word can be accepted, acceptance
// marks only where they matter, and as few acceptance sets as the components
// need.
void clean_up(BuchiAutomaton& automaton,
              PassingMarks passing = PassingMarks::None);

// Merges states with equal transitions, up to merging.
void merge_bisimilar(BuchiAutomaton& automaton);

// Merges states that simulate each other, forwards and then backwards, and
// drops transitions that others make superfluous. Does nothing to automata
// with more than a few thousand transitions.
void merge_similar(BuchiAutomaton& automaton);

// Takes from each transition the labels under which another one of the same
// state does as well, so that fewer are enabled at a time. Same bound.
void separate_labels(BuchiAutomaton& automaton);

// All of these, until nothing changes.
void reduce(BuchiAutomaton& automaton);

// The smallest deterministic automaton that accepts the words of `automaton`,
// if there is a weak one, that is, if they are a Boolean combination of safety
// properties. `opposite` accepts the other words. Nothing as well when finding
// out would take long.
std::optional<BuchiAutomaton> minimal_weak(const BuchiAutomaton& automaton,
                                           const BuchiAutomaton& opposite);

// The labels with all of `present` and none of `absent`.
struct Cube {
  PropositionSet present = 0;
  PropositionSet absent = 0;

  bool contains(Cube other) const {
    return (present & ~other.present) == 0 && (absent & ~other.absent) == 0;
  }
  bool meets(Cube other) const {
    return (present & other.absent) == 0 && (absent & other.present) == 0;
  }
  friend bool operator==(const Cube&, const Cube&) = default;
};

inline Cube cube_of(const BuchiTransition& transition) {
  return {transition.present, transition.absent};
}

// True when each label of `cube` is in one of `cover`. May say no when it is
// true but would take long to find out.
bool is_covered(Cube cube, std::span<const Cube> cover);

// The coarsest partition, finer than `classes`, in which states of one class
// have the same `signature(state, classes)`; a class for each state, numbered
// as they occur.
template <class Signature>
std::vector<std::uint32_t> refined(std::vector<std::uint32_t> classes,
                                   Signature signature) {
  for (std::size_t count = 0;;) {
    std::map<std::pair<std::uint32_t, decltype(signature(0, classes))>,
             std::uint32_t>
        numbers;
    std::vector<std::uint32_t> finer;
    for (std::size_t state = 0; state < classes.size(); ++state) {
      const auto number = static_cast<std::uint32_t>(numbers.size());
      finer.push_back(
          numbers
              .try_emplace({classes[state], signature(state, classes)}, number)
              .first->second);
    }
    classes = std::move(finer);
    if (numbers.size() == count) return classes;
    count = numbers.size();
  }
}

}  // namespace btcheck
