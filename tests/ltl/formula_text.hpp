// SPDX-License-Identifier: MIT
//
// Formulas for tests, written as SPIN writes them.
#pragma once

#include <cassert>
#include <cctype>
#include <string_view>

#include "ltl/formula/formula.hpp"

namespace btcheck {

// Reads ! X [] <> U W V && || -> <-> true false and one-letter atoms (a is
// atom 0, b is 1, …). Binary operators of one level group to the right; from
// tight to loose: U W V, &&, ||, ->, <->. For tests: recursive, and what is
// wrong ends in an assertion.
class FormulaText {
 public:
  FormulaText(FormulaPool& pool, std::string_view text)
      : pool_(pool), rest_(text) {}

  FormulaId read() {
    const FormulaId id = binary(0);
    skip_blanks();
    assert(rest_.empty());
    return id;
  }

 private:
  struct Operator {
    std::string_view symbol;
    FormulaKind kind;
    int level;
  };

  static constexpr int kUnaryLevel = 5;
  static constexpr Operator kBinary[] = {
      {"<->", FormulaKind::Equivalent, 0}, {"->", FormulaKind::Implies, 1},
      {"||", FormulaKind::Or, 2},          {"&&", FormulaKind::And, 3},
      {"U", FormulaKind::Until, 4},        {"W", FormulaKind::WeakUntil, 4},
      {"V", FormulaKind::Release, 4}};
  static constexpr Operator kUnary[] = {
      {"!", FormulaKind::Not, kUnaryLevel},
      {"X", FormulaKind::Next, kUnaryLevel},
      {"[]", FormulaKind::Always, kUnaryLevel},
      {"<>", FormulaKind::Eventually, kUnaryLevel}};

  void skip_blanks() {
    while (!rest_.empty() && rest_[0] == ' ') rest_.remove_prefix(1);
  }

  bool take(std::string_view symbol) {
    skip_blanks();
    if (!rest_.starts_with(symbol)) return false;
    rest_.remove_prefix(symbol.size());
    return true;
  }

  FormulaId binary(int level) {
    if (level == kUnaryLevel) return unary();
    const FormulaId left = binary(level + 1);
    for (const Operator& op : kBinary) {
      if (op.level == level && take(op.symbol)) {
        return pool_.binary(op.kind, left, binary(level));
      }
    }
    return left;
  }

  FormulaId unary() {
    for (const Operator& op : kUnary) {
      if (take(op.symbol)) return pool_.unary(op.kind, unary());
    }
    if (take("true")) return pool_.constant(true);
    if (take("false")) return pool_.constant(false);
    if (take("(")) {
      const FormulaId inner = binary(0);
      [[maybe_unused]] const bool closed = take(")");
      assert(closed);
      return inner;
    }
    assert(!rest_.empty() && std::islower(rest_[0]) != 0);
    const auto number = static_cast<std::uint32_t>(rest_[0] - 'a');
    rest_.remove_prefix(1);
    return pool_.atom(number);
  }

  FormulaPool& pool_;
  std::string_view rest_;
};

inline FormulaId parse(FormulaPool& pool, std::string_view text) {
  return FormulaText(pool, text).read();
}

}  // namespace btcheck
