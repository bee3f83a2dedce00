// SPDX-License-Identifier: MIT
//
// Successors by halves, on networks made by hand: what random trees do not
// have.
#include "explore/halves/split_network.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "explore/halves/cut.hpp"
#include "toy.hpp"

namespace btcheck::split_network_test {
namespace {

// Two state variables, each with an automaton, in different halves, and a
// third for what each test is about.
struct TwoHalves {
  toy::Draft draft;
  VariableId left = draft.variable("left", 0, 3);
  AutomatonId low = draft.automaton(AutomatonKind::Node, "low", {"a", "b"});
  AutomatonId high = draft.automaton(AutomatonKind::Node, "high", {"a", "b"});
  AutomatonId timer = draft.automaton(AutomatonKind::Timer, "timer",
                                      {"idle", "counting", "due"});
};

using Vectors = std::vector<StateVector>;

// Compares the successors of every state; how many states there are.
std::size_t compare(const Network& network, std::size_t cut) {
  const CompiledNetwork system(network, StateLayout(network, cut));
  SplitNetwork split(system);
  SplitNetwork::Worker worker(split);
  std::vector<Word> seen;
  const auto reach = [&](Word pair) {
    if (std::find(seen.begin(), seen.end(), pair) == seen.end()) {
      seen.push_back(pair);
    }
  };
  const auto vector_of = [&](Word pair) {
    StateVector vector(split.word_count());
    split.load(pair, vector.data());
    return vector;
  };
  split.initial_states(worker, reach);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const StateVector state = vector_of(seen[i]);
    Vectors found;
    Vectors expected;
    split.successors(seen[i], worker, [&](Word target) {
      found.push_back(vector_of(target));
      reach(target);
    });
    system.successors(state, [&](StateView target, Step step) {
      StateVector vector(target.begin(), target.end());
      if (step.edge != kTimeStep || vector != state) expected.push_back(vector);
    });
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    REQUIRE(found == expected);
  }
  return seen.size();
}

// At every cut, the ends included.
void compare_at_every_cut(const Network& network) {
  const std::size_t groups = network.automata.size() + 1;
  const std::size_t states = compare(network, 0);
  CHECK(states > 3);
  for (std::size_t cut = 1; cut <= groups; ++cut) {
    CAPTURE(cut);
    CHECK(compare(network, cut) == states);
  }
}

TEST_CASE("a due timer whose edge writes to the other half goes first") {
  TwoHalves of;
  of.draft.edge(of.timer, 0, 1);
  of.draft.edge(of.timer, 1, 2, {2, 2}, {}, {toy::assign(of.left, 3)});
  of.draft.edge(of.low, 0, 1, {0, kUnbounded});
  of.draft.edge(of.high, 0, 1, {1, 3}, {},
                {toy::assign(of.draft.location(of.low), 0)});
  compare_at_every_cut(of.draft.finish());
}

TEST_CASE("an edge may look at both halves in one comparison or assignment") {
  TwoHalves of;
  const VariableId right = of.draft.location(of.high);
  const auto sum = Expression::binary(Operation::Add, toy::variable(of.left),
                                      toy::variable(right));
  of.draft.edge(
      of.low, 0, 1, kAnyTime,
      Expression::binary(Operation::Less, sum, Expression::constant(3)),
      {{of.left, sum}});
  of.draft.edge(of.low, 1, 0);
  of.draft.edge(of.high, 0, 1, kAnyTime, toy::is(of.left, 0),
                {toy::assign(of.left, 1)});
  of.draft.edge(of.high, 1, 0, kAnyTime, toy::is(of.left, 2),
                {toy::assign(of.left, 0)});
  compare_at_every_cut(of.draft.finish());
}

TEST_CASE("assignments are executed in order within a half") {
  TwoHalves of;
  const auto next = Expression::binary(
      Operation::Modulo,
      Expression::binary(Operation::Add, toy::variable(of.left),
                         Expression::constant(1)),
      Expression::constant(4));
  of.draft.edge(of.high, 0, 1, kAnyTime, {},
                {{of.left, next},
                 {of.left, next},
                 toy::assign(of.draft.location(of.low), 1)});
  of.draft.edge(of.high, 1, 0, kAnyTime, {}, {{of.left, next}});
  compare_at_every_cut(of.draft.finish());
}

TEST_CASE("the best cut keeps apart what moves on its own") {
  // Two pairs of automata in step with each other, side by side.
  toy::Draft draft;
  std::vector<AutomatonId> automata;
  for (const char* name : {"a", "b", "c", "d"}) {
    automata.push_back(draft.automaton(AutomatonKind::Node, name,
                                       {"0", "1", "2", "3", "4", "5"}));
  }
  for (std::size_t leader : {0u, 2u}) {
    const VariableId follower = draft.location(automata[leader + 1]);
    for (std::uint32_t from = 0; from < 6; ++from) {
      draft.edge(automata[leader], from, (from + 1) % 6, kAnyTime, {},
                 {toy::assign(follower, static_cast<int>(from))});
    }
  }
  // Behind the group of variables that belong to nobody, a and b.
  CHECK(best_cut(CompiledNetwork(draft.finish())) == 3);
}

}  // namespace
}  // namespace btcheck::split_network_test
