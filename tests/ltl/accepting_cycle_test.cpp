// SPDX-License-Identifier: MIT
//
// Products and the search for accepting cycles, on systems drawn by hand.
#include "ltl/product/accepting_cycle.hpp"

#include <doctest/doctest.h>

#include "ltl/buchi/translate.hpp"
#include "ltl/formula_text.hpp"
#include "ltl/product/product.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::accepting_cycle_test {

namespace {

using reference::ToySystem;

constexpr Step kMove{.edge = 0, .elapsed = 0, .progress = true};
constexpr Step kFree{.edge = 1, .elapsed = 0, .progress = false};

RunSearch search(const ToySystem& system, std::string_view formula,
                 Justice justice = Justice::EveryStepIsProgress,
                 const Limits& limits = {}) {
  FormulaPool pool;
  const auto automaton = translate(pool, parse(pool, formula));
  REQUIRE(automaton);
  return find_accepting_cycle(Product(system, *automaton, justice), limits);
}

// 0 -> 1 -> 2 -> … -> size - 1, which has a step to itself; the label of state
// i is i.
ToySystem chain(std::uint32_t size) {
  ToySystem system;
  for (std::uint32_t i = 0; i < size; ++i) {
    system.add(i, {{std::min(i + 1, size - 1), kMove}});
  }
  system.add_initial(0);
  return system;
}

}  // namespace

static_assert(FairSystem<Product<ToySystem>>);

TEST_CASE("a cycle through the first state itself is accepting") {
  ToySystem system;
  system.add(1, {{0, kMove}});
  system.add_initial(0);
  const RunSearch result = search(system, "[]a");
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.lasso->prefix.size() == 1);
  CHECK(result.lasso->cycle.size() == 1);
  CHECK(result.lasso->closing == kMove);
}

TEST_CASE("a system without the formula's runs is searched to the end") {
  const RunSearch result = search(chain(4), "[]<>a && []<>!a");
  CHECK(result.outcome == SearchOutcome::Empty);
  CHECK(result.stopped == StopReason::None);
  CHECK_FALSE(result.lasso);
  CHECK(result.progress.expanded == result.progress.states);
}

TEST_CASE("the empty automaton has no runs") {
  CHECK(search(chain(3), "false").outcome == SearchOutcome::Empty);
}

TEST_CASE("the label read is the one of the state left") {
  CHECK(search(chain(2), "!a && X a").outcome == SearchOutcome::Found);
  CHECK(search(chain(2), "a").outcome == SearchOutcome::Empty);
}

TEST_CASE("a cycle of free moves alone is no run") {
  ToySystem system;
  system.add(0, {{0, kFree}, {1, kMove}});
  system.add(1, {{1, kMove}});
  system.add_initial(0);
  const Justice justice = Justice::SomeStepsAreNot;
  CHECK(search(system, "[]!a", justice).outcome == SearchOutcome::Empty);
  CHECK(search(system, "<>a", justice).outcome == SearchOutcome::Found);
  system.add_step(0, 0, kMove);
  CHECK(search(system, "[]!a", justice).outcome == SearchOutcome::Found);
}

TEST_CASE("the run told goes the shortest way to the cycle") {
  ToySystem system;  // a long way round to 9 is listed first
  for (std::uint32_t i = 0; i < 9; ++i) system.add(0, {{i + 1, kMove}});
  system.add(1, {{9, kMove}});
  system.add_step(0, 9, kFree);
  system.add_initial(0);
  const RunSearch result = search(system, "<>a");
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.lasso->prefix.size() + result.lasso->cycle.size() <= 3);
}

TEST_CASE("the cycle told passes all acceptance sets and little else") {
  ToySystem system;  // a ring of 10 with a chord that skips 4 to 8
  for (std::uint32_t i = 0; i < 10; ++i) {
    system.add(i == 1 ? 1 : i == 3 ? 2 : 0, {{(i + 1) % 10, kMove}});
  }
  system.add_step(3, 9, kMove);
  system.add_initial(0);
  const RunSearch result = search(system, "[]<>a && []<>b");
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.lasso->cycle.size() == 5);
}

TEST_CASE("a search that reaches its limit gives up and says where") {
  const RunSearch result =
      search(chain(100000), "[]<>a && []<>!a", Justice::EveryStepIsProgress,
             Limits{.max_states = 5000});
  CHECK(result.outcome == SearchOutcome::GaveUp);
  CHECK(result.stopped == StopReason::MaxStates);
  CHECK(result.progress.states >= 5000);
  CHECK(result.progress.states < 5000 + 4 * kPollInterval);
  CHECK(result.progress.bytes > 0);
}

TEST_CASE("a turn that adds no set is cut from a closed walk") {
  const StateId a{0};
  const StateId b{1};
  const StateId c{2};
  std::vector<Hop> walk = {
      {a, b, {}, 0}, {b, c, {}, 1}, {c, b, {}, 0}, {b, a, {}, 1}};
  const MarkTable table(0);
  cut_useless_turns(walk, 1, table);
  CHECK(walk.size() == 2);
  CHECK((walk[0].sets | walk[1].sets) == 1);
  cut_useless_turns(walk, 0, table);
  CHECK(walk.size() == 2);
}

TEST_CASE("a turn that grants what is requested stays in a closed walk") {
  MarkTable table(1);
  const boost::dynamic_bitset<> none(1);
  const boost::dynamic_bitset<> one(1, 1);
  const std::uint32_t request = table.number(one, none);
  const std::uint32_t grant = table.number(none, one);
  const StateId a{0};
  const StateId b{1};
  const StateId c{2};
  std::vector<Hop> walk = {{a, b, {}, 0, 0},
                           {b, c, {}, 0, grant},
                           {c, b, {}, 0, 0},
                           {b, a, {}, 0, request}};
  cut_useless_turns(walk, 0, table);
  CHECK(walk.size() == 4);
  walk.back().marks = 0;
  cut_useless_turns(walk, 0, table);
  CHECK(walk.size() == 2);
}

TEST_CASE("components merge with all that lies between") {
  OpenComponents components;
  components.open(1, 0);
  components.open(2, 1);
  components.open(3, 2);
  CHECK(components.merge(3, 8) == 8);
  CHECK(components.merge(1, 4) == (1 | 2 | 4 | 8));
  CHECK(components.root() == 1);
  CHECK(components.sets() == (1 | 2 | 4 | 8));
}

}  // namespace btcheck::accepting_cycle_test
