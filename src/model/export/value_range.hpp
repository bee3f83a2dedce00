// SPDX-License-Identifier: MIT
//
// The values that an expression may take.
#pragma once

#include <cstdint>

#include "model/tree/expression.hpp"

namespace btcheck {

// Every integer from low to high.
struct ValueRange {
  std::int64_t low = 0;
  std::int64_t high = 0;

  // Within 32 bits, on both sides of zero.
  bool fits() const;
  bool has_zero() const { return low <= 0 && high >= 0; }
};

// A range around the values of an operation over values in these ranges
// (interval arithmetic, Moore 1966); a unary one ignores `left`. The operands
// fit: nothing overflows.
ValueRange range_of(Operation operation, ValueRange left, ValueRange right);

}  // namespace btcheck
