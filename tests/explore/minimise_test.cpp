// SPDX-License-Identifier: MIT
//
// By hand; random graphs are in tests/reference/minimise_cross_check_test.cpp.
#include <doctest/doctest.h>

#include <vector>

#include "explore/minimise/partition.hpp"

namespace btcheck::minimise_test {
namespace {

using Arc = LabelledGraph::Arc;

LabelledGraph graph_of(const std::vector<std::vector<Arc>>& arcs) {
  LabelledGraph graph;
  for (const auto& each : arcs) graph.add_state(each);
  return graph;
}

}  // namespace

TEST_CASE("a silent step that changes nothing is not seen") {
  const LabelledGraph graph = graph_of({{{0, 1}}, {{1, 2}}, {}});
  CHECK(coarsest_partition(graph, Equivalence::Branching) ==
        Partition{{0, 0, 1}, 2});
  CHECK(coarsest_partition(graph, Equivalence::Strong) ==
        Partition{{0, 1, 2}, 3});
}

TEST_CASE("a choice made early is not the same choice made late") {
  // 0 decides silently between 1 and 2, 3 decides with its step.
  const LabelledGraph graph =
      graph_of({{{0, 1}, {0, 2}}, {{1, 4}}, {{2, 4}}, {{1, 4}, {2, 4}}, {}});
  const Partition blocks = coarsest_partition(graph, Equivalence::Branching);
  CHECK(blocks.block[0] != blocks.block[3]);
  CHECK(blocks.blocks == 5);
}

TEST_CASE("going on for ever is not the same as stopping") {
  const LabelledGraph graph = graph_of({{{0, 0}}, {}, {{0, 3}}, {{0, 2}}});
  const Partition blocks = coarsest_partition(graph, Equivalence::Branching);
  CHECK(blocks == Partition{{0, 1, 0, 0}, 2});
  CHECK(quotient(graph, blocks, Equivalence::Branching) ==
        graph_of({{{0, 0}}, {}}));
}

}  // namespace btcheck::minimise_test
