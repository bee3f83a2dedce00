// SPDX-License-Identifier: MIT
//
// The parallel search against the sequential one, on random trees under every
// tick semantics: the same successors of every state, wherever the vector is
// cut, the same figures with any number of threads and in both stores, the
// same answers to questions about states. The same on disk.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "check/space/space.hpp"
#include "explore/halves/cut.hpp"
#include "explore/halves/interned_system.hpp"
#include "explore/halves/split_network.hpp"
#include "explore/large/disk_breadth_first.hpp"
#include "explore/large/markings.hpp"
#include "explore/large/parallel_breadth_first.hpp"
#include "explore/large/state_questions.hpp"
#include "explore/search/reachability.hpp"
#include "explore/tiny_scratch.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::parallel_cross_check_test {
namespace {

constexpr TickSemantics kTicks[] = {TickSemantics::Root, TickSemantics::Leaves,
                                    TickSemantics::Nodes, TickSemantics::None};
constexpr std::uint64_t kMostStates = 20'000;

// Calls check(network, seed) for random trees, one tick semantics after the
// other.
template <class Check>
void for_random_networks(unsigned own_seed, int rounds, Check&& check) {
  const std::uint64_t first = shifted_seed(own_seed) * 100'000;
  RandomTreeWeights weights;
  weights.duration = 50;  // timers are rare otherwise
  weights.max_nodes = 8;
  weights.timed_moves = 50;
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(round);
    const auto read = read_btf("random.btf", random_tree(seed, weights));
    if (!read.value) continue;
    CAPTURE(seed);
    check(lower(*read.value, kTicks[round % 4]), seed);
  }
}

// A sequential search that keeps every state and what is known of it.
struct Naive {
  explicit Naive(const CompiledNetwork& system)
      : search(system, limits()), seen(search.run(visitor)) {}

  static const Limits& limits() {
    static const Limits limits{kMostStates, UINT64_MAX, nullptr};
    return limits;
  }

  struct Visitor : ReachabilityVisitor {
    GoOn expanded(StateId, StateView state, bool is_dead) {
      states.emplace_back(state.begin(), state.end());
      if (is_dead) dead.insert(states.back());
      return GoOn::Yes;
    }
    std::vector<StateVector> states;
    std::set<StateVector> dead;
  };

  Visitor visitor;
  BreadthFirst<CompiledNetwork> search;
  ReachabilityResult seen;
};

using Vectors = std::vector<StateVector>;

Vectors sorted(Vectors vectors) {
  std::sort(vectors.begin(), vectors.end());
  return vectors;
}

Vectors successors_of(const CompiledNetwork& system, const StateVector& state) {
  Vectors found;
  system.successors(state, [&](StateView target, Step step) {
    StateVector vector(target.begin(), target.end());
    if (step.edge != kTimeStep || vector != state) found.push_back(vector);
  });
  return sorted(std::move(found));
}

template <class System>
StateVector vector_of(const System& system, Word pair) {
  StateVector vector(system.word_count());
  system.load(pair, vector.data());
  return vector;
}

// Walks all states of the system and compares their successors.
template <class System>
std::uint64_t compare_successors(System& system,
                                 const CompiledNetwork& expected) {
  typename System::Worker worker(system);
  std::set<Word> seen;
  std::vector<Word> open;
  const auto reach = [&](Word pair) {
    if (seen.insert(pair).second) open.push_back(pair);
  };
  system.initial_states(worker, reach);
  while (!open.empty() && seen.size() < kMostStates) {
    const Word pair = open.back();
    open.pop_back();
    Vectors found;
    system.successors(pair, worker, [&](Word target) {
      found.push_back(vector_of(system, target));
      reach(target);
    });
    StateVector state = vector_of(system, pair);
    REQUIRE(sorted(std::move(found)) == successors_of(expected, state));
    expected.clear_clocks(state);
    REQUIRE(vector_of(system, system.without_clocks(pair, worker)) == state);
  }
  return seen.size();
}

}  // namespace

