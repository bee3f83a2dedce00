// SPDX-License-Identifier: MIT
//
// Merging of states that simulate each other.
//
// A state simulates another if it can answer each of its transitions under
// each label, in at least the same acceptance sets, with a target that again
// simulates the other's (direct simulation; Etessami, Wilke and Schuller,
// ICALP 2001). An answer may be given by several transitions together, which
// is decided on cubes of literals, not label by label. The relation is the
// greatest one, found by taking pairs out of the full one. The same backwards,
// where answers are given to the transitions that lead to a state, merges
// states with the same past (Somenzi and Bloem, CAV 2000).
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ltl/buchi/simplify.hpp"

namespace btcheck {

namespace {

// Deciding simulation compares all transitions with each other several times.
constexpr std::size_t kMostTransitions = 2000;
constexpr std::size_t kMostComparisons = 2'000'000;

constexpr int kMostExpansions = 256;

// A proposition on which `cover` decides and `cube` does not; 0 for none.
PropositionSet deciding_proposition(Cube cube, Cube cover) {
  const PropositionSet open =
      (cover.present | cover.absent) & ~(cube.present | cube.absent);
  return open & (~open + 1);
}

using Transitions = std::vector<BuchiTransition>;

bool is_small(const BuchiAutomaton& automaton) {
  std::size_t count = automaton.state_count();
  for (const Transitions& some : automaton.transitions) count += some.size();
  return count <= kMostTransitions;
}

// Each transition turned around; the initial state stays.
BuchiAutomaton reversed(const BuchiAutomaton& automaton) {
  BuchiAutomaton result = automaton;
  for (Transitions& some : result.transitions) some.clear();
  for (std::uint32_t state = 0; state < automaton.state_count(); ++state) {
    for (BuchiTransition transition : automaton.transitions[state]) {
      const std::uint32_t target = transition.target;
      transition.target = state;
      result.transitions[target].push_back(transition);
    }
  }
  return result;
}

enum class Direction : std::uint8_t { Forwards, Backwards };

// Which states simulate which.
class Simulation {
 public:
  explicit Simulation(const BuchiAutomaton& automaton,
                      Direction direction = Direction::Forwards)
      : automaton_(automaton),
        above_(automaton.state_count(),
               std::vector<bool>(automaton.state_count(), true)) {
    if (direction == Direction::Backwards) keep_initial_apart();
    while (is_complete() && take_out_pairs(direction)) {
    }
  }

  // False when it would take too long; the relation then is too large.
  bool is_complete() const { return comparisons_ <= kMostComparisons; }

  // True when `above` simulates `below`.
  bool holds(std::uint32_t below, std::uint32_t above) const {
    return above_[below][above];
  }
  // True when `above` answers as much as `below`, one transition to another.
  bool dominates(const BuchiTransition& below,
                 const BuchiTransition& above) const {
    return (below.accepting & ~above.accepting) == 0 &&
           holds(below.target, above.target);
  }
  // The labels under which some of `answers` dominates a transition.
  std::vector<Cube> answered_labels(const BuchiTransition& transition,
                                    const Transitions& answers) const {
    std::vector<Cube> labels;
    for (const BuchiTransition& answer : answers) {
      if (dominates(transition, answer)) labels.push_back(cube_of(answer));
    }
    return labels;
  }

 private:
  // Backwards, only the initial state can have the past of the initial one.
  void keep_initial_apart() {
    above_[automaton_.initial].assign(automaton_.state_count(), false);
    above_[automaton_.initial][automaton_.initial] = true;
  }

  // Mostly transitions lead to later states, so that this order, in which
  // the states that a state depends on come first, needs few rounds.
  bool take_out_pairs(Direction direction) {
    bool changed = false;
    const auto count = static_cast<std::uint32_t>(above_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t below =
          direction == Direction::Forwards ? count - 1 - i : i;
      for (std::uint32_t above = 0; above < count; ++above) {
        if (below == above || !above_[below][above]) continue;
        if (answers_all(below, above)) continue;
        above_[below][above] = false;
        changed = true;
      }
    }
    return changed;
  }

  bool answers_all(std::uint32_t below, std::uint32_t above) {
    const Transitions& questions = automaton_.transitions[below];
    const Transitions& answers = automaton_.transitions[above];
    comparisons_ += 1 + questions.size() * answers.size();
    return std::all_of(
        questions.begin(), questions.end(), [&](const BuchiTransition& t) {
          return is_covered(cube_of(t), answered_labels(t, answers));
        });
  }

