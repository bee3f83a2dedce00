// SPDX-License-Identifier: MIT
//
// "Can still reach", zero-time loops, components and paths against a closure
// computed naively.
#include "explore/search/stored_graph.hpp"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "explore/toy.hpp"

namespace btcheck::stored_graph_test {
namespace {

using toy::Graph;
using Matrix = std::vector<std::vector<bool>>;

// reaches[a][b]: some path of at least one admitted step leads from a to b.
template <class Admits>
Matrix closure(const Graph& graph, Admits admits) {
  const std::size_t n = graph.size();
  Matrix reaches(n, std::vector<bool>(n, false));
  for (std::size_t from = 0; from < n; ++from) {
    for (const Graph::Arc& arc : graph.arcs(from)) {
      if (admits(arc.step)) reaches[from][arc.target] = true;
    }
  }
  for (std::size_t by = 0; by < n; ++by) {
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        if (reaches[a][by] && reaches[by][b]) reaches[a][b] = true;
      }
    }
  }
  return reaches;
}

StateId id_of(std::size_t state) {
  return StateId{static_cast<std::uint32_t>(state)};
}

StoredGraph stored(const Graph& graph) {
  StoredGraph kept;
  for (std::size_t from = 0; from < graph.size(); ++from) {
    for (const Graph::Arc& arc : graph.arcs(from)) {
      kept.add(id_of(from), arc.step,
               id_of(static_cast<std::size_t>(arc.target)));
    }
  }
  kept.close(graph.size());
  return kept;
}

std::vector<bool> naive_can_reach(const Graph& graph,
                                  const std::vector<bool>& goal) {
  const Matrix reaches = closure(graph, [](Step) { return true; });
  std::vector<bool> can(goal);
  for (std::size_t a = 0; a < graph.size(); ++a) {
    for (std::size_t b = 0; b < graph.size(); ++b) {
      if (goal[b] && reaches[a][b]) can[a] = true;
    }
  }
  return can;
}

// The least state from which a step of the tree closes a cycle without time.
std::optional<std::size_t> naive_zero_time_loop(const Graph& graph) {
  const Matrix reaches =
      closure(graph, [](Step step) { return step.elapsed == 0; });
  for (std::size_t from = 0; from < graph.size(); ++from) {
    for (const Graph::Arc& arc : graph.arcs(from)) {
      const bool closes = arc.target == from || reaches[arc.target][from];
      if (arc.step.elapsed == 0 && arc.step.progress && closes) return from;
    }
  }
  return std::nullopt;
}

// Some step from one state to the other is as asked for.
template <class Admits>
bool has_step(const Graph& graph, StateId from, StateId to, Admits admits) {
  for (const Graph::Arc& arc : graph.arcs(index(from))) {
    if (arc.target == index(to) && admits(arc.step)) return true;
  }
  return false;
}

bool is_tree_step(Step step) { return step.elapsed == 0 && step.progress; }

// A cycle through the state without time and with a step of the tree.
bool is_zero_time_loop(const Graph& graph, const std::vector<StateId>& cycle,
                       StateId state) {
  bool has_tree_step = false;
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const StateId next = cycle[(i + 1) % cycle.size()];
    if (!has_step(graph, cycle[i], next,
                  [](Step step) { return step.elapsed == 0; })) {
      return false;
    }
    has_tree_step =
        has_tree_step || has_step(graph, cycle[i], next, is_tree_step);
  }
  return has_tree_step && cycle.front() == state;
}

TEST_CASE("both questions agree with a naive closure on random graphs") {
  std::mt19937 random(12);
  int loops = 0;
  for (int round = 0; round < 500; ++round) {
    CAPTURE(round);
    const Graph graph = toy::random_graph(random);
    const StoredGraph kept = stored(graph);
    CHECK(kept.size() == graph.size());
    std::vector<bool> goal(graph.size());
    for (std::size_t s = 0; s < goal.size(); ++s) goal[s] = random() % 4 == 0;
    CHECK(kept.can_reach(goal) == naive_can_reach(graph, goal));
    const auto loop = kept.on_zero_time_loop();
    const auto naive = naive_zero_time_loop(graph);
    REQUIRE(loop.has_value() == naive.has_value());
    if (loop) {
      CHECK(index(*loop) == *naive);
      CHECK(is_zero_time_loop(graph, kept.zero_time_loop(*loop), *loop));
    }
    loops += loop.has_value();
  }
  CHECK(loops > 50);
  CHECK(loops < 450);
}

TEST_CASE("every state can reach a goal that it is itself") {
  Graph graph(3);
  graph.add(0, 1);
  const StoredGraph kept = stored(graph);
  CHECK(kept.can_reach({false, true, false}) ==
        std::vector<bool>{true, true, false});
  CHECK(kept.can_reach({false, false, false}) ==
        std::vector<bool>{false, false, false});
}

constexpr Step kTree{0, 0, true};
constexpr Step kFreeMove{0, 0, false};

TEST_CASE("a cycle that time is part of is no zero-time loop") {
  Graph graph(3);
  graph.add(0, 1, kTree);
  graph.add(1, 2, kTree);
  graph.add(2, 0, {kTimeStep, 1, true});
  CHECK(!stored(graph).on_zero_time_loop().has_value());
}

