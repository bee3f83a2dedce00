// SPDX-License-Identifier: MIT
//
// Breadth-first and depth-first search on graphs without any tree behind them.
#include <doctest/doctest.h>

#include <map>
#include <set>
#include <vector>

#include "explore/search/reachability.hpp"
#include "explore/toy.hpp"

namespace btcheck::search_test {
namespace {

using toy::Graph;

// Notes everything that a search shows, and stops where it is told to.
struct Witness : ReachabilityVisitor {
  void stepped(StateId from, Step step, StateId to) {
    CHECK(is_stored(to));
    CHECK(!is_expanded(from));
    steps.push_back({index(from), index(to), step});
  }
  GoOn expanded(StateId id, StateView state, bool is_dead) {
    CHECK(number_of.emplace(state[0], id).second);
    ids.insert(index(id));
    if (is_dead) dead.insert(state[0]);
    return stop_at == state[0] ? GoOn::No : GoOn::Yes;
  }
  bool is_stored(StateId id) const { return index(id) < 1'000'000; }
  bool is_expanded(StateId id) const { return ids.contains(index(id)); }
  std::size_t bytes() const { return own_bytes; }

  struct Seen {
    std::uint32_t from, to;
    Step step;
  };
  std::vector<Seen> steps;
  std::map<Word, StateId> number_of;
  std::set<std::uint32_t> ids;
  std::set<Word> dead;
  Word stop_at = ~Word{0};
  std::size_t own_bytes = 0;
};

// How many steps each reachable state is away, by the definition.
std::map<Word, std::size_t> distances(const Graph& graph) {
  std::map<Word, std::size_t> known{{0, 0}};
  for (std::size_t round = 0; round < graph.size(); ++round) {
    for (const auto& [state, distance] : std::map(known)) {
      for (const Graph::Arc& arc : graph.arcs(state)) {
        const auto entry = known.emplace(arc.target, distance + 1).first;
        entry->second = std::min(entry->second, distance + 1);
      }
    }
  }
  return known;
}

bool is_path(const Graph& graph, const std::vector<RunState>& path) {
  if (path.empty() || path[0].state != StateVector{0}) return false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    bool found = false;
    for (const Graph::Arc& arc : graph.arcs(path[i - 1].state[0])) {
      found |= arc.target == path[i].state[0] && arc.step == path[i].step;
    }
    if (!found) return false;
  }
  return true;
}

// The steps that change the state, counted.
std::uint64_t transitions_of(const Graph& graph,
                             const std::map<Word, std::size_t>& reached) {
  std::uint64_t count = 0;
  for (const auto& [state, distance] : reached) {
    for (const Graph::Arc& arc : graph.arcs(state)) {
      count += arc.step.edge != kTimeStep || arc.target != state;
    }
  }
  return count;
}

std::set<Word> dead_states(const Graph& graph,
                           const std::map<Word, std::size_t>& reached) {
  std::set<Word> dead;
  for (const auto& [state, distance] : reached) {
    bool is_dead = true;
    for (const Graph::Arc& arc : graph.arcs(state)) {
      is_dead &= arc.step.edge == kTimeStep && arc.target == state;
    }
    if (is_dead) dead.insert(state);
  }
  return dead;
}

template <class Search>
void check_search(const Graph& graph, Search&& search, bool is_shortest) {
  const auto reached = distances(graph);
  Witness witness;
  const ReachabilityResult result = search.run(witness);
  CHECK(result.is_complete);
  CHECK(result.stopped == StopReason::None);
  CHECK(result.progress.states == reached.size());
  CHECK(result.progress.expanded == reached.size());
  CHECK(result.progress.transitions == transitions_of(graph, reached));
  CHECK(witness.number_of.size() == reached.size());
  CHECK(witness.dead == dead_states(graph, reached));
  std::size_t greatest = 0;
  for (const auto& [state, id] : witness.number_of) {
    const auto path = search.path_to(id);
    CHECK(is_path(graph, path));
    REQUIRE(reached.contains(state));
    CHECK(path.back().state == StateVector{state});
    CHECK(path.size() - 1 >= reached.at(state));
    if (is_shortest) CHECK(path.size() - 1 == reached.at(state));
    greatest = std::max(greatest, reached.at(state));
  }
  if (is_shortest) CHECK(result.progress.depth == greatest);
}

TEST_CASE("both searches find every state of random graphs, and paths") {
  std::mt19937 random(4);
  const Limits limits;
  for (int round = 0; round < 500; ++round) {
    CAPTURE(round);
    const Graph graph = toy::random_graph(random);
    check_search(graph, BreadthFirst(graph, limits), true);
    check_search(graph, DepthFirst(graph, limits), false);
  }
}

// 0 → 1 → 2 → … → 9 → 0, and shortcuts 0 → 5, 2 → 8.
Graph circle_with_shortcuts() {
  Graph graph(10);
  for (std::size_t i = 0; i < 10; ++i) graph.add(i, (i + 1) % 10, {7, 0, true});
  graph.add(0, 5, {1, 0, true});
  graph.add(2, 8, {2, 0, true});
  graph.add_initial(0);
  return graph;
}

TEST_CASE("the path that breadth-first search tells is a shortest one") {
  const Graph graph = circle_with_shortcuts();
  const Limits limits;
  BreadthFirst search(graph, limits);
  Witness witness;
  search.run(witness);
  const auto path = search.path_to(witness.number_of.at(8));
  REQUIRE(path.size() == 4);
  CHECK(path[1].state == StateVector{1});
  CHECK(path[2].state == StateVector{2});
  CHECK(path[3].step == Step{2, 0, true});
  CHECK(search.path_to(witness.number_of.at(0)).size() == 1);
}

TEST_CASE("a visitor that has seen enough ends the search") {
  const Graph graph = circle_with_shortcuts();
  const Limits limits;
  const auto check = [&](auto search) {
    Witness witness;
    witness.stop_at = 5;
    const ReachabilityResult result = search.run(witness);
    CHECK(!result.is_complete);
    CHECK(result.stopped == StopReason::None);
    CHECK(witness.number_of.contains(5));
    CHECK(result.progress.expanded == witness.number_of.size());
    CHECK(search.path_to(witness.number_of.at(5)).back().state ==
          StateVector{5});
  };
  check(BreadthFirst(graph, limits));
  check(DepthFirst(graph, limits));
}

TEST_CASE("a state that enough was seen in at the very end is not complete") {
  Graph graph(1);
  graph.add_initial(0);
  const Limits limits;
  Witness witness;
  witness.stop_at = 0;
  const auto breadth = BreadthFirst(graph, limits).run(witness);
  CHECK(breadth.progress.expanded == 1);
  CHECK(witness.dead == std::set<Word>{0});
}

TEST_CASE("several initial states are all searched, each once") {
  Graph graph(4);
  graph.add(1, 3);
  graph.add_initial(0);
  graph.add_initial(1);
  graph.add_initial(1);
  const Limits limits;
  const auto check = [&](auto search) {
    Witness witness;
    const ReachabilityResult result = search.run(witness);
    CHECK(result.is_complete);
    CHECK(result.progress.states == 3);
    CHECK(search.path_to(witness.number_of.at(3)).size() == 2);
    CHECK(search.path_to(witness.number_of.at(1)).size() == 1);
  };
  check(BreadthFirst(graph, limits));
  check(DepthFirst(graph, limits));
}

// A line long enough for the limits to be asked several times.
Graph line_of(std::size_t states) {
  Graph graph(states);
  for (std::size_t i = 0; i + 1 < states; ++i) graph.add(i, i + 1);
  graph.add_initial(0);
  return graph;
}

class CountingMonitor : public SearchMonitor {
 public:
  explicit CountingMonitor(int stop_after) : stop_after_(stop_after) {}
  StopReason observe(const SearchProgress& progress) override {
    CHECK(progress.expanded >= asked * kPollInterval);
    CHECK(progress.states >= progress.expanded);
    CHECK(progress.bytes > 0);
    return static_cast<int>(++asked) > stop_after_ ? StopReason::Timeout
                                                   : StopReason::None;
  }
  std::uint64_t asked = 0;

