// SPDX-License-Identifier: MIT
//
// Minimal deterministic automata for obligation properties.
//
// Safety, guarantee and their Boolean combinations are what most properties
// are, and have a deterministic automaton in which each component accepts all
// its cycles or none; that one can be minimised like an automaton on finite
// words (Löding, IPL 2001). It is found by the powerset construction, with
// acceptance read off one cycle of each component, and then compared with the
// automaton and its opposite: where the words are no obligation the comparison
// fails and nothing is returned (Dax, Eisinger and Klaedtke, ATVA 2007). A
// deterministic automaton makes the product with a system no larger than the
// part of the automaton that matters to it.
#include "ltl/buchi/simplify.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "ltl/buchi/components.hpp"
#include "ltl/buchi/deterministic.hpp"

namespace btcheck {

namespace {

constexpr std::size_t kMostPropositions = 8;
constexpr std::size_t kMostSubsets = 1024;
constexpr std::size_t kMostPairs = 20000;

// The colour of states that accept; of others it is 0.
constexpr std::uint32_t kAccepting = 1;

class PowerSet {
 public:
  PowerSet(const BuchiAutomaton& automaton,
           const std::vector<PropositionSet>& propositions)
      : automaton_(automaton), labels_(labels_over(propositions)) {}

  // Nothing when there are more than kMostSubsets.
  std::optional<Deterministic> run() {
    Deterministic result;
    number({automaton_.initial});
    for (std::size_t i = 0; i < subsets_.size(); ++i) {
      std::vector<std::uint32_t>& row = result.targets.emplace_back();
      for (const PropositionSet label : labels_) {
        row.push_back(number(after(automaton_, subsets_[i], label)));
      }
      if (subsets_.size() > kMostSubsets) return std::nullopt;
    }
    colour(result);
    return result;
  }

 private:
  std::uint32_t number(const Subset& subset) {
    const auto [place, is_new] =
        numbers_.emplace(subset, static_cast<std::uint32_t>(subsets_.size()));
    if (is_new) subsets_.push_back(subset);
    return place->second;
  }

  // Marks the states that accept. A component without a cycle takes the colour
  // of what follows it, so that minimisation can merge it; colours never fall
  // from a component to one before it, and the even ones accept.
  void colour(Deterministic& result) const {
    BuchiAutomaton graph;
    for (const std::vector<std::uint32_t>& row : result.targets) {
      auto& transitions = graph.transitions.emplace_back();
      for (const std::uint32_t target : row) {
        transitions.push_back({0, 0, 0, target});
      }
    }
    const Components components(graph);
    std::vector<std::size_t> colours(graph.state_count(), 0);
    for (std::size_t i = 0; i < components.count(); ++i) {
      std::size_t highest = 0;
      for (const std::uint32_t state : components.members(i)) {
        for (const std::uint32_t target : result.targets[state]) {
          highest = std::max(highest, colours[target]);
        }
      }
      if (components.has_cycle(i)) {
        const std::uint32_t state = components.members(i).front();
        const bool even = accepts_cycle(state, cycle_at(result, state));
        if ((highest % 2 == 0) != even) ++highest;
      }
      for (const std::uint32_t state : components.members(i)) {
        colours[state] = highest;
      }
    }
    for (const std::size_t each : colours) {
      result.colours.push_back(each % 2 == 0 ? kAccepting : 0);
    }
  }

  // The letters of a shortest cycle through a state that has one.
  static std::vector<std::size_t> cycle_at(const Deterministic& automaton,
                                           std::uint32_t start) {
    struct Reached {
      std::uint32_t state;
      std::size_t from;  // place in the queue
      std::size_t letter;
    };
    std::vector<Reached> queue{{start, 0, 0}};
    std::vector<bool> seen(automaton.targets.size());
    for (std::size_t i = 0;; ++i) {
      const std::vector<std::uint32_t>& row = automaton.targets[queue[i].state];
      for (std::size_t letter = 0; letter < row.size(); ++letter) {
        if (row[letter] == start) {
          std::vector<std::size_t> letters{letter};
          for (std::size_t at = i; at != 0; at = queue[at].from) {
            letters.push_back(queue[at].letter);
          }
          std::reverse(letters.begin(), letters.end());
          return letters;
        }
        if (seen[row[letter]]) continue;
        seen[row[letter]] = true;
        queue.push_back({row[letter], i, letter});
      }
    }
  }

  // Whether the automaton accepts the letters for ever from a state of the
  // subset.
  bool accepts_cycle(std::uint32_t subset,
                     const std::vector<std::size_t>& letters) const {
    const auto count = static_cast<std::uint32_t>(letters.size());
    BuchiAutomaton runs;
    runs.acceptance_sets = automaton_.acceptance_sets;
    runs.transitions.resize(automaton_.state_count() * count + 1);
    for (std::uint32_t state = 0; state < automaton_.state_count(); ++state) {
      for (std::uint32_t at = 0; at < count; ++at) {
        for (BuchiTransition t : automaton_.transitions[state]) {
          if (!t.reads(labels_[letters[at]])) continue;
          t.target = t.target * count + (at + 1) % count;
          runs.transitions[state * count + at].push_back(t);
        }
      }
    }
    runs.initial = static_cast<std::uint32_t>(runs.transitions.size() - 1);
    for (const std::uint32_t state : subsets_[subset]) {
      runs.transitions.back().push_back({0, 0, 0, state * count});
    }
    clean_up(runs);
    return !runs.is_empty();
  }

