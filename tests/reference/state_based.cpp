// SPDX-License-Identifier: MIT
//
// Büchi automata with acceptance on states, to be set beside never claims.
//
// The textbook's way: copies of the automaton, called levels, count through
// the acceptance sets, and the last level accepts (Gastin and Oddoux, CAV 2001,
// section 5). A component that accepts nothing needs a single level, and a run
// may enter another one on whichever level gives the smaller automaton. States
// with the same transitions are then merged, up to merging; nothing else is
// made smaller, so this is what our automata cost without their two liberties,
// not the best that acceptance on states can do.
#include "reference/state_based.hpp"

#include <cassert>
#include <map>
#include <set>
#include <utility>

#include "ltl/buchi/components.hpp"
#include "ltl/buchi/simplify.hpp"

namespace btcheck::reference {
namespace {

// The level on which runs come into a component that accepts.
enum class Entry { First, Last };

class Levels {
 public:
  Levels(const BuchiAutomaton& automaton, Entry entry)
      : automaton_(automaton), components_(automaton), entry_(entry) {}

  BuchiAutomaton run() {
    BuchiAutomaton result;
    result.acceptance_sets = 1;
    number({automaton_.initial, entry_level(automaton_.initial)});
    for (std::size_t i = 0; i < copies_.size(); ++i) {
      const Copy copy = copies_[i];
      const AcceptanceSet accepting = copy.second == last() ? 1 : 0;
      auto& transitions = result.transitions.emplace_back();
      for (const BuchiTransition& t : automaton_.transitions[copy.first]) {
        const std::uint32_t target = number({t.target, level_after(copy, t)});
        transitions.push_back({t.present, t.absent, accepting, target});
      }
    }
    return result;
  }

 private:
  using Copy = std::pair<std::uint32_t, int>;  // a state, its level

  int last() const { return automaton_.acceptance_sets; }

  std::uint32_t number(const Copy& copy) {
    const auto [place, is_new] =
        numbers_.emplace(copy, static_cast<std::uint32_t>(copies_.size()));
    if (is_new) copies_.push_back(copy);
    return place->second;
  }

  bool accepts(std::uint32_t state) const {
    return components_.is_accepting(components_.of(state));
  }

  int entry_level(std::uint32_t state) const {
    return accepts(state) && entry_ == Entry::Last ? last() : 0;
  }

  int level_after(const Copy& copy, const BuchiTransition& t) const {
    if (!components_.is_inside(copy.first, t)) return entry_level(t.target);
    if (!accepts(copy.first)) return 0;
    int level = copy.second == last() ? 0 : copy.second;
    while (level < last() && (t.accepting >> level & 1) != 0) ++level;
    return level;
  }

  const BuchiAutomaton& automaton_;
  const Components components_;
  const Entry entry_;
  std::vector<Copy> copies_;
  std::map<Copy, std::uint32_t> numbers_;
};

}  // namespace

BuchiAutomaton state_based(const BuchiAutomaton& automaton) {
  if (automaton.is_empty()) return automaton;
  BuchiAutomaton first = Levels(automaton, Entry::First).run();
  BuchiAutomaton last = Levels(automaton, Entry::Last).run();
  merge_bisimilar(first);
  merge_bisimilar(last);
  return first.state_count() < last.state_count() ? first : last;
}

std::size_t connected_pairs(const BuchiAutomaton& automaton) {
  std::set<std::pair<std::size_t, std::uint32_t>> pairs;
  for (std::size_t state = 0; state < automaton.state_count(); ++state) {
    for (const BuchiTransition& t : automaton.transitions[state]) {
      pairs.emplace(state, t.target);
    }
  }
  return pairs.size();
}

}  // namespace btcheck::reference