  const BuchiAutomaton& automaton_;
  std::vector<std::vector<bool>> above_;  // by state below, state above
  std::size_t comparisons_ = 0;
};

// Merges states that simulate each other into the first of them, which takes
// over all their transitions.
void merge_equivalent(BuchiAutomaton& automaton, const Simulation& simulation) {
  const auto count = static_cast<std::uint32_t>(automaton.state_count());
  std::vector<std::uint32_t> first(count);
  for (std::uint32_t state = 0; state < count; ++state) {
    first[state] = 0;
    while (!simulation.holds(first[state], state) ||
           !simulation.holds(state, first[state])) {
      ++first[state];
    }
  }
  for (std::uint32_t state = 0; state < count; ++state) {
    Transitions moved = std::move(automaton.transitions[state]);
    for (BuchiTransition& t : moved) t.target = first[t.target];
    Transitions& to = automaton.transitions[first[state]];
    if (first[state] == state) to.clear();
    to.insert(to.end(), moved.begin(), moved.end());
    if (first[state] != state) automaton.transitions[state].clear();
  }
  automaton.initial = first[automaton.initial];
}

// Drops each transition whose labels the others of its state answer.
void drop_dominated(BuchiAutomaton& automaton, const Simulation& simulation) {
  for (Transitions& some : automaton.transitions) {
    for (std::size_t i = some.size(); i-- > 0;) {
      const BuchiTransition transition = some[i];
      some.erase(some.begin() + static_cast<std::ptrdiff_t>(i));
      if (!is_covered(cube_of(transition),
                      simulation.answered_labels(transition, some))) {
        some.insert(some.begin() + static_cast<std::ptrdiff_t>(i), transition);
      }
    }
  }
}

// Two transitions that differ in one literal or less become one.
bool unite_some_pair(Transitions& some) {
  for (std::size_t i = 0; i < some.size(); ++i) {
    for (std::size_t j = 0; j < some.size(); ++j) {
      BuchiTransition& t = some[i];
      const BuchiTransition& other = some[j];
      if (i == j || t.target != other.target ||
          t.accepting != other.accepting) {
        continue;
      }
      const PropositionSet opposite =
          (t.present & other.absent) | (t.absent & other.present);
      const bool adjacent =
          (opposite & (opposite - 1)) == 0 &&
          (t.present & ~opposite) == (other.present & ~opposite) &&
          (t.absent & ~opposite) == (other.absent & ~opposite);
      if (!adjacent) continue;
      t.present &= ~opposite;
      t.absent &= ~opposite;
      some.erase(some.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  }
  return false;
}

// Takes the labels of `other` from a transition if what remains is one cube.
void take_labels(BuchiTransition& from, const BuchiTransition& other) {
  if (!cube_of(from).meets(cube_of(other))) return;
  const PropositionSet present = other.present & ~from.present;
  const PropositionSet absent = other.absent & ~from.absent;
  const PropositionSet decided = present | absent;
  if (decided == 0 || (decided & (decided - 1)) != 0) return;
  from.absent |= present;
  from.present |= absent;
}

}  // namespace

// By Shannon expansion.
bool is_covered(Cube cube, std::span<const Cube> cover) {
  std::vector<Cube> open{cube};
  for (int i = 0; i < kMostExpansions && !open.empty(); ++i) {
    const Cube part = open.back();
    open.pop_back();
    const Cube* meeting = nullptr;
    bool contained = false;
    for (const Cube& other : cover) {
      contained = contained || other.contains(part);
      if (other.meets(part)) meeting = &other;
    }
    if (contained) continue;
    if (meeting == nullptr) return false;
    const PropositionSet split = deciding_proposition(part, *meeting);
    open.push_back({part.present | split, part.absent});
    open.push_back({part.present, part.absent | split});
  }
  return open.empty();
}

void merge_similar(BuchiAutomaton& automaton) {
  if (automaton.is_empty() || !is_small(automaton)) return;
  const Simulation forwards(automaton);
  if (!forwards.is_complete()) return;
  drop_dominated(automaton, forwards);
  merge_equivalent(automaton, forwards);
  for (Transitions& some : automaton.transitions) {
    while (unite_some_pair(some)) {
    }
  }
  clean_up(automaton);
  if (automaton.is_empty()) return;
  const BuchiAutomaton turned = reversed(automaton);
  const Simulation backwards(turned, Direction::Backwards);
  if (!backwards.is_complete()) return;
  merge_equivalent(automaton, backwards);
  clean_up(automaton);
}

void separate_labels(BuchiAutomaton& automaton) {
  if (automaton.is_empty() || !is_small(automaton)) return;
  const Simulation simulation(automaton);
  if (!simulation.is_complete()) return;
  drop_dominated(automaton, simulation);
  for (Transitions& some : automaton.transitions) {
    for (BuchiTransition& transition : some) {
      for (const BuchiTransition& other : some) {
        if (&other != &transition && simulation.dominates(transition, other)) {
          take_labels(transition, other);
        }
      }
    }
  }
}

}  // namespace btcheck
