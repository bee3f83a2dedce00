// SPDX-License-Identifier: MIT
//
// Formulas as other model checkers write them.
#pragma once

#include <string>
#include <string_view>

#include "ltl/formula/formula.hpp"

namespace btcheck {

// The signs of linear time. Weak until is written with release: a W b is
// b R (a or b), on which all tools agree. Without a sign for it, equivalence is
// two implications.
struct LinearSigns {
  std::string_view negation;  // prefix operators stand before "(…)"
  std::string_view always;
  std::string_view eventually;
  std::string_view next;
  std::string_view conjunction;
  std::string_view disjunction;
  std::string_view implication;
  std::string_view equivalence;
  std::string_view until;
  std::string_view release;
  std::string_view truth = "true";
  std::string_view falsehood = "false";
};

inline constexpr LinearSigns kSpinSigns = {"!",  "[] ", "<> ", "X ", "&&",
                                           "||", "->",  "<->", "U",  "V"};
inline constexpr LinearSigns kSmvSigns = {
    "!", "G ", "F ", "X ", "&", "|", "->", "<->", "U", "V", "TRUE", "FALSE"};
inline constexpr LinearSigns kFiacreSigns = {
    "not ", "[] ", "<> ", "() ", "and", "or", "=>", "", "until", "release"};

// The text of a formula without path quantifiers: atom i is `pi`, every
// operator but the outermost has its parentheses. "" where it would be longer
// than anyone reads: W, and equivalence without a sign, say an operand twice.
std::string linear_spelling(const FormulaPool& pool, FormulaId formula,
                            const LinearSigns& signs);

// A formula of CTL as SMV writes it; "" where it would be too long as well. W
// and R, which its CTL does not have, are written by what it has.
std::string smv_branching_spelling(const FormulaPool& pool, FormulaId formula);

}  // namespace btcheck
