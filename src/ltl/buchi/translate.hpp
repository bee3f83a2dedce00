// SPDX-License-Identifier: MIT
//
// From a formula of linear temporal logic to the automaton of its words.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "ltl/buchi/buchi.hpp"
#include "ltl/formula/formula.hpp"

namespace btcheck {

// Bounds on the automaton before it is made small.
struct TranslationLimits {
  std::size_t max_states = 200'000;
  std::size_t max_transitions = 2'000'000;
};

// The automaton that accepts exactly the words that satisfy the formula; atom
// i is proposition i, below kMaxPropositions. Nothing when a limit is reached
// or when the automaton would need more than 63 acceptance sets. To check a
// property, translate its negation: pool.unary(FormulaKind::Not, id).
std::optional<BuchiAutomaton> translate(FormulaPool& pool, FormulaId id,
                                        TranslationLimits limits = {});

// The same where atom i is proposition proposition_of[i].
std::optional<BuchiAutomaton> translate(FormulaPool& pool, FormulaId id,
                                        std::span<const int> proposition_of,
                                        TranslationLimits limits = {});

}  // namespace btcheck
