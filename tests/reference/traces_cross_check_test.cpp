// SPDX-License-Identifier: MIT
//
// Shortest differences of two states against all short runs, written out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "explore/minimise/partition.hpp"
#include "explore/minimise/traces.hpp"
#include "reference/effort.hpp"
#include "reference/naive_bisimulation.hpp"

namespace btcheck::reference::traces_cross_check_test {
namespace {

constexpr std::size_t kLongest = 5;

using Run = std::pair<std::vector<std::uint32_t>, TraceEnd>;

// To see that nothing follows takes a look as well.
std::size_t length(const Run& run) {
  return run.first.size() + (run.second == TraceEnd::Seen ? 0 : 1);
}

// A state silently reaches one that it silently comes back to.
bool goes_on_silently(const LabelledGraph& graph, std::uint32_t from) {
  // More silent steps in a row than there are states repeat one.
  std::set<std::uint32_t> here = {from};
  for (std::size_t i = 0; i <= graph.size(); ++i) {
    std::set<std::uint32_t> next;
    for (const std::uint32_t s : here) {
      for (const LabelledGraph::Arc& arc : graph.arcs(s)) {
        if (arc.label == LabelledGraph::kSilent) next.insert(arc.target);
      }
    }
    here = std::move(next);
  }
  return !here.empty();
}

// Every run of at most kLongest labels, step by step.
std::set<Run> short_runs(const LabelledGraph& graph, std::uint32_t start) {
  std::set<Run> runs;
  using Place = std::pair<std::uint32_t, std::vector<std::uint32_t>>;
  std::set<Place> seen = {{start, {}}};
  std::vector<Place> open(seen.begin(), seen.end());
  while (!open.empty()) {
    const auto [state, labels] = open.back();
    open.pop_back();
    if (!labels.empty()) runs.emplace(labels, TraceEnd::Seen);
    if (graph.arcs(state).empty()) runs.emplace(labels, TraceEnd::Stops);
    if (goes_on_silently(graph, state)) runs.emplace(labels, TraceEnd::Unseen);
    for (const LabelledGraph::Arc& arc : graph.arcs(state)) {
      Place next{arc.target, labels};
      if (arc.label != LabelledGraph::kSilent) next.second.push_back(arc.label);
      if (next.second.size() > kLongest) continue;
      if (seen.insert(next).second) open.push_back(next);
    }
  }
  return runs;
}

}  // namespace

TEST_CASE("no run that tells two states apart is shorter than what is found") {
  std::mt19937 random(shifted_seed(61));
  int different = 0;
  int by_step = 0;
  int by_stop = 0;
  int by_silence = 0;
  int same = 0;
  const int graphs = by_effort(400, 10'000);
  for (int i = 0; i < graphs; ++i) {
    CAPTURE(i);
    const LabelledGraph drawn = random_graph(random, 9);
    const LabelledGraph graph =
        quotient(drawn, coarsest_partition(drawn, Equivalence::Branching),
                 Equivalence::Branching);
    const auto states = static_cast<std::uint32_t>(graph.size());
    const auto first = static_cast<std::uint32_t>(random() % states);
    const auto second = static_cast<std::uint32_t>(random() % states);
    const auto of_first = short_runs(graph, first);
    const auto of_second = short_runs(graph, second);
    std::set<Run> apart;
    std::ranges::set_symmetric_difference(of_first, of_second,
                                          std::inserter(apart, apart.end()));
    std::size_t shortest = kLongest + 1;
    for (const Run& run : apart) shortest = std::min(shortest, length(run));
    const TraceComparison compared = compare_traces(graph, first, second);
    REQUIRE(compared.is_known);
    if (!compared.difference || compared.difference->labels.size() > kLongest) {
      REQUIRE(apart.empty());
      same += first != second;
      continue;
    }
    const TraceDifference& found = *compared.difference;
    const Run run{found.labels, found.end};
    REQUIRE(length(run) == shortest);
    REQUIRE(of_first.contains(run) == found.is_of_first);
    REQUIRE(of_second.contains(run) == !found.is_of_first);
    ++different;
    by_step += found.end == TraceEnd::Seen;
    by_stop += found.end == TraceEnd::Stops;
    by_silence += found.end == TraceEnd::Unseen;
  }
  CHECK_COVERED(different > graphs / 4);
  CHECK_COVERED(by_step > 10);
  CHECK_COVERED(by_stop > 10);
  CHECK_COVERED(by_silence > 3);
  CHECK_COVERED(same > 3);
}

}  // namespace btcheck::reference::traces_cross_check_test
