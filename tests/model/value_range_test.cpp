// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <vector>

#include "model/tree/value_range.hpp"

namespace btcheck::value_range_test {
namespace {

using enum Operation;

constexpr std::array kOperations = {
    Negate,   Not,  Add,       Subtract, Multiply,     Divide, Modulo, Equal,
    NotEqual, Less, LessEqual, Greater,  GreaterEqual, And,    Or};

std::vector<ValueRange> ranges_within(std::int64_t most) {
  std::vector<ValueRange> ranges;
  for (std::int64_t low = -most; low <= most; ++low) {
    for (std::int64_t high = low; high <= most; ++high) {
      ranges.push_back({low, high});
    }
  }
  return ranges;
}

// Whether every result lies in the range, and the only one is all of it.
bool is_right(Operation operation, ValueRange left, ValueRange right) {
  const ValueRange found = range_of(operation, left, right);
  for (std::int64_t a = left.low; a <= left.high; ++a) {
    for (std::int64_t b = right.low; b <= right.high; ++b) {
      if (!found.has(apply(operation, a, b))) return false;
    }
  }
  const bool is_exact = left.is_one() && right.is_one();
  return !is_exact || found.is_one();
}

}  // namespace

TEST_CASE("a range holds every result, and of single values only the result") {
  const std::vector<ValueRange> ranges = ranges_within(5);
  for (const Operation operation : kOperations) {
    for (const ValueRange left : ranges) {
      for (const ValueRange right : ranges) {
        if (is_right(operation, left, right)) continue;
        FAIL_CHECK(static_cast<int>(operation)
                   << " of " << left.low << ".." << left.high << " and "
                   << right.low << ".." << right.high);
      }
    }
  }
}

TEST_CASE("ranges saturate as expressions do") {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  const ValueRange all{kLeast, kMost};
  CHECK(range_of(Add, all, {1, 1}) == ValueRange{kLeast + 1, kMost});
  CHECK(range_of(Multiply, all, {2, 2}) == all);
  CHECK(range_of(Negate, {}, all) == ValueRange{-kMost, kMost});
  CHECK(range_of(Divide, all, {-1, -1}) == ValueRange{-kMost, kMost});
  CHECK(range_of(Modulo, all, {-1, -1}).has(0));
  CHECK(range_of(Less, all, all) == ValueRange{0, 1});
}

TEST_CASE("comparisons of one variable come out sharply") {
  const auto with_x = [](Operation operation, int constant) {
    return Expression::binary(operation, Expression::variable(0),
                              Expression::constant(constant));
  };
  const Expression sum =
      Expression::binary(Less, with_x(Add, 3), Expression::constant(10));
  CHECK(range_of(sum.terms(), {0, 6}) == ValueRange{1, 1});
  CHECK(range_of(sum.terms(), {7, 9}) == ValueRange{0, 0});
  CHECK(range_of(sum.terms(), {6, 7}) == ValueRange{0, 1});
  CHECK(range_of(with_x(Modulo, 10).terms(), {23, 27}) == ValueRange{3, 7});
  CHECK(range_of(with_x(Divide, 10).terms(), {20, 29}) == ValueRange{2, 2});
  CHECK(range_of(Expression().terms(), {0, 9}) == ValueRange{1, 1});
}

}  // namespace btcheck::value_range_test
