// SPDX-License-Identifier: MIT
//
// One pass from left to right with a stack evaluates the list, substitutes in
// it or prints it, without pointers and recursion. The operands of a term are
// found by walking back until the arities are paid for: in `a b c + *` those of
// `*` are `a` and `b c +`. Arithmetic saturates, so that a value far out of a
// variable's range stays far out of it instead of wrapping into it.
#include "model/tree/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cassert>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

namespace btcheck {
namespace {

std::string_view sign_of(Operation operation) {
  constexpr std::array<std::string_view, 18> kSigns = {
      "",    "",  "",   "-", "not ", "+", "-",  "*",   "/",
      "mod", "=", "~=", "<", "<=",   ">", ">=", "and", "or"};
  return kSigns[static_cast<std::size_t>(operation)];
}

// How tightly the sign of an operation binds its operands in print.
enum Tightness { kOr, kAnd, kComparison, kSum, kProduct, kUnary, kOperand };

Tightness tightness_of(Operation operation) {
  if (operation <= Operation::Status) return kOperand;
  if (operation <= Operation::Not) return kUnary;
  if (operation <= Operation::Subtract) return kSum;
  if (operation <= Operation::Modulo) return kProduct;
  if (operation <= Operation::GreaterEqual) return kComparison;
  return operation == Operation::And ? kAnd : kOr;
}

// What an overflow saturates to.
std::int64_t end_of_range(bool is_positive) {
  return is_positive ? std::numeric_limits<std::int64_t>::max()
                     : std::numeric_limits<std::int64_t>::min();
}

bool is_leaf_term(const Term& term) {
  return term.operation == Operation::Variable ||
         term.operation == Operation::Status;
}

// A printed operand; `term` is its only term, if it has only one.
struct Printed {
  std::string text;
  Tightness tightness = kOperand;
  const Term* term = nullptr;
};

std::string enclosed(Printed operand, bool needs_parentheses) {
  return needs_parentheses ? "(" + operand.text + ")" : std::move(operand.text);
}

Printed printed_unary(Operation operation, Printed of) {
  const bool is_loose = of.tightness <= kUnary;
  return {std::string(sign_of(operation)) + enclosed(std::move(of), is_loose),
          kUnary};
}

Printed printed_binary(Operation operation, Printed left, Printed right) {
  const Tightness tightness = tightness_of(operation);
  const bool left_is_loose =
      left.tightness < tightness ||
      (is_comparison(operation) && left.tightness == tightness);
  const bool right_is_loose = right.tightness <= tightness;
  // Onto the left one, so that a long chain is copied once.
  std::string text = enclosed(std::move(left), left_is_loose);
  fmt::format_to(std::back_inserter(text), " {} {}", sign_of(operation),
                 enclosed(std::move(right), right_is_loose));
  return {std::move(text), tightness};
}

}  // namespace

std::int64_t apply(Operation operation, std::int64_t left, std::int64_t right) {
  std::int64_t result = 0;
  switch (operation) {
    case Operation::Negate:
      return apply(Operation::Subtract, 0, right);
    case Operation::Not:
      return right == 0;
    case Operation::Add:
      return __builtin_add_overflow(left, right, &result)
                 ? end_of_range(left > 0)
                 : result;
    case Operation::Subtract:
      return __builtin_sub_overflow(left, right, &result)
                 ? end_of_range(left >= 0)
                 : result;
    case Operation::Multiply:
      return __builtin_mul_overflow(left, right, &result)
                 ? end_of_range((left > 0) == (right > 0))
                 : result;
    case Operation::Divide:
      if (right == -1) return apply(Operation::Subtract, 0, left);
      return right == 0 ? 0 : left / right;
    case Operation::Modulo:
      return right == 0 || right == -1 ? 0 : left % right;
    case Operation::Equal:
      return left == right;
    case Operation::NotEqual:
      return left != right;
    case Operation::Less:
      return left < right;
    case Operation::LessEqual:
      return left <= right;
    case Operation::Greater:
      return left > right;
    case Operation::GreaterEqual:
      return left >= right;
    case Operation::And:
      return left != 0 && right != 0;
    case Operation::Or:
      return left != 0 || right != 0;
    default:
      assert(false && "an operation with operands");
      return 0;
  }
}

int arity(Operation operation) {
  switch (operation) {
    case Operation::Constant:
    case Operation::Variable:
    case Operation::Status:
      return 0;
    case Operation::Negate:
    case Operation::Not:
      return 1;
    default:
      return 2;
  }
}

Expression Expression::constant(std::int32_t value) {
  return Expression({{Operation::Constant, value}});
}

Expression Expression::variable(std::int32_t number) {
  return Expression({{Operation::Variable, number}});
}

Expression Expression::status(std::int32_t node) {
  return Expression({{Operation::Status, node}});
}

std::optional<std::int32_t> Expression::only(Operation kind) const {
  if (terms_.size() != 1 || terms_[0].operation != kind) return std::nullopt;
  return terms_[0].operand;
}

Expression Expression::unary(Operation operation, Expression of) {
  assert(arity(operation) == 1);
  if (of.is_true()) of = constant(1);
  of.terms_.push_back({operation, 0});
  return of;
}

Expression Expression::binary(Operation operation, Expression left,
                              Expression right) {
  assert(arity(operation) == 2);
  if (left.is_true()) left = constant(1);
  if (right.is_true()) right = constant(1);
  left.terms_.insert(left.terms_.end(), right.terms_.begin(),
                     right.terms_.end());
  left.terms_.push_back({operation, 0});
  return left;
}

std::int64_t Expression::evaluate(
    const std::function<std::int64_t(const Term&)>& read) const {
  return is_true() ? 1 : value_of(terms_, read);
}

std::int64_t value_of(std::span<const Term> terms,
                      const std::function<std::int64_t(const Term&)>& read) {
  boost::container::small_vector<std::int64_t, 16> stack;
  for (const Term& term : terms) {
    if (term.operation == Operation::Constant) {
      stack.push_back(term.operand);
    } else if (is_leaf_term(term)) {
      stack.push_back(read(term));
    } else if (arity(term.operation) == 1) {
      stack.back() = apply(term.operation, 0, stack.back());
    } else {
      const std::int64_t right = stack.back();
      stack.pop_back();
      stack.back() = apply(term.operation, stack.back(), right);
    }
  }
  assert(stack.size() == 1);
  return stack.back();
}

Expression Expression::replaced(
    const std::function<Expression(const Term&)>& with) const {
  Expression result;
  result.terms_.reserve(terms_.size());
  for (const Term& term : terms_) {
    if (!is_leaf_term(term)) {
      result.terms_.push_back(term);
      continue;
    }
    Expression replacement = with(term);
    if (replacement.is_true()) replacement = constant(1);
    result.terms_.insert(result.terms_.end(), replacement.terms_.begin(),
                         replacement.terms_.end());
  }
  return result;
}

std::vector<Expression> Expression::divisors() const {
  std::vector<Expression> result;
  for (std::size_t at = 0; at < terms_.size(); ++at) {
    if (!divides(terms_[at].operation)) continue;
    Expression divisor = ending_at(at - 1);
    const auto known = divisor.only(Operation::Constant);
    if (!known || *known == 0) result.push_back(std::move(divisor));
  }
  return result;
}

std::vector<Expression> Expression::conjuncts() const {
  std::vector<Expression> result;
  // The ends of operands still to be looked at, the rightmost on top.
  std::vector<std::size_t> ends;
  if (!is_true()) ends.push_back(terms_.size() - 1);
  while (!ends.empty()) {
    const std::size_t last = ends.back();
    ends.pop_back();
    if (terms_[last].operation == Operation::And) {
      ends.push_back(start_of(last - 1) - 1);
      ends.push_back(last - 1);
    } else {
      result.push_back(ending_at(last));
    }
  }
  std::ranges::reverse(result);
  return result;
}

std::string Expression::text(
    const std::function<std::string(const Term&)>& leaf,
    const std::function<std::string(const Term& beside, std::int32_t value)>&
        constant_beside) const {
  if (is_true()) return "true";
  std::vector<Printed> stack;
  const auto name_value = [&](const Printed& variable, Printed& constant) {
    if (variable.term && is_leaf_term(*variable.term) && constant.term &&
        constant.term->operation == Operation::Constant) {
      constant.text = constant_beside(*variable.term, constant.term->operand);
    }
  };
  for (const Term& term : terms_) {
    if (term.operation == Operation::Constant) {
      stack.push_back({std::to_string(term.operand), kOperand, &term});
    } else if (is_leaf_term(term)) {
      stack.push_back({leaf(term), kOperand, &term});
    } else if (arity(term.operation) == 1) {
      stack.back() = printed_unary(term.operation, std::move(stack.back()));
    } else {
      Printed right = std::move(stack.back());
      stack.pop_back();
      Printed left = std::move(stack.back());
      if (is_comparison(term.operation)) {
        name_value(left, right);
        name_value(right, left);
      }
      stack.back() =
          printed_binary(term.operation, std::move(left), std::move(right));
    }
  }
  assert(stack.size() == 1);
  return std::move(stack.back().text);
}

std::size_t Expression::start_of(std::size_t last) const {
  assert(last < terms_.size());
  std::size_t at = last;
  int owed = arity(terms_[at].operation);
  while (owed > 0) {
    --at;
    owed += arity(terms_[at].operation) - 1;
  }
  return at;
}

Expression Expression::ending_at(std::size_t last) const {
  const auto begin = terms_.begin();
  return Expression({begin + static_cast<std::ptrdiff_t>(start_of(last)),
                     begin + static_cast<std::ptrdiff_t>(last + 1)});
}

bool is_always(const Expression& expression) {
  return expression.is_true() ||
         expression.only(Operation::Constant).value_or(0) != 0;
}

bool is_never(const Expression& expression) {
  return expression.only(Operation::Constant) == 0;
}

Expression both(Expression left, Expression right) {
  if (is_always(left)) return right;
  if (is_always(right)) return left;
  return Expression::binary(Operation::And, std::move(left), std::move(right));
}

std::int64_t power_of_ten(int exponent) {
  assert(exponent >= 0 && exponent <= 18);
  std::int64_t power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

std::string decimal_text(std::int64_t value, int decimals) {
  const bool is_negative = value < 0;
  std::string digits = std::to_string(is_negative ? -value : value);
  const auto behind = static_cast<std::size_t>(decimals);
  if (behind > 0) {
    if (digits.size() <= behind) {
      digits.insert(0, behind + 1 - digits.size(), '0');
    }
    digits.insert(digits.size() - behind, 1, '.');
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
  }
  return is_negative ? "-" + digits : digits;
}

}  // namespace btcheck