TEST_CASE("a cycle of free moves alone is no zero-time loop") {
  Graph graph(2);
  graph.add(0, 1, kFreeMove);
  graph.add(1, 0, kFreeMove);
  CHECK(!stored(graph).on_zero_time_loop().has_value());
  graph.add(1, 1, kTree);
  CHECK(stored(graph).on_zero_time_loop() == StateId{1});
}

TEST_CASE("a free move may be part of a zero-time loop") {
  Graph graph(3);
  graph.add(0, 1, kTree);
  graph.add(1, 2, kTree);
  graph.add(2, 1, kFreeMove);
  CHECK(stored(graph).on_zero_time_loop() == StateId{1});
}

TEST_CASE("a zero-time loop is shown by a shortest cycle with a tree's step") {
  Graph graph(5);
  graph.add(0, 0, kFreeMove);
  graph.add(0, 1, kFreeMove);
  graph.add(1, 0, {kTimeStep, 1, true});
  graph.add(1, 2, kFreeMove);
  graph.add(2, 3, kTree);
  graph.add(2, 4, kFreeMove);
  graph.add(3, 4, kFreeMove);
  graph.add(4, 0, kFreeMove);
  const StoredGraph kept = stored(graph);
  CHECK(kept.zero_time_loop(StateId{0}) == std::vector{StateId{0}, StateId{1},
                                                       StateId{2}, StateId{3},
                                                       StateId{4}});
  graph.add(0, 0, kTree);
  CHECK(stored(graph).zero_time_loop(StateId{0}) == std::vector{StateId{0}});
}

TEST_CASE("there is no zero-time loop through a state that is on none") {
  Graph graph(2);
  graph.add(0, 1, kTree);
  graph.add(1, 1, kTree);
  CHECK(stored(graph).zero_time_loop(StateId{0}).empty());
}

TEST_CASE("components within a set are the classes of mutual reachability") {
  std::mt19937 random(13);
  for (int round = 0; round < 500; ++round) {
    CAPTURE(round);
    const Graph graph = toy::random_graph(random);
    StateSet within(graph.size());
    for (std::size_t s = 0; s < graph.size(); ++s) {
      within[s] = random() % 4 != 0;
    }
    Graph cut(graph.size());
    for (std::size_t from = 0; from < graph.size(); ++from) {
      for (const Graph::Arc& arc : graph.arcs(from)) {
        if (within[from] && within[arc.target]) cut.add(from, arc.target);
      }
    }
    const Matrix reaches = closure(cut, [](Step) { return true; });
    const auto component = stored(graph).components(within);
    for (std::size_t a = 0; a < graph.size(); ++a) {
      CHECK((component[a] == StoredGraph::kOutside) == !within[a]);
      for (std::size_t b = 0; b < graph.size(); ++b) {
        if (!within[a] || !within[b]) continue;
        const bool mutual = a == b || (reaches[a][b] && reaches[b][a]);
        CHECK((component[a] == component[b]) == mutual);
        if (reaches[a][b]) CHECK(component[b] <= component[a]);
      }
    }
  }
}

TEST_CASE("a shortest path keeps to its states until it is at the goal") {
  Graph graph(5);
  graph.add(0, 1);
  graph.add(0, 2);
  graph.add(1, 4);
  graph.add(2, 3);
  graph.add(3, 4);
  const StoredGraph kept = stored(graph);
  StateSet through(5, 0b00111);
  const StateSet goal(5, 0b10000);
  CHECK(kept.shortest_path(StateId{0}, through, goal) ==
        std::vector{StateId{0}, StateId{1}, StateId{4}});
  through.reset(1);
  CHECK(kept.shortest_path(StateId{0}, through, goal).empty());
  through.set(3);
  CHECK(kept.shortest_path(StateId{0}, through, goal).size() == 4);
  CHECK(kept.shortest_path(StateId{4}, through, goal) ==
        std::vector{StateId{4}});
}

TEST_CASE("states without steps may stand anywhere") {
  StoredGraph kept;
  kept.add(StateId{2}, kTree, StateId{0});
  kept.add(StateId{4}, kTree, StateId{2});
  kept.close(6);
  CHECK(kept.size() == 6);
  CHECK(kept.can_reach({true, false, false, false, false, false}) ==
        std::vector<bool>{true, false, true, false, true, false});
  CHECK(kept.bytes() > 0);
}

TEST_CASE("a long path needs no deep stack") {
  StoredGraph kept;
  constexpr std::uint32_t kLength = 300'000;
  for (std::uint32_t s = 0; s + 1 < kLength; ++s) {
    kept.add(StateId{s}, kTree, StateId{s + 1});
  }
  kept.close(kLength);
  std::vector<bool> goal(kLength, false);
  goal.back() = true;
  CHECK(kept.can_reach(goal) == std::vector<bool>(kLength, true));
  CHECK(!kept.on_zero_time_loop().has_value());
}

}  // namespace
}  // namespace btcheck::stored_graph_test
