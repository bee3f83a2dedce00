// SPDX-License-Identifier: MIT
//
// Whether a replayed run shows what it is meant to show.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The run as far as a state.
Run up_to(const Run& run, std::size_t state);

// The last state of the run satisfies the predicate.
bool ends_with(const Network& network, const Run& run,
               const StatePredicate& predicate);

// The first state of the run that satisfies the predicate.
std::optional<std::size_t> first_state(const Network& network, const Run& run,
                                       const StatePredicate& predicate);

// The run is infinite, makes progress for ever, and the formula is false on it;
// or it is finite, and the formula is false whatever single label repeats
// behind it (of up to kMostTriedAfter labels).
inline constexpr std::size_t kMostTriedAfter = 64;
bool violates(const Network& network, const Run& run,
              const BoundFormula& formula);

// An infinite word, label by state, on which a formula is false: because it is
// on the run, or, of a finite one, on every run that goes on from there.
struct RunWord {
  FormulaPool pool;
  FormulaId formula{};
  std::vector<PropositionSet> labels;
  std::size_t loop = 0;
};

// The word of a run that violates the formula. Nothing where a finite one is no
// informative bad prefix.
std::optional<RunWord> word_of(const Network& network, const Run& run,
                               const BoundFormula& formula);

// The first state of the run by which it has broken the claim, a part of the
// formula, whatever comes then; nothing when there is none. Found are the
// informative bad prefixes (Kupferman and Vardi, FMSD 2001).
std::optional<std::size_t> broken_at(const Network& network, const Run& run,
                                     const BoundFormula& formula,
                                     FormulaId claim);
// And of a pattern.
std::optional<std::size_t> broken_at(const Network& network, const Run& run,
                                     const BoundPattern& pattern);

// The run is infinite, and on its loop what is requested is also granted. With
// no condition every run is fair.
bool is_fair(const Network& network, const Run& run,
             const std::vector<FairnessPair>& conditions);

// The first occurrence, by its state, from which the run violates the pattern;
// nothing when it does not. For a pattern that nothing on the run begins: the
// last state.
std::optional<std::size_t> violated_occurrence(const Network& network,
                                               const Run& run,
                                               const BoundPattern& pattern);

// What the property is made of, along the run: each part with a text of its
// own.
std::vector<WatchedPart> watched_parts(const Network& network, const Run& run,
                                       const BoundProperty& bound);

}  // namespace btcheck
