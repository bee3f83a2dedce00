// SPDX-License-Identifier: MIT
//
// The very weak alternating automaton of a formula.
//
// One state for each subformula that may have to hold next; a transition reads
// a conjunction of literals and obliges a set of states (Gastin and Oddoux,
// "Fast LTL to Büchi automata translation", CAV 2001, section 3). No state
// can be left and entered again, which is what makes the step to a Büchi
// automaton simple. The transitions are kept without those that another
// implies.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ltl/buchi/buchi.hpp"
#include "ltl/formula/formula.hpp"

namespace btcheck {

// States of the alternating automaton that must all accept, ascending.
using Obligations = std::vector<FormulaId>;

Obligations union_of(const Obligations& left, const Obligations& right);
bool is_subset(const Obligations& inner, const Obligations& outer);

// Enabled where all of `present` and none of `absent` are true.
struct AlternatingTransition {
  PropositionSet present = 0;
  PropositionSet absent = 0;
  Obligations next;
};

// True when the other may be taken wherever this one may, and obliges to no
// more.
inline bool is_implied_by(const AlternatingTransition& one,
                          const AlternatingTransition& other) {
  return (other.present & ~one.present) == 0 &&
         (other.absent & ~one.absent) == 0 && is_subset(other.next, one.next);
}

using AlternatingTransitions = std::vector<AlternatingTransition>;

// Whether some label enables it.
inline bool can_be(const AlternatingTransition& transition) {
  return (transition.present & transition.absent) == 0;
}

// Both of two transitions at once.
AlternatingTransition conjunction_of(const AlternatingTransition& left,
                                     const AlternatingTransition& right);

class AlternatingAutomaton {
 public:
  // Of a formula in negation normal form; atom i is proposition
  // proposition_of[i]. Nothing when a state would have more than
  // kMostTransitions.
  static std::optional<AlternatingAutomaton> of(
      const FormulaPool& pool, FormulaId root,
      std::span<const int> proposition_of);

  static constexpr std::size_t kMostTransitions = 4096;

  // The ways to begin; the formula holds when one of them does.
  const std::vector<Obligations>& initial() const { return initial_; }
  const AlternatingTransitions& transitions(FormulaId state) const {
    return transitions_[index(state)];
  }
  // The states that must not be waited in for ever, ascending.
  const std::vector<FormulaId>& untils() const { return untils_; }

 private:
  AlternatingAutomaton() = default;

  AlternatingTransitions transitions_of(const FormulaPool& pool, FormulaId id,
                                        std::span<const int> proposition_of);
  void collect_untils(const FormulaPool& pool);

  std::vector<AlternatingTransitions> transitions_;  // by formula
  std::vector<std::vector<Obligations>> ways_;       // by formula: it as a
                                                     // disjunction of states
  std::vector<Obligations> initial_;
  std::vector<FormulaId> untils_;
};

}  // namespace btcheck