TEST_CASE("successors by halves are the successors, wherever the cut is") {
  std::uint64_t states = 0;
  int trees = 0;
  for_random_networks(
      31, by_effort(150, 3000),
      [&](const Network& network, std::uint64_t seed) {
        const std::size_t groups = network.automata.size() + 1;
        const std::size_t cut =
            seed % 3 == 0 ? best_cut(CompiledNetwork(network))
                          : static_cast<std::size_t>(seed / 3) % (groups + 1);
        CAPTURE(cut);
        const CompiledNetwork system(network, StateLayout(network, cut));
        SplitNetwork split(system);
        states += compare_successors(split, system);
        InternedSystem interned(system, system);
        compare_successors(interned, system);
        ++trees;
      });
  MESSAGE(trees, " trees, ", states, " states expanded by halves");
  CHECK_COVERED(states > 10'000);
}

namespace {

void check_progress(const ReachabilityResult& found, const Naive& naive) {
  REQUIRE(found.is_complete);
  CHECK(found.progress.states == naive.seen.progress.states);
  CHECK(found.progress.expanded == naive.seen.progress.expanded);
  CHECK(found.progress.transitions == naive.seen.progress.transitions);
  CHECK(found.progress.depth == naive.seen.progress.depth);
}

void compare_on_disk(const CompiledNetwork& system, const Naive& naive,
                     const SpaceReport& expected, unsigned threads) {
  const Limits limits;
  const Scratch scratch = tiny_scratch();
  SplitNetwork split(system);
  DiskMarkings<SplitNetwork> markings(split, scratch, 64);
  DiskBreadthFirst<SplitNetwork> search(split, limits, threads, scratch);
  check_progress(search.run(markings).reachability, naive);
  CHECK(markings.count(search.visited()) == expected.markings);
  CHECK(markings.dead() == naive.visitor.dead.size());
}

}  // namespace

TEST_CASE("a parallel search counts what the sequential ones count") {
  int trees = 0;
  for_random_networks(
      32, by_effort(80, 1500), [&](const Network& network, std::uint64_t) {
        const Limits limits;
        const CompiledNetwork system(network);
        const Naive naive(system);
        if (!naive.seen.is_complete) return;
        const SpaceReport expected =
            measure_space(network, {SearchOrder::DepthFirst}, limits);
        REQUIRE(expected.result.progress.states == naive.seen.progress.states);
        for (const unsigned threads : {1u, 2u, 4u}) {
          for (const StateSetKind store :
               {StateSetKind::Exact, StateSetKind::Compressed}) {
            const SpaceReport found = measure_space(
                network,
                {SearchOrder::BreadthFirst, Reduction::None, store, threads},
                limits);
            check_progress(found.result, naive);
            CHECK(found.markings == expected.markings);
            CHECK(found.dead_states == expected.dead_states);
            CHECK(found.dead_states == naive.visitor.dead.size());
          }
          compare_on_disk(system, naive, expected, threads);
        }
        ++trees;
      });
  MESSAGE(trees, " trees counted by up to four threads, also on disk");
  CHECK_COVERED(trees > 20);
}

namespace {

// The least dead state of the first depth that has one, and a path there.
template <class Search>
void compare_dead_states(SplitNetwork& split, const Naive& naive,
                         Search&& search, Vectors& first_path) {
  StateQuestions questions(
      split, 1, [](std::size_t, StateView, bool is_dead) { return is_dead; });
  search.run(questions);
  const auto& answer = questions.answers()[0];
  REQUIRE(answer.has_value() == !naive.visitor.dead.empty());
  if (!answer) return;
  CHECK(naive.visitor.dead.count(answer->words) == 1);
  Vectors path;
  for (const Word pair : search.path_to(answer->pair, answer->depth)) {
    path.push_back(vector_of(split, pair));
  }
  REQUIRE(path.back() == answer->words);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vectors next = successors_of(split.system(), path[i]);
    REQUIRE(std::binary_search(next.begin(), next.end(), path[i + 1]));
  }
  // As long as the sequential search's, which is a shortest one.
  for (std::size_t s = 0; s < naive.visitor.states.size(); ++s) {
    if (naive.visitor.dead.count(naive.visitor.states[s]) == 0) continue;
    const StateId id{static_cast<std::uint32_t>(s)};
    REQUIRE(naive.search.path_to(id).size() == path.size());
    break;
  }
  if (first_path.empty()) first_path = path;
  CHECK(path == first_path);
}

}  // namespace

TEST_CASE("the same state and path answer a question with any threads") {
  const Limits limits;
  const Scratch scratch = tiny_scratch();
  int answered = 0;
  for_random_networks(
      33, by_effort(80, 1500), [&](const Network& network, std::uint64_t) {
        const CompiledNetwork system(network);
        const Naive naive(system);
        if (!naive.seen.is_complete) return;
        Vectors path;
        for (const unsigned threads : {1u, 2u, 4u}) {
          SplitNetwork split(system);
          compare_dead_states(split, naive,
                              ParallelBreadthFirst<SplitNetwork, ExactPairSet>(
                                  split, limits, threads, KeepDepths::Yes),
                              path);
          compare_dead_states(
              split, naive,
              ParallelBreadthFirst<SplitNetwork, CompressedPairSet>(
                  split, limits, threads, KeepDepths::Yes),
              path);
          compare_dead_states(
              split, naive,
              DiskBreadthFirst<SplitNetwork>(split, limits, threads, scratch,
                                             KeepDepths::Yes),
              path);
        }
        answered += !path.empty();
      });
  MESSAGE(answered, " trees with a dead state, found by any threads");
  CHECK_COVERED(answered > 10);
}

}  // namespace btcheck::reference::parallel_cross_check_test
