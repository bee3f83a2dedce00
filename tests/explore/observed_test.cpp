// SPDX-License-Identifier: MIT
//
// What questions see: values that are compared with, and no more.
#include "explore/reduce/observed.hpp"

#include <doctest/doctest.h>

#include "explore/toy.hpp"

namespace btcheck::observed_test {
namespace {

// Two variables of four values.
struct Two {
  toy::Draft draft;
  VariableId x = draft.variable("x", 0, 3);
  VariableId y = draft.variable("y", 0, 3);
  Observed observed{draft.finish()};
};

TEST_CASE("where nothing is asked nothing is seen") {
  const Two two;
  CHECK(!two.observed.sees(two.x));
  CHECK(!two.observed.tells(two.x, 0));
  CHECK(!two.observed.tells_apart(two.x, 0, 1));
  CHECK(!two.observed.sees_death());
  CHECK(!two.observed.sees_steps());
}

TEST_CASE("a comparison tells its value from all others, and only that") {
  for (const bool is_equal : {true, false}) {
    Two two;
    two.observed.add(is_equal ? toy::is(two.x, 2) : differs(two.x, 2));
    CHECK(two.observed.sees(two.x));
    CHECK(two.observed.tells(two.x, 2));
    CHECK(!two.observed.tells(two.x, 1));
    CHECK(two.observed.tells_apart(two.x, 2, 0));
    CHECK(two.observed.tells_apart(two.x, 0, 2));
    CHECK(!two.observed.tells_apart(two.x, 0, 1));
    CHECK(!two.observed.tells_apart(two.x, 2, 2));
    CHECK(!two.observed.sees(two.y));
  }
}

TEST_CASE("two comparisons tell three kinds of values apart") {
  Two two;
  two.observed.add(both(toy::is(two.x, 0), toy::is(two.y, 3)));
  two.observed.add(toy::is(two.x, 1));
  CHECK(two.observed.tells_apart(two.x, 0, 1));
  CHECK(two.observed.tells_apart(two.x, 1, 2));
  CHECK(!two.observed.tells_apart(two.x, 2, 3));
  CHECK(two.observed.tells(two.y, 3));
}

TEST_CASE("whatever else is done with a variable sees each of its values") {
  const Two names;
  const Expression reads[] = {
      Expression::binary(Operation::Less, toy::variable(names.x),
                         Expression::constant(2)),
      Expression::binary(Operation::Equal, Expression::constant(2),
                         toy::variable(names.x)),
      Expression::binary(Operation::Equal, toy::variable(names.x),
                         toy::variable(names.y)),
      toy::variable(names.x)};
  for (const Expression& read : reads) {
    Two two;
    two.observed.add(read);
    CHECK(two.observed.tells(two.x, 1));
    CHECK(two.observed.tells_apart(two.x, 0, 1));
    CHECK(!two.observed.tells_apart(two.x, 1, 1));
  }
}

TEST_CASE("a variable seen whole stays so") {
  Two two;
  two.observed.add(toy::is(two.x, 1));
  two.observed.add(two.x);
  two.observed.add(toy::is(two.x, 1));
  CHECK(two.observed.tells_apart(two.x, 2, 3));
}

TEST_CASE("what counts in dead states is seen, and death with it") {
  Two two;
  two.observed.add(StatePredicate{toy::is(two.x, 1), std::nullopt});
  CHECK(!two.observed.sees_death());
  two.observed.add(StatePredicate{toy::is(two.x, 1), toy::is(two.y, 2)});
  CHECK(two.observed.sees_death());
  CHECK(two.observed.tells(two.y, 2));
}

TEST_CASE("propositions of steps see steps, those of states do not") {
  for (const PropositionKind kind :
       {PropositionKind::State, PropositionKind::Enter, PropositionKind::Leave,
        PropositionKind::Moves, PropositionKind::Passes}) {
    Two two;
    Proposition asked;
    asked.of.expression = toy::is(two.x, 1);
    asked.kind = kind;
    two.observed.add(std::span<const Proposition>(&asked, 1));
    CHECK(two.observed.sees_steps() == (kind != PropositionKind::State));
    CHECK(two.observed.tells(two.x, 1));
  }
}

}  // namespace
}  // namespace btcheck::observed_test
