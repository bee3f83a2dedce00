// SPDX-License-Identifier: MIT
//
// Numbers that are counted in steps: decimals in whole numbers, exactly.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "model/tree/expression.hpp"
#include "text/numbers.hpp"

namespace btcheck {

// A whole number n stands for n * step / 10^decimals.
struct Scale {
  int step = 1;
  int decimals = 0;

  // Each whole number stands for itself.
  bool is_one() const { return step == 1 && decimals == 0; }
  // What n stands for, "1.5".
  std::string text(std::int64_t n) const;
  friend bool operator==(const Scale&, const Scale&) = default;
};

// The whole number that n is in this relation to where what n stands for is in
// it to `number`. Nothing where the relation is Equal or NotEqual and `number`
// lies between two steps.
std::optional<std::int64_t> bound_of(Operation relation, const Scale& scale,
                                     Decimal number);

// Whether a value is a whole number of steps.
enum class OnSteps : std::uint8_t { Always, Sometimes, Never, TooFine };

// value / 10^decimals, counted in the steps of a scale.
struct Counted {
  OnSteps is = OnSteps::Always;  // TooFine: 32 bits do not tell
  Expression value;
  Expression fits;  // of Sometimes: where it is a whole number of them
};
Counted counted_in(const Scale& scale, const Expression& value, int decimals);

}  // namespace btcheck
