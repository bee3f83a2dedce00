// SPDX-License-Identifier: MIT
//
// Interval arithmetic (Moore 1966), operator by operator. The languages that
// models are exported to compute in 32 bits, we in 64 that saturate: where the
// ranges of all parts of an expression fit, every one of them agrees with us.
#include "model/export/value_range.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace btcheck {
namespace {

ValueRange product(ValueRange a, ValueRange b) {
  const auto [low, high] = std::minmax(
      {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}

}  // namespace

bool ValueRange::fits() const {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  return low >= -kMost && high <= kMost;
}

ValueRange range_of(Operation operation, ValueRange left, ValueRange right) {
  const std::int64_t greatest =
      std::max(std::abs(left.low), std::abs(left.high));
  switch (operation) {
    case Operation::Add:
      return {left.low + right.low, left.high + right.high};
    case Operation::Subtract:
      return {left.low - right.high, left.high - right.low};
    case Operation::Multiply:
      return product(left, right);
    case Operation::Divide:
    case Operation::Modulo:
      return {-greatest, greatest};
    case Operation::Negate:
      return {-right.high, -right.low};
    default:
      return {0, 1};
  }
}

}  // namespace btcheck
