// SPDX-License-Identifier: MIT
//
// Interval arithmetic (Moore, Kearfott and Cloud, 2009) over the operations of
// expressions.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "model/tree/expression.hpp"

namespace btcheck {

// Every integer from low to high.
struct ValueRange {
  std::int64_t low = 0;
  std::int64_t high = 0;

  bool is_one() const { return low == high; }
  bool has(std::int64_t value) const { return low <= value && value <= high; }
  friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

// A range around the results over operands in these; exactly the result where
// each of them is one value. A unary operation ignores `left`.
ValueRange range_of(Operation operation, ValueRange left, ValueRange right);

// The same of a whole expression in postfix order, where `of` says the ranges
// of Variable and Status terms.
ValueRange range_of(std::span<const Term> terms,
                    const std::function<ValueRange(const Term&)>& of);
// Where every variable has the same range.
inline ValueRange range_of(std::span<const Term> terms, ValueRange variable) {
  return range_of(terms, [&](const Term&) { return variable; });
}

}  // namespace btcheck
