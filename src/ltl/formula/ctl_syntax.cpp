// SPDX-License-Identifier: MIT
//
// CTL is what is left of formulas with path quantifiers where each temporal
// operator stands directly below one, and below each one such an operator
// (Clarke and Emerson 1981).
#include "ltl/formula/ctl_syntax.hpp"

#include <vector>

namespace btcheck {

namespace {

// Puts the operands of a node where the left one is taken first.
void push_operands(const FormulaNode& node, std::vector<FormulaId>& stack) {
  if (is_leaf(node.kind)) return;
  if (!is_unary(node.kind)) stack.push_back(node.right);
  stack.push_back(node.left);
}

}  // namespace

std::optional<FormulaId> first_non_ctl(const FormulaPool& formulas,
                                       FormulaId formula) {
  std::vector<bool> seen(index(formula) + 1);
  std::vector<FormulaId> waiting{formula};
  while (!waiting.empty()) {
    const FormulaId id = waiting.back();
    waiting.pop_back();
    if (seen[index(id)]) continue;
    seen[index(id)] = true;
    const FormulaNode& node = formulas[id];
    if (is_path_operator(node.kind)) return id;
    if (is_path_quantifier(node.kind)) {
      const FormulaNode& path = formulas[node.left];
      if (!is_path_operator(path.kind)) return id;
      push_operands(path, waiting);
    } else {
      push_operands(node, waiting);
    }
  }
  return std::nullopt;
}

}  // namespace btcheck
