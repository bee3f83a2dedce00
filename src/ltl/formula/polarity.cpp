// SPDX-License-Identifier: MIT
//
// One pass from operators to operands; the left side of an implication counts
// as negated, both sides of an equivalence as both.
#include "ltl/formula/polarity.hpp"

namespace btcheck {

namespace {

Polarity joined(Polarity one, Polarity other) {
  return static_cast<Polarity>(static_cast<std::uint8_t>(one) |
                               static_cast<std::uint8_t>(other));
}
Polarity flipped(Polarity of) {
  if (of == Polarity::Positive) return Polarity::Negative;
  return of == Polarity::Negative ? Polarity::Positive : of;
}

}  // namespace

std::vector<Polarity> polarities(const FormulaPool& pool, FormulaId whole) {
  std::vector<Polarity> found(index(whole) + 1, Polarity::None);
  found[index(whole)] = Polarity::Positive;
  for (std::uint32_t i = index(whole) + 1; i-- > 0;) {
    const FormulaNode& node = pool[FormulaId{i}];
    if (found[i] == Polarity::None || is_leaf(node.kind)) continue;
    Polarity left = found[i];
    if (node.kind == FormulaKind::Not || node.kind == FormulaKind::Implies) {
      left = flipped(left);
    }
    Polarity right = found[i];
    if (node.kind == FormulaKind::Equivalent) left = right = Polarity::Both;
    found[index(node.left)] = joined(found[index(node.left)], left);
    if (is_unary(node.kind)) continue;
    found[index(node.right)] = joined(found[index(node.right)], right);
  }
  return found;
}

}  // namespace btcheck