 private:
  int stop_after_;
};

template <class Make>
void check_limits(const Graph& graph, Make make) {
  const auto stops = [&](const Limits& limits, std::size_t own_bytes) {
    Witness witness;
    witness.own_bytes = own_bytes;
    const ReachabilityResult result = make(limits).run(witness);
    CHECK(result.is_complete == (result.stopped == StopReason::None));
    CHECK(result.progress.expanded == witness.number_of.size());
    return result;
  };
  CHECK(stops({}, 0).progress.states == graph.size());
  const auto few = stops({.max_states = 100}, 0);
  CHECK(few.stopped == StopReason::MaxStates);
  CHECK(few.progress.states >= 100);
  CHECK(few.progress.states <= 100 + kPollInterval);
  CHECK(stops({.max_states = 1}, 0).progress.expanded == 0);
  CHECK(stops({.max_bytes = 1}, 0).stopped == StopReason::Memory);
  CHECK(stops({.max_bytes = 1 << 30}, 0).stopped == StopReason::None);
  CHECK(stops({.max_bytes = 1 << 30}, 1u << 30).stopped == StopReason::Memory);
  CountingMonitor patient(99);
  CHECK(stops({.monitor = &patient}, 0).is_complete);
  CHECK(patient.asked == 5);
  CountingMonitor brief(2);
  const auto late = stops({.monitor = &brief}, 0);
  CHECK(late.stopped == StopReason::Timeout);
  CHECK(late.progress.expanded >= 2 * kPollInterval);
  CHECK(late.progress.expanded < 3 * kPollInterval);
}

TEST_CASE("a search that reaches a limit stops, and says that it did") {
  const Graph graph = line_of(5000);
  check_limits(
      graph, [&](const Limits& limits) { return BreadthFirst(graph, limits); });
  check_limits(graph,
               [&](const Limits& limits) { return DepthFirst(graph, limits); });
}

TEST_CASE("a limit that is not reached leaves the search complete") {
  const Graph graph = line_of(3);
  const Limits limits{.max_states = 4};
  Witness witness;
  CHECK(BreadthFirst(graph, limits).run(witness).is_complete);
}

TEST_CASE("depth-first search goes down the first branch it takes") {
  Graph graph(6);
  for (const auto& [from, to] :
       {std::pair(0, 1), {0, 2}, {1, 3}, {2, 4}, {4, 5}}) {
    graph.add(static_cast<std::size_t>(from), static_cast<std::size_t>(to));
  }
  graph.add_initial(0);
  const Limits limits;
  Witness witness;
  DepthFirst search(graph, limits);
  const ReachabilityResult result = search.run(witness);
  CHECK(result.is_complete);
  CHECK(result.progress.depth == 3);
}

}  // namespace
}  // namespace btcheck::search_test
