// SPDX-License-Identifier: MIT
//
// Expressions: values, substitution, operands, and their text.
#include "model/tree/expression.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

namespace btcheck::expression_test {
namespace {

using E = Expression;

E number(int value) { return E::constant(value); }
E variable(int id) { return E::variable(id); }

E apply_to(Operation operation, E left, E right) {
  return E::binary(operation, std::move(left), std::move(right));
}

std::int64_t value(const E& expression) {
  return expression.evaluate([](const Term& term) {
    return term.operation == Operation::Status ? 100 + term.operand
                                               : term.operand;
  });
}

std::string text(const E& expression) {
  return expression.text(
      [](const Term& term) {
        const char* kind = term.operation == Operation::Status ? "s" : "v";
        return kind + std::to_string(term.operand);
      },
      [](const Term& beside, std::int32_t constant) {
        return std::to_string(beside.operand) + "is" + std::to_string(constant);
      });
}

TEST_CASE("an empty expression is true") {
  CHECK(E().is_true());
  CHECK(value(E()) == 1);
  CHECK(text(E()) == "true");
  CHECK(value(E::unary(Operation::Not, E())) == 0);
  CHECK(value(apply_to(Operation::And, E(), number(0))) == 0);
}

TEST_CASE("every operation has its value") {
  const struct {
    Operation operation;
    std::int64_t expected;
  } kCases[] = {{Operation::Add, -4},
                {Operation::Subtract, -10},
                {Operation::Multiply, -21},
                {Operation::Divide, -2},
                {Operation::Modulo, -1},
                {Operation::Equal, 0},
                {Operation::NotEqual, 1},
                {Operation::Less, 1},
                {Operation::LessEqual, 1},
                {Operation::Greater, 0},
                {Operation::GreaterEqual, 0},
                {Operation::And, 1},
                {Operation::Or, 1}};
  for (const auto& each : kCases) {
    CHECK(value(apply_to(each.operation, number(-7), number(3))) ==
          each.expected);
  }
  CHECK(value(E::unary(Operation::Negate, number(7))) == -7);
  CHECK(value(E::unary(Operation::Not, number(7))) == 0);
  CHECK(value(E::unary(Operation::Not, number(0))) == 1);
}

TEST_CASE("division by zero gives zero and is listed among the divisors") {
  const E zero = apply_to(Operation::Subtract, variable(1), number(1));
  CHECK(value(apply_to(Operation::Divide, number(7), zero)) == 0);
  CHECK(value(apply_to(Operation::Modulo, number(7), zero)) == 0);
  const E nested =
      apply_to(Operation::Divide,
               apply_to(Operation::Modulo, number(9), variable(2)), zero);
  const std::vector<E> divisors = nested.divisors();
  REQUIRE(divisors.size() == 2);
  CHECK(divisors[0] == variable(2));
  CHECK(divisors[1] == zero);
  CHECK(number(3).divisors().empty());
}

TEST_CASE("arithmetic saturates at the ends of 64 bits") {
  E large = number(std::numeric_limits<int>::max());
  for (int i = 0; i < 2; ++i)
    large = apply_to(Operation::Multiply, large, large);
  CHECK(value(large) == std::numeric_limits<std::int64_t>::max());
  const E small = E::unary(Operation::Negate, large);
  const E least = apply_to(Operation::Subtract, small, large);
  CHECK(value(least) == std::numeric_limits<std::int64_t>::min());
  CHECK(value(apply_to(Operation::Add, least, small)) ==
        std::numeric_limits<std::int64_t>::min());
  CHECK(value(apply_to(Operation::Divide, least, number(-1))) ==
        std::numeric_limits<std::int64_t>::max());
  CHECK(value(apply_to(Operation::Modulo, least, number(-1))) == 0);
  CHECK(value(E::unary(Operation::Negate, least)) ==
        std::numeric_limits<std::int64_t>::max());
}

TEST_CASE("variables and statuses are read, and can be replaced") {
  const E sum = apply_to(Operation::Add, variable(4), E::status(2));
  CHECK(value(sum) == 106);
  const E shifted = sum.replaced([](const Term& term) {
    return apply_to(Operation::Multiply, number(2), variable(term.operand));
  });
  CHECK(value(shifted) == 12);
  CHECK(text(shifted) == "2 * v4 + 2 * v2");
  CHECK(value(sum.replaced([](const Term&) { return E(); })) == 2);
}

TEST_CASE("text has the parentheses it needs and no more") {
  const E a = variable(1);
  const E b = variable(2);
  const E is_equal = apply_to(Operation::Equal, a, b);
  CHECK(text(apply_to(Operation::Multiply, apply_to(Operation::Add, a, b),
                      number(3))) == "(v1 + v2) * 3");
  CHECK(text(apply_to(Operation::Add, apply_to(Operation::Add, a, b),
                      number(3))) == "v1 + v2 + 3");
  CHECK(text(apply_to(Operation::Subtract, a,
                      apply_to(Operation::Subtract, b, number(3)))) ==
        "v1 - (v2 - 3)");
  CHECK(text(apply_to(Operation::Or, apply_to(Operation::And, is_equal, a),
                      b)) == "v1 = v2 and v1 or v2");
  CHECK(text(apply_to(Operation::And, apply_to(Operation::Or, is_equal, a),
                      b)) == "(v1 = v2 or v1) and v2");
  CHECK(text(E::unary(Operation::Not, is_equal)) == "not (v1 = v2)");
  CHECK(text(E::unary(Operation::Negate, a)) == "-v1");
  CHECK(text(apply_to(Operation::Equal, is_equal, a)) == "(v1 = v2) = v1");
}

TEST_CASE("a constant beside a variable is printed by the name of its value") {
  CHECK(text(apply_to(Operation::Equal, variable(7), number(2))) ==
        "v7 = 7is2");
  CHECK(text(apply_to(Operation::NotEqual, number(1), E::status(5))) ==
        "5is1 ~= s5");
  CHECK(text(apply_to(Operation::Add, variable(7), number(2))) == "v7 + 2");
  CHECK(text(apply_to(Operation::Less, number(1), number(2))) == "1 < 2");
}

TEST_CASE("a conjunction drops what is true, and can be taken apart") {
  const E a = variable(1);
  CHECK(both(E(), a) == a);
  CHECK(both(a, E()) == a);
  CHECK(both(number(1), a) == a);
  CHECK(both(E(), E()).is_true());
  const E all = both(both(a, variable(2)), both(variable(3), variable(4)));
  REQUIRE(all.conjuncts().size() == 4);
  CHECK(all.conjuncts()[0] == a);
  CHECK(all.conjuncts()[3] == variable(4));
  CHECK(a.conjuncts() == std::vector<E>{a});
  CHECK(E().conjuncts().empty());
}

TEST_CASE("a chain of a hundred thousand terms needs no deep stack") {
  E sum = number(0);
  for (int i = 0; i < 100'000; ++i) {
    sum = apply_to(Operation::Add, std::move(sum), number(1));
  }
  CHECK(value(sum) == 100'000);
  CHECK(text(sum).size() == 400'001);
}

}  // namespace
}  // namespace btcheck::expression_test
