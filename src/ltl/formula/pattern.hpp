// SPDX-License-Identifier: MIT
//
// Specification patterns and their scopes, as formulas of LTL.
#pragma once

#include <cstdint>

#include "ltl/formula/formula.hpp"

namespace btcheck {

// The patterns of Dwyer, Avrunin and Corbett ("Patterns in property
// specifications for finite-state verification", ICSE 1999), by the names of
// that catalogue; Exclusion is ours.
enum class Pattern : std::uint8_t {
  Absence,       // never P
  Universality,  // always P
  Existence,     // P at least once
  Response,      // each P is followed by Q
  Precedence,    // no Q before the first P
  Exclusion      // after a P no Q
};

// The part of a run in which a pattern must hold.
enum class ScopeKind : std::uint8_t {
  Globally,
  Before,     // up to the first `closing`, if there is one
  After,      // from each `opening` on
  Between,    // from each `opening` up to the `closing` that follows
  AfterUntil  // the same, also where no `closing` follows
};

struct Scope {
  ScopeKind kind = ScopeKind::Globally;
  FormulaId opening{};
  FormulaId closing{};
};

// The formula of a pattern over P and (for the last three) Q in a scope. Each
// scope is closed on the left and open on the right, as in the catalogue.
FormulaId pattern_formula(FormulaPool& pool, Pattern pattern, FormulaId p,
                          FormulaId q, const Scope& scope);

// The upper end of an interval that has none.
inline constexpr int kNoEnd = INT32_MAX;

// What a real-time pattern asks of the time after an occurrence (see
// ltl/timed/timed_pattern.hpp).
enum class Demand : std::uint8_t {
  Answer,       // some state with the answer at an age in [from, to]
  FirstAnswer,  // the first state with the answer is at such an age
  NoAnswer,     // no state with the answer at such an age
  Lasting       // the answer in every state at an age of at most `to`
};

}  // namespace btcheck
