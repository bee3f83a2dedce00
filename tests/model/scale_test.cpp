// SPDX-License-Identifier: MIT
//
// Numbers in steps against fractions: what is rounded and what is refused.
#include <doctest/doctest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "model/tree/scale.hpp"

namespace btcheck::scale_test {
namespace {

constexpr Operation kRelations[] = {
    Operation::Equal,     Operation::NotEqual, Operation::Less,
    Operation::LessEqual, Operation::Greater,  Operation::GreaterEqual};
constexpr Scale kScales[] = {{1, 0}, {1, 1}, {5, 1}, {25, 2}, {5, 0}, {3, 2}};

// Both sides as whole thousandths.
std::int64_t thousandths(const Scale& scale, std::int64_t n) {
  return n * scale.step * power_of_ten(3 - scale.decimals);
}
std::int64_t thousandths(Decimal number) {
  return number.digits * power_of_ten(3 - number.decimals);
}

// One of a few operations over a variable, and constants.
Expression random_value(std::mt19937& random, int depth) {
  const auto below = [&](unsigned bound) {
    return static_cast<int>(random() % bound);
  };
  if (depth == 0 || below(4) == 0) {
    return below(2) == 0 ? Expression::variable(0)
                         : Expression::constant(below(41) - 20);
  }
  constexpr Operation kOperations[] = {Operation::Add,      Operation::Subtract,
                                       Operation::Multiply, Operation::Negate,
                                       Operation::Modulo,   Operation::Less};
  const Operation operation = kOperations[below(6)];
  if (operation == Operation::Negate) {
    return Expression::unary(operation, random_value(random, depth - 1));
  }
  return Expression::binary(operation, random_value(random, depth - 1),
                            random_value(random, depth - 1));
}

std::int64_t with(const Expression& expression, std::int64_t value) {
  return expression.evaluate([=](const Term&) { return value; });
}

}  // namespace

TEST_CASE("numbers are read without rounding") {
  CHECK(decimal_number("-0.250") == Decimal{-25, 2});
  CHECK(decimal_number("+.5") == Decimal{5, 1});
  CHECK(decimal_number("7") == Decimal{7, 0});
  CHECK(decimal_number("3.") == Decimal{3, 0});
  CHECK(decimal_number("-2147483648") == Decimal{-2147483647 - 1, 0});
  CHECK(decimal_number("0.000000001") == Decimal{1, 9});
  for (const char* const none :
       {"", ".", "-", "1.2.3", "5m", "0x1", "1e3", "--1", "2147483648",
        "0.0000000001", "99999999999999999999", "3.1415926535"}) {
    CAPTURE(none);
    CHECK_FALSE(decimal_number(none).has_value());
  }
  CHECK(Decimal{1, 1}.nearest() == 0.1);
  CHECK(Decimal{-4350, 3}.nearest() == -4.35);
}

TEST_CASE("a bound stands where the number stands") {
  for (const Scale& scale : kScales) {
    for (int digits = -60; digits <= 60; ++digits) {
      for (int decimals = 0; decimals <= 2; ++decimals) {
        const Decimal number{digits, decimals};
        for (const Operation relation : kRelations) {
          const auto bound = bound_of(relation, scale, number);
          for (int n = -70; n <= 70; ++n) {
            const bool expected =
                apply(relation, thousandths(scale, n), thousandths(number));
            const bool found = bound ? apply(relation, n, *bound) != 0
                                     : relation == Operation::NotEqual;
            REQUIRE(found == expected);
          }
        }
      }
    }
  }
}

TEST_CASE("what is assigned is a whole number of steps, or it is known where") {
  std::mt19937 random(7);
  int always = 0;
  int sometimes = 0;
  int never = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Scale& scale = kScales[random() % std::size(kScales)];
    const int decimals = static_cast<int>(random() % 3);
    const Expression value = random_value(random, 3);
    const Counted counted = counted_in(scale, value, decimals);
    always += counted.is == OnSteps::Always;
    sometimes += counted.is == OnSteps::Sometimes;
    never += counted.is == OnSteps::Never;
    for (int n = -15; n <= 15; ++n) {
      const std::int64_t wanted = with(value, n) * power_of_ten(3 - decimals);
      const std::int64_t step = thousandths(scale, 1);
      const bool fits = wanted % step == 0;
      if (counted.is == OnSteps::Always) REQUIRE(fits);
      if (counted.is == OnSteps::Never) REQUIRE_FALSE(fits);
      if (counted.is == OnSteps::Sometimes) {
        REQUIRE((with(counted.fits, n) != 0) == fits);
      }
      if (fits) REQUIRE(with(counted.value, n) == wanted / step);
    }
  }
  CHECK(always > 1000);
  CHECK(sometimes > 1000);
  CHECK(never > 500);
}

TEST_CASE("what 32 bits cannot tell apart is said to be so") {
  CHECK(counted_in({7, 0}, Expression::variable(0), 9).is == OnSteps::TooFine);
  CHECK(counted_in({1, 9}, Expression::variable(0), 9).is == OnSteps::Always);
}

}  // namespace btcheck::scale_test