  const BuchiAutomaton& automaton_;
  const std::vector<PropositionSet> labels_;  // by letter
  std::vector<Subset> subsets_;
  std::map<Subset, std::uint32_t> numbers_;
};

// The transitions of one state: the letters to each target in as few cubes as
// growing them one literal at a time gives; no two of them meet.
std::vector<BuchiTransition> transitions_of(
    const std::vector<std::uint32_t>& row,
    const std::vector<PropositionSet>& propositions) {
  std::vector<BuchiTransition> transitions;
  std::vector<bool> done(row.size());
  const auto is_free = [&](std::size_t base, std::size_t open,
                           std::uint32_t target) {
    for (std::size_t letter = 0; letter < row.size(); ++letter) {
      if ((letter & ~open) != (base & ~open)) continue;
      if (done[letter] || row[letter] != target) return false;
    }
    return true;
  };
  for (std::size_t base = 0; base < row.size(); ++base) {
    if (done[base]) continue;
    std::size_t open = 0;  // propositions that do not matter
    for (std::size_t bit = 1; bit < row.size(); bit <<= 1) {
      if (is_free(base, open | bit, row[base])) open |= bit;
    }
    BuchiTransition transition{0, 0, 0, row[base]};
    for (std::size_t i = 0; i < propositions.size(); ++i) {
      if ((open >> i & 1) != 0) continue;
      ((base >> i & 1) != 0 ? transition.present : transition.absent) |=
          propositions[i];
    }
    for (std::size_t letter = 0; letter < row.size(); ++letter) {
      if ((letter & ~open) == (base & ~open)) done[letter] = true;
    }
    transitions.push_back(transition);
  }
  return transitions;
}

// As a Büchi automaton that accepts the runs which stay in states that accept,
// or, where this is not wanted, in the others.
BuchiAutomaton as_buchi(const Deterministic& automaton, bool wanted,
                        const std::vector<PropositionSet>& propositions) {
  BuchiAutomaton result;
  result.acceptance_sets = 1;
  for (std::size_t state = 0; state < automaton.targets.size(); ++state) {
    auto& transitions = result.transitions.emplace_back(
        transitions_of(automaton.targets[state], propositions));
    for (BuchiTransition& t : transitions) {
      t.accepting = (automaton.colours[state] == kAccepting) == wanted ? 1 : 0;
    }
  }
  return result;
}

// Whether no word is accepted by both; may say no when it would take long.
bool are_disjoint(const BuchiAutomaton& left, const BuchiAutomaton& right) {
  if (left.is_empty() || right.is_empty()) return true;
  if (left.state_count() * right.state_count() > kMostPairs) return false;
  if (left.acceptance_sets + right.acceptance_sets > 63) return false;
  const auto width = static_cast<std::uint32_t>(right.state_count());
  BuchiAutomaton both;
  both.acceptance_sets = left.acceptance_sets + right.acceptance_sets;
  both.initial = left.initial * width + right.initial;
  both.transitions.resize(left.state_count() * width);
  for (std::size_t pair = 0; pair < both.transitions.size(); ++pair) {
    for (const BuchiTransition& l : left.transitions[pair / width]) {
      for (const BuchiTransition& r : right.transitions[pair % width]) {
        const PropositionSet present = l.present | r.present;
        const PropositionSet absent = l.absent | r.absent;
        if ((present & absent) != 0) continue;
        both.transitions[pair].push_back(
            {present, absent, l.accepting | r.accepting << left.acceptance_sets,
             l.target * width + r.target});
      }
    }
  }
  clean_up(both);
  return both.is_empty();
}

}  // namespace

std::optional<BuchiAutomaton> minimal_weak(const BuchiAutomaton& automaton,
                                           const BuchiAutomaton& opposite) {
  if (automaton.is_empty()) return automaton;
  const std::vector<PropositionSet> propositions = used_propositions(automaton);
  if (propositions.size() > kMostPropositions) return std::nullopt;
  const auto subsets = PowerSet(automaton, propositions).run();
  if (!subsets) return std::nullopt;
  const Deterministic smallest = minimised(*subsets);
  BuchiAutomaton result = as_buchi(smallest, true, propositions);
  if (!are_disjoint(automaton, as_buchi(smallest, false, propositions)) ||
      !are_disjoint(result, opposite)) {
    return std::nullopt;
  }
  clean_up(result);
  return result;
}

}  // namespace btcheck
