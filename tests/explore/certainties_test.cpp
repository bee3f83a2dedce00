// SPDX-License-Identifier: MIT
//
// What is certain of guards, assignments and edges: nothing that is not.
#include "explore/state/accesses.hpp"

#include <doctest/doctest.h>

#include "explore/toy.hpp"

namespace btcheck::certainties_test {
namespace {

constexpr VariableId kX{0};
constexpr VariableId kY{1};

TEST_CASE("only a constant has a constant value") {
  CHECK(constant_value(toy::assign(kX, 3)) == 3);
  CHECK(constant_value({kX, toy::variable(kY)}) == std::nullopt);
  const Expression sum = Expression::binary(
      Operation::Add, Expression::constant(1), Expression::constant(2));
  CHECK(constant_value({kX, sum}) == std::nullopt);
}

TEST_CASE("a guard demands a value where one of its conjuncts does") {
  const Expression guard = both(toy::is(kX, 2), differs(kY, 1));
  CHECK(demanded_value(guard, kX) == 2);
  CHECK(demanded_value(guard, kY) == std::nullopt);
  CHECK(demanded_value({}, kX) == std::nullopt);
}

TEST_CASE("a disjunction demands nothing") {
  const Expression guard =
      Expression::binary(Operation::Or, toy::is(kX, 2), toy::is(kY, 1));
  CHECK(demanded_value(guard, kX) == std::nullopt);
  CHECK(!excludes(guard, kX, 1));
  const Expression denied = Expression::unary(Operation::Not, toy::is(kX, 2));
  CHECK(demanded_value(denied, kX) == std::nullopt);
}

TEST_CASE("a guard excludes what it refuses and all but what it demands") {
  CHECK(excludes(toy::is(kX, 2), kX, 1));
  CHECK(!excludes(toy::is(kX, 2), kX, 2));
  CHECK(excludes(both(toy::is(kY, 0), differs(kX, 1)), kX, 1));
  CHECK(!excludes(differs(kX, 1), kX, 2));
  CHECK(!excludes(differs(kX, 1), kY, 1));
  CHECK(!excludes({}, kX, 1));
}

TEST_CASE("an edge takes time where it has to wait and a clock runs") {
  Network network;
  CHECK(takes_time(network, {{}, {}, {}, {}, {2, kUnbounded}, ""}));
  CHECK(takes_time(network, {{}, {}, {}, {}, {1, 1}, ""}));
  CHECK(!takes_time(network, {{}, {}, {}, {}, {0, 5}, ""}));
  CHECK(!takes_time(network, {{}, {}, {}, {}, kAtOnce, ""}));
  network.ticks = TickSemantics::None;
  CHECK(!takes_time(network, {{}, {}, {}, {}, {1, 1}, ""}));
}

}  // namespace
}  // namespace btcheck::certainties_test
