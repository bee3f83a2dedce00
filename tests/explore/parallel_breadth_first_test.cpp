// SPDX-License-Identifier: MIT
//
// The parallel search on a network large enough that threads meet.
#include "explore/large/parallel_breadth_first.hpp"

#include <doctest/doctest.h>

#include "explore/halves/split_network.hpp"
#include "explore/large/markings.hpp"
#include "explore/large/state_questions.hpp"
#include "explore/search/reachability.hpp"
#include "wheels.hpp"

namespace btcheck {
namespace {

struct Counted {
  ParallelResult result;
  std::uint64_t markings = 0;
  std::uint64_t dead = 0;
};

template <class Set>
Counted count(const CompiledNetwork& system, const Limits& limits,
              unsigned threads) {
  SplitNetwork split(system);
  PairMarkings<SplitNetwork, Set> markings(split);
  ParallelBreadthFirst<SplitNetwork, Set> search(split, limits, threads);
  Counted counted;
  counted.result = search.run(markings);
  counted.markings =
      markings.count([&](Word pair) { return search.is_visited(pair); });
  counted.dead = markings.dead();
  return counted;
}

TEST_CASE_TEMPLATE("every number of threads counts the same", Set, ExactPairSet,
                   CompressedPairSet) {
  const Network network = wheels(5, 8);
  const CompiledNetwork system(network);
  const Limits limits;
  ReachabilityVisitor nothing;
  const ReachabilityResult expected = BreadthFirst(system, limits).run(nothing);
  for (const unsigned threads : {1u, 2u, 4u}) {
    const Counted counted = count<Set>(system, limits, threads);
    const ReachabilityResult& found = counted.result.reachability;
    CHECK(found.is_complete);
    CHECK(found.progress.states == expected.progress.states);
    CHECK(found.progress.expanded == expected.progress.expanded);
    CHECK(found.progress.transitions == expected.progress.transitions);
    CHECK(found.progress.depth == expected.progress.depth);
    CHECK(counted.markings == expected.progress.states);  // no clocks
    CHECK(counted.dead == 0);
    CHECK(counted.result.largest_frontier > 1000);
  }
}

TEST_CASE("a question is answered by the same state on the same path") {
  const Network network = wheels(4, 8);
  const CompiledNetwork system(network);
  const Limits limits;
  // The second and the third wheel have turned as far as four together.
  const auto is_there = [&](std::size_t question, StateView state, bool) {
    const auto at = [&](std::uint32_t wheel) {
      return system.value(state, network.automata[wheel].location);
    };
    return question == 0 ? at(1) + at(2) == 4 : at(3) == 3;
  };
  std::vector<StateVector> first;
  for (const unsigned threads : {1u, 2u, 4u}) {
    SplitNetwork split(system);
    StateQuestions questions(split, 2, is_there);
    ParallelBreadthFirst<SplitNetwork, CompressedPairSet> search(
        split, limits, threads, KeepDepths::Yes);
    const ParallelResult result = search.run(questions);
    CHECK(!result.reachability.is_complete);
    const auto& answers = questions.answers();
    REQUIRE(answers[0]);
    REQUIRE(answers[1]);
    CHECK(answers[0]->depth == 4);
    CHECK(answers[1]->depth == 5);  // and the first wheel ahead of the last
    std::vector<StateVector> told;
    for (const auto& answer : answers) {
      for (const Word pair : search.path_to(answer->pair, answer->depth)) {
        split.load(pair, told.emplace_back(split.word_count()).data());
      }
    }
    CHECK(told.size() == 5 + 6);
    if (first.empty()) first = told;
    CHECK(told == first);
  }
}

TEST_CASE_TEMPLATE("limits end the search and are kept", Set, ExactPairSet,
                   CompressedPairSet) {
  const Network network = wheels(6, 8);
  const CompiledNetwork system(network);
  for (const unsigned threads : {1u, 4u}) {
    const Counted few =
        count<Set>(system, {10'000, UINT64_MAX, nullptr}, threads);
    CHECK(few.result.reachability.stopped == StopReason::MaxStates);
    CHECK(!few.result.reachability.is_complete);
    CHECK(few.result.reachability.progress.states >= 10'000);
    CHECK(few.result.reachability.progress.states < 40'000);

    const std::size_t most = std::size_t{2} << 20;
    const Counted small =
        count<Set>(system, {UINT64_MAX, most, nullptr}, threads);
    CHECK(small.result.reachability.stopped == StopReason::Memory);
    CHECK(small.result.reachability.progress.states > 10'000);
  }
}

}  // namespace
}  // namespace btcheck
