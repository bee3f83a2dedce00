// SPDX-License-Identifier: MIT
//
// Random walks on graphs without any tree behind them.
#include "explore/search/random_walks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "explore/toy.hpp"

namespace btcheck::random_walks_test {
namespace {

using toy::Graph;

struct Passers : ReachabilityVisitor {
  GoOn expanded(StateId id, StateView state, bool is_dead) {
    states.insert(state[0]);
    ids.insert(id);
    if (is_dead) dead.insert(state[0]);
    ++shown;
    return GoOn::Yes;
  }
  std::set<Word> states;
  std::set<Word> dead;
  std::set<StateId> ids;
  std::size_t shown = 0;
};

constexpr auto kAlways = [] { return true; };

// A row of choices: edge 1 leads on, edge 0 back to the start.
Graph ladder(std::size_t length) {
  Graph graph(length + 1);
  graph.add_initial(0);
  for (std::size_t i = 0; i < length; ++i) {
    for (int back = 0; back < 7; ++back) graph.add(i, 0, {0, 0, true});
    graph.add(i, i + 1, {1, 0, true});
  }
  return graph;
}

TEST_CASE("hopeful walks come to the end of what chance does not climb") {
  const Graph graph = ladder(40);
  const Limits limits;
  Passers by_hope, by_chance;
  RandomWalks(graph, limits, {false, true}).run(by_hope, 2000, kAlways);
  RandomWalks(graph, limits, {false, false}).run(by_chance, 2000, kAlways);
  CHECK(by_hope.dead == std::set<Word>{40});
  CHECK(by_chance.dead.empty());
}

TEST_CASE("each path told is one of the graph's, from its start") {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    const Graph graph = toy::random_graph(random);
    const Limits limits;
    RandomWalks walks(graph, limits, std::vector<bool>(8, true));
    Passers passers;
    walks.run(passers, 500, kAlways);
    CHECK(passers.shown == 500);
    for (const StateId id : passers.ids) {
      const std::vector<RunState> path = walks.path_to(id);
      CHECK(path.front().state[0] == 0);
      for (std::size_t i = 1; i < path.size(); ++i) {
        const auto& arcs = graph.arcs(path[i - 1].state[0]);
        CHECK(std::ranges::any_of(arcs, [&](const Graph::Arc& arc) {
          return arc.target == path[i].state[0];
        }));
      }
    }
    for (const Word dead : passers.dead) {
      CHECK(std::ranges::all_of(graph.arcs(dead), [&](const Graph::Arc& arc) {
        return arc.target == dead && arc.step.edge == kTimeStep;
      }));
    }
  }
}

TEST_CASE("walks are the same each time, and stop when they are told to") {
  const Graph graph = ladder(10);
  const Limits limits;
  Passers first, second, stopped;
  RandomWalks(graph, limits, {false, true}).run(first, 300, kAlways);
  RandomWalks(graph, limits, {false, true}).run(second, 300, kAlways);
  CHECK(first.states == second.states);
  int asked = 0;
  RandomWalks(graph, limits, {false, true}).run(stopped, 100'000, [&] {
    return ++asked < 3;
  });
  CHECK(stopped.shown < 300);
}

}  // namespace
}  // namespace btcheck::random_walks_test
