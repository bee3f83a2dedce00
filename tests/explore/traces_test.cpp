// SPDX-License-Identifier: MIT
//
// Two states that somebody can tell apart: by a run, or by a play.
#include "explore/minimise/traces.hpp"

#include <doctest/doctest.h>

#include <initializer_list>
#include <random>
#include <vector>

#include "explore/minimise/partition.hpp"
#include "explore/minimise/play.hpp"

namespace btcheck::traces_test {
namespace {

using Arc = LabelledGraph::Arc;
using Labels = std::vector<std::uint32_t>;
constexpr std::uint32_t kA = 1;
constexpr std::uint32_t kB = 2;
constexpr std::uint32_t kC = 3;
constexpr std::uint32_t kSilent = LabelledGraph::kSilent;

LabelledGraph graph_of(std::initializer_list<std::vector<Arc>> states) {
  LabelledGraph graph;
  for (const std::vector<Arc>& arcs : states) graph.add_state(arcs);
  return graph;
}

}  // namespace

TEST_CASE("a shortest run that one has alone") {
  // 0: a then b, or c; 3: a then nothing, or c.
  const auto graph =
      graph_of({{{kA, 1}, {kC, 2}}, {{kB, 2}}, {}, {{kA, 2}, {kC, 2}}});
  const auto found = compare_traces(graph, 0, 3);
  REQUIRE(found.difference);
  CHECK(found.difference->labels == Labels{kA, kB});
  CHECK(found.difference->end == TraceEnd::Seen);
  CHECK(found.difference->is_of_first);
  CHECK(found.difference->instead.empty());
  CHECK(found.difference->other_stops);
  const auto turned = compare_traces(graph, 3, 0);
  REQUIRE(turned.difference);
  CHECK(turned.difference->labels == Labels{kA, kB});
  CHECK(!turned.difference->is_of_first);
}

TEST_CASE("a run may differ by how it ends") {
  // 0: a for ever; 1: the same, or a silent step to the end.
  const auto stops = graph_of({{{kA, 0}}, {{kA, 1}, {kSilent, 2}}, {}});
  const auto found = compare_traces(stops, 0, 1);
  REQUIRE(found.difference);
  CHECK(found.difference->labels.empty());
  CHECK(found.difference->end == TraceEnd::Stops);
  CHECK(!found.difference->is_of_first);
  CHECK(found.difference->instead == Labels{kA});
  // And 1 may go on unseen for ever.
  const auto unseen = graph_of({{{kA, 0}}, {{kA, 1}, {kSilent, 1}}});
  const auto other = compare_traces(unseen, 0, 1);
  REQUIRE(other.difference);
  CHECK(other.difference->end == TraceEnd::Unseen);
  CHECK(!other.difference->is_of_first);
}

TEST_CASE("the same runs with choices at other times") {
  // 0: a, then b or c; 2: a then b, or a then c.
  const auto graph = graph_of({{{kA, 1}},
                               {{kB, 5}, {kC, 5}},
                               {{kA, 3}, {kA, 4}},
                               {{kB, 5}},
                               {{kC, 5}},
                               {}});
  CHECK(!compare_traces(graph, 0, 2).difference);
  CHECK(compare_traces(graph, 0, 2).is_known);
  const auto play = distinguishing_play(graph, 0, 2);
  REQUIRE(play.size() == 2);
  CHECK(play[0].kind == PlayRound::Kind::Moves);
  CHECK(play[0].label == kA);
  CHECK(play[1].kind == PlayRound::Kind::Wins);
  CHECK((play[1].label == kB || play[1].label == kC));
}

TEST_CASE("a choice that is not seen is a round of its own") {
  // 0: b or c; 1: it is settled first.
  const auto graph = graph_of({{{kB, 4}, {kC, 4}},
                               {{kSilent, 2}, {kSilent, 3}},
                               {{kB, 4}},
                               {{kC, 4}},
                               {}});
  CHECK(!compare_traces(graph, 0, 1).difference);
  const auto play = distinguishing_play(graph, 0, 1);
  REQUIRE(play.size() == 2);
  CHECK((play[0].kind == PlayRound::Kind::Settles ||
         play[0].kind == PlayRound::Kind::Yields));
  CHECK(!play[0].is_of_first);
  CHECK(play[1].kind == PlayRound::Kind::Wins);
  CHECK(play[1].is_of_first);
}

TEST_CASE("too many sets of states are said to be too many") {
  const auto graph = graph_of({{{kA, 1}}, {{kA, 2}}, {{kA, 0}}});
  CHECK(compare_traces(graph, 0, 0).is_known);
  const auto cut = compare_traces(graph, 0, 1, 1);
  CHECK(!cut.is_known);
  CHECK(!cut.difference);
  CHECK(compare_traces(graph, 0, 1).is_known);
}

TEST_CASE("random states are told apart by a run or by a play, or not at all") {
  std::mt19937 random(7);
  int runs = 0;
  int plays = 0;
  for (int i = 0; i < 3000; ++i) {
    LabelledGraph graph;
    for (int s = 0; s < 12; ++s) {
      std::vector<Arc> arcs;
      for (auto n = random() % 4; n > 0; --n) {
        arcs.push_back({static_cast<std::uint32_t>(random() % 4),
                        static_cast<std::uint32_t>(random() % 12)});
      }
      graph.add_state(arcs);
    }
    const Partition partition =
        coarsest_partition(graph, Equivalence::Branching);
    const LabelledGraph small =
        quotient(graph, partition, Equivalence::Branching);
    if (small.size() < 2) continue;
    const auto found = compare_traces(small, 0, 1);
    REQUIRE(found.is_known);
    const auto play = distinguishing_play(small, 0, 1);
    REQUIRE(!play.empty());
    const auto last = play.back().kind;
    REQUIRE((last == PlayRound::Kind::Wins || last == PlayRound::Kind::Stays));
    (found.difference ? runs : plays) += 1;
  }
  CHECK(runs > 500);
  CHECK(plays > 5);
}

}  // namespace btcheck::traces_test
