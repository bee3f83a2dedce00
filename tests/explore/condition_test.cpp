// SPDX-License-Identifier: MIT
//
// Compiled conditions say what the expression says, on every state.
#include "explore/state/condition.hpp"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "explore/toy.hpp"

namespace btcheck::condition_test {
namespace {

// x in -2..3, b in 0..1, y in 0..6, c = 4, far in its own word.
struct Variables {
  Variables() {
    x = draft.variable("x", -2, 3);
    b = draft.variable("b", 0, 1);
    y = draft.variable("y", 0, 6);
    c = draft.variable("c", 4, 4, 4);
    for (int i = 0; i < 3; ++i) draft.variable("fill", 0, (1 << 30) - 1);
    far = draft.variable("far", 100, 109, 100);
    network = draft.finish();
  }

  toy::Draft draft;
  VariableId x, b, y, c, far;
  Network network;
};

StateVector random_state(const Network& network, const StateLayout& layout,
                         std::mt19937& random) {
  StateVector state(layout.words, 0);
  for (std::size_t v = 0; v < network.variables.size(); ++v) {
    const Variable& variable = network.variables[v];
    const auto size = static_cast<std::uint64_t>(variable.domain_size());
    layout.fields[v].put(state.data(), variable.min + static_cast<std::int64_t>(
                                                          random() % size));
  }
  return state;
}

std::int64_t naive(const Expression& expression, const StateLayout& layout,
                   const StateVector& state) {
  return expression.evaluate([&](const Term& term) {
    return layout.fields[static_cast<std::size_t>(term.operand)].get(
        state.data());
  });
}

// The condition and the value agree with the expression on random states.
void check_agreement(const Network& network,
                     const std::vector<Expression>& expressions, int states) {
  const StateLayout layout(network);
  ConditionPool pool(network, layout);
  std::vector<Condition> conditions;
  std::vector<Program> values;
  for (const Expression& expression : expressions) {
    conditions.push_back(pool.compile(expression));
    values.push_back(pool.compile_value(expression));
  }
  std::mt19937 random(3);
  std::vector<int> disagreements(expressions.size(), 0);
  for (int n = 0; n < states; ++n) {
    const StateVector state = random_state(network, layout, random);
    for (std::size_t i = 0; i < expressions.size(); ++i) {
      const std::int64_t expected = naive(expressions[i], layout, state);
      disagreements[i] +=
          pool.holds(conditions[i], state.data()) != (expected != 0);
      disagreements[i] += pool.value(values[i], state.data()) != expected;
    }
  }
  for (std::size_t i = 0; i < expressions.size(); ++i) {
    CAPTURE(i);
    CHECK(disagreements[i] == 0);
  }
}

constexpr Operation kBinary[] = {
    Operation::Add,      Operation::Subtract,     Operation::Multiply,
    Operation::Divide,   Operation::Modulo,       Operation::Equal,
    Operation::NotEqual, Operation::Less,         Operation::LessEqual,
    Operation::Greater,  Operation::GreaterEqual, Operation::And,
    Operation::Or};

TEST_CASE("every operation is compiled") {
  const Variables of;
  std::vector<Expression> all;
  for (const Operation operation : kBinary) {
    all.push_back(Expression::binary(operation, toy::variable(of.x),
                                     toy::variable(of.y)));
    for (int constant = -3; constant <= 7; ++constant) {
      all.push_back(Expression::binary(operation, toy::variable(of.x),
                                       Expression::constant(constant)));
      all.push_back(Expression::binary(
          operation, Expression::constant(constant), toy::variable(of.b)));
    }
  }
  for (const Operation operation : {Operation::Not, Operation::Negate}) {
    all.push_back(Expression::unary(operation, toy::variable(of.x)));
    all.push_back(Expression::unary(operation, toy::variable(of.far)));
  }
  check_agreement(of.network, all, 300);
}

TEST_CASE("an empty condition is true") {
  const Variables of;
  check_agreement(
      of.network,
      {Expression{}, Expression::constant(0), Expression::constant(5)}, 5);
}

TEST_CASE("comparisons with every constant, inside the domain and beyond") {
  const Variables of;
  std::vector<Expression> all;
  for (const VariableId id : {of.x, of.b, of.y, of.c, of.far}) {
    const Variable& variable = of.network.variable(id);
    for (int value = variable.min - 3; value <= variable.max + 9; ++value) {
      all.push_back(toy::is(id, value));
      all.push_back(Expression::binary(Operation::NotEqual, toy::variable(id),
                                       Expression::constant(value)));
    }
  }
  check_agreement(of.network, all, 200);
}

TEST_CASE("equalities in one word are merged, contradictions are not lost") {
  const Variables of;
  const auto differs = [&](VariableId id, int value) {
    return Expression::binary(Operation::NotEqual, toy::variable(id),
                              Expression::constant(value));
  };
  check_agreement(
      of.network,
      {both(toy::is(of.x, 1), toy::is(of.y, 2)),
       both(toy::is(of.x, 1), both(toy::is(of.b, 0), toy::is(of.y, 2))),
       both(toy::is(of.x, 1), toy::is(of.x, 1)),
       both(toy::is(of.x, 1), toy::is(of.x, 2)),
       both(differs(of.x, 1), differs(of.x, 2)),
       both(toy::is(of.y, 3), differs(of.b, 0)),
       both(differs(of.b, 0), differs(of.b, 1)),
       both(toy::is(of.b, 1), both(differs(of.far, 104), toy::is(of.y, 0))),
       both(toy::is(of.x, 9), toy::is(of.y, 2)),
       both(toy::is(of.x, 2), toy::is(of.far, 105))},
      2000);
}

TEST_CASE("conditions compiled one after the other do not touch each other") {
  const Variables of;
  const StateLayout layout(of.network);
  ConditionPool pool(of.network, layout);
  const Condition first = pool.compile(toy::is(of.x, 1));
  const Condition second = pool.compile(toy::is(of.y, 2));
  StateVector state(layout.words, 0);
  layout.fields[index(of.x)].put(state.data(), 1);
  layout.fields[index(of.y)].put(state.data(), 3);
  CHECK(pool.holds(first, state.data()));
  CHECK(!pool.holds(second, state.data()));
}

Expression random_expression(const Network& network, std::mt19937& random,
                             int operations) {
  std::vector<Expression> stack;
  for (int n = 0; n <= operations; ++n) {
    const auto variable =
        static_cast<std::int32_t>(random() % network.variables.size());
    stack.push_back(random() % 3 == 0 ? Expression::constant(
                                            static_cast<int>(random() % 13) - 4)
                                      : Expression::variable(variable));
  }
  while (stack.size() > 1) {
    Expression right = stack.back();
    stack.pop_back();
    Expression left = stack.back();
    stack.pop_back();
    if (random() % 6 == 0) {
      left = Expression::unary(
          random() % 2 == 0 ? Operation::Not : Operation::Negate, left);
    }
    stack.insert(stack.begin() +
                     static_cast<std::ptrdiff_t>(random() % (stack.size() + 1)),
                 Expression::binary(kBinary[random() % std::size(kBinary)],
                                    left, right));
  }
  return stack.front();
}

TEST_CASE("random expressions agree with their evaluation") {
  const Variables of;
  std::mt19937 random(77);
  std::vector<Expression> all;
  for (int n = 0; n < 400; ++n) {
    all.push_back(
        random_expression(of.network, random, static_cast<int>(n % 12)));
    all.push_back(both(toy::is(of.x, static_cast<int>(random() % 6) - 2),
                       random_expression(of.network, random, 3)));
  }
  check_agreement(of.network, all, 60);
}

}  // namespace
}  // namespace btcheck::condition_test
