// SPDX-License-Identifier: MIT
#include "explore/components/residual.hpp"

#include <limits>
#include <utility>
#include <vector>

namespace btcheck {
namespace {

std::optional<std::int32_t> constant_of(const Expression& expression) {
  return expression.only(Operation::Constant);
}

// Whether it has no values but 0 and 1.
bool is_truth(const Expression& expression) {
  const auto terms = expression.terms();
  if (terms.empty()) return true;
  const Operation last = terms.back().operation;
  return is_comparison(last) || last == Operation::And ||
         last == Operation::Or || last == Operation::Not;
}

std::optional<Expression> folded(Operation operation, const Expression& left,
                                 const Expression& right) {
  const auto one = constant_of(left);
  const auto other = constant_of(right);
  const bool is_and = operation == Operation::And;
  if (is_and || operation == Operation::Or) {
    const auto decides = [&](const std::optional<std::int32_t>& value) {
      return value && (*value != 0) != is_and;
    };
    if (decides(one) || decides(other)) {
      return Expression::constant(is_and ? 0 : 1);
    }
    if (one && is_truth(right)) return right;
    if (other && is_truth(left)) return left;
  }
  if (!other || (!one && arity(operation) == 2)) return std::nullopt;
  const std::int64_t value = apply(operation, one.value_or(0), *other);
  using Limits = std::numeric_limits<std::int32_t>;
  if (value < Limits::min() || value > Limits::max()) return std::nullopt;
  return Expression::constant(static_cast<std::int32_t>(value));
}

}  // namespace

Expression residual(const Expression& expression, const KnownValue& known) {
  if (expression.is_true()) return expression;
  std::vector<Expression> stack;
  for (const Term& term : expression.terms()) {
    if (term.operation == Operation::Constant) {
      stack.push_back(Expression::constant(term.operand));
    } else if (term.operation == Operation::Variable) {
      const auto value =
          known(VariableId{static_cast<std::uint32_t>(term.operand)});
      stack.push_back(
          value ? Expression::constant(static_cast<std::int32_t>(*value))
                : Expression::variable(term.operand));
    } else {
      Expression right = std::move(stack.back());
      stack.pop_back();
      Expression left;
      if (arity(term.operation) == 2) {
        left = std::move(stack.back());
        stack.pop_back();
      }
      if (auto value = folded(term.operation, left, right)) {
        stack.push_back(std::move(*value));
      } else if (arity(term.operation) == 2) {
        stack.push_back(Expression::binary(term.operation, std::move(left),
                                           std::move(right)));
      } else {
        stack.push_back(Expression::unary(term.operation, std::move(right)));
      }
    }
  }
  return std::move(stack.back());
}

}  // namespace btcheck
