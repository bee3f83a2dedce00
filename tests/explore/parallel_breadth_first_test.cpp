// SPDX-License-Identifier: MIT
//
// The parallel search on a network large enough that threads meet.
#include "explore/large/parallel_breadth_first.hpp"

#include <doctest/doctest.h>

#include "explore/halves/split_network.hpp"
#include "explore/large/markings.hpp"
#include "explore/large/state_questions.hpp"
#include "explore/reduce/reduced_network.hpp"
#include "explore/search/reachability.hpp"
#include "wheels.hpp"

namespace btcheck::parallel_breadth_first_test {
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

// What a search tells, in its order: single steps, and what it stores.
struct Recorder : public ReachabilityVisitor {
  bool is_heard(Step step) const { return step.edge % 3 != 0; }
  void passed(StateId from, StateView before, Step step) {
    if (!is_heard(step)) return;
    for (const Word word : {Word{index(from)}, before[0], Word{step.edge}}) {
      note(word, heard);
    }
  }
  void stepped(StateId from, Step step, StateId to) {
    for (const std::uint32_t word : {index(from), step.edge, index(to)}) {
      note(word, told);
    }
  }
  GoOn expanded(StateId id, StateView state, bool is_dead) {
    note(index(id), told);
    note(state[0], told);
    note(static_cast<Word>(is_dead), told);
    return index(id) == last ? GoOn::No : GoOn::Yes;
  }
  static void note(Word word, Word& onto) {
    onto = (onto ^ word) * 0x9E3779B97F4A7C15u;
  }

  std::uint32_t last = UINT32_MAX;
  Word heard = 0;
  Word told = 0;
};

TEST_CASE("threads that compute successors change nothing") {
  const Network network = wheels(5, 8);
  const CompiledNetwork compiled(network);
  const ReducedNetwork system(compiled);
  const Limits limits;
  for (const std::uint32_t last : {UINT32_MAX, 20'000u}) {
    std::vector<Recorder> recorders(3);
    std::vector<std::size_t> steps;
    for (std::size_t i = 0; i < 3; ++i) {
      recorders[i].last = last;
      BreadthFirst search(system, limits, 1u << i);
      const ReachabilityResult found = search.run(recorders[i]);
      CHECK(found.is_complete == (last == UINT32_MAX));
      steps.push_back(search.path_to(StateId{20'000}).size());
    }
    for (const Recorder& recorder : recorders) {
      CHECK(recorder.told == recorders[0].told);
      // Beyond the last state, the rest of a batch has been heard.
      if (last == UINT32_MAX) CHECK(recorder.heard == recorders[0].heard);
    }
    CHECK(steps == std::vector<std::size_t>(3, steps[0]));
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
}  // namespace btcheck::parallel_breadth_first_test
