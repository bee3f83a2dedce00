// SPDX-License-Identifier: MIT
//
// Saturating sums, differences and products, and quotients by what is not zero,
// are monotone in each operand, so their bounds are found at the corners.
#include "model/tree/value_range.hpp"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cassert>
#include <limits>

namespace btcheck {
namespace {

ValueRange at_corners(Operation operation, ValueRange left, ValueRange right) {
  const auto [low, high] =
      std::minmax({apply(operation, left.low, right.low),
                   apply(operation, left.low, right.high),
                   apply(operation, left.high, right.low),
                   apply(operation, left.high, right.high)});
  return {low, high};
}

// Of the end that is farther from zero.
std::int64_t magnitude(ValueRange range) {
  return std::max(apply(Operation::Negate, 0, range.low), range.high);
}

ValueRange quotients(ValueRange left, ValueRange right) {
  if (!right.has(0) || right.is_one()) {
    return at_corners(Operation::Divide, left, right);
  }
  return {-magnitude(left), magnitude(left)};
}

// Between two multiples of the divisor the remainder grows with the dividend.
ValueRange remainders(ValueRange left, ValueRange right) {
  const auto quotient = [&](std::int64_t of) {
    return apply(Operation::Divide, of, right.low);
  };
  if (right.is_one() && quotient(left.low) == quotient(left.high)) {
    return at_corners(Operation::Modulo, left, right);
  }
  const std::int64_t most = std::max<std::int64_t>(magnitude(right), 1) - 1;
  return {left.low < 0 ? -most : 0, left.high > 0 ? most : 0};
}

ValueRange truth(bool is_certain, bool is_possible) {
  return {is_certain ? 1 : 0, is_possible ? 1 : 0};
}

ValueRange compared(Operation operation, ValueRange left, ValueRange right) {
  switch (operation) {
    case Operation::Equal:
      return truth(left.is_one() && left == right,
                   left.low <= right.high && right.low <= left.high);
    case Operation::Less:
      return truth(left.high < right.low, left.low < right.high);
    case Operation::LessEqual:
      return truth(left.high <= right.low, left.low <= right.high);
    case Operation::Greater:
      return compared(Operation::Less, right, left);
    case Operation::GreaterEqual:
      return compared(Operation::LessEqual, right, left);
    default: {
      const ValueRange equal = compared(Operation::Equal, left, right);
      return {1 - equal.high, 1 - equal.low};
    }
  }
}

ValueRange as_truth(ValueRange range) {
  return truth(!range.has(0), range != ValueRange{0, 0});
}

ValueRange joined(Operation operation, ValueRange left, ValueRange right) {
  const ValueRange one = as_truth(left);
  const ValueRange other = as_truth(right);
  if (operation == Operation::And) {
    return {one.low & other.low, one.high & other.high};
  }
  return {one.low | other.low, one.high | other.high};
}

}  // namespace

ValueRange range_of(Operation operation, ValueRange left, ValueRange right) {
  switch (operation) {
    case Operation::Negate:
      return range_of(Operation::Subtract, {0, 0}, right);
    case Operation::Not: {
      const ValueRange of = as_truth(right);
      return {1 - of.high, 1 - of.low};
    }
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Multiply:
      return at_corners(operation, left, right);
    case Operation::Divide:
      return quotients(left, right);
    case Operation::Modulo:
      return remainders(left, right);
    case Operation::And:
    case Operation::Or:
      return joined(operation, left, right);
    default:
      assert(is_comparison(operation));
      return compared(operation, left, right);
  }
}

ValueRange range_of(std::span<const Term> terms,
                    const std::function<ValueRange(const Term&)>& of) {
  if (terms.empty()) return {1, 1};
  boost::container::small_vector<ValueRange, 16> stack;
  for (const Term& term : terms) {
    const int operands = arity(term.operation);
    if (operands == 0) {
      const bool is_constant = term.operation == Operation::Constant;
      stack.push_back(is_constant ? ValueRange{term.operand, term.operand}
                                  : of(term));
      continue;
    }
    const ValueRange right = stack.back();
    if (operands == 2) stack.pop_back();
    stack.back() = range_of(term.operation, stack.back(), right);
  }
  return stack.back();
}

}  // namespace btcheck
