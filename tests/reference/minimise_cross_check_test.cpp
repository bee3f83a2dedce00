// SPDX-License-Identifier: MIT
//
// The blocks that are found with the smaller half in hand, against those that
// are found by signatures and those of the definition; and what must be true of
// every quotient.
#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "reference/effort.hpp"
#include "reference/naive_bisimulation.hpp"
#include "reference/reduction_cases.hpp"
#include "text/budget.hpp"

namespace btcheck::reference::minimise_cross_check_test {
namespace {

constexpr Equivalence kBoth[] = {Equivalence::Strong, Equivalence::Branching};

// What must be true of the quotient, however it was found.
void check_quotient(const LabelledGraph& graph, const Partition& partition,
                    Equivalence equivalence) {
  const LabelledGraph small = quotient(graph, partition, equivalence);
  REQUIRE(small.size() == partition.blocks);
  const Partition again = coarsest_partition(small, equivalence);
  REQUIRE(again.blocks == small.size());
  REQUIRE(quotient(small, again, equivalence) == small);
  const Partition both = coarsest_partition(beside(graph, small), equivalence);
  REQUIRE(both.blocks == partition.blocks);
  for (std::size_t s = 0; s < graph.size(); ++s) {
    REQUIRE(both.block[s] == both.block[graph.size() + partition.block[s]]);
  }
}

bool has_inert_step(const LabelledGraph& graph, const Partition& partition) {
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    for (const LabelledGraph::Arc& arc : graph.arcs(s)) {
      if (arc.label == LabelledGraph::kSilent && arc.target != s &&
          partition.block[arc.target] == partition.block[s]) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

TEST_CASE("random graphs have the blocks that signatures give") {
  std::mt19937 random(shifted_seed(41));
  int reduced = 0;
  int inert = 0;
  int told_apart = 0;
  const int graphs = by_effort(2000, 100'000);
  for (int i = 0; i < graphs; ++i) {
    CAPTURE(i);
    const LabelledGraph graph = random_graph(random, 60);
    std::uint32_t blocks[2] = {};
    for (const Equivalence equivalence : kBoth) {
      const Partition partition = coarsest_partition(graph, equivalence);
      REQUIRE(partition == signature_partition(graph, equivalence));
      check_quotient(graph, partition, equivalence);
      blocks[static_cast<int>(equivalence)] = partition.blocks;
      if (equivalence == Equivalence::Branching) {
        reduced += partition.blocks > 1 && partition.blocks < graph.size();
        inert += partition.blocks > 1 && has_inert_step(graph, partition);
      }
    }
    told_apart += blocks[1] < blocks[0];
  }
  CHECK_COVERED(reduced > graphs / 2);
  CHECK_COVERED(inert > graphs / 4);
  CHECK_COVERED(told_apart > graphs / 4);
}

TEST_CASE("small graphs have the blocks of the definition") {
  std::mt19937 random(shifted_seed(42));
  int of_several = 0;
  const int graphs = by_effort(300, 5'000);
  for (int i = 0; i < graphs; ++i) {
    CAPTURE(i);
    const LabelledGraph graph = random_graph(random, 6);
    for (const Equivalence equivalence : kBoth) {
      const Partition partition = coarsest_partition(graph, equivalence);
      REQUIRE(partition == greatest_bisimulation(graph, equivalence));
      of_several += partition.blocks > 1 && partition.blocks < graph.size();
    }
  }
  CHECK_COVERED(of_several > graphs / 4);
}

TEST_CASE("larger graphs have the blocks that signatures give") {
  std::mt19937 random(shifted_seed(43));
  for (int i = 0; i < by_effort(20, 200); ++i) {
    CAPTURE(i);
    const LabelledGraph graph = random_graph(random, 400);
    for (const Equivalence equivalence : kBoth) {
      const Partition partition = coarsest_partition(graph, equivalence);
      REQUIRE(partition == signature_partition(graph, equivalence));
    }
  }
}

TEST_CASE("state graphs of random trees have the blocks of signatures") {
  int graphs = 0;
  std::mt19937 random(shifted_seed(44));
  for_reduction_cases(45, by_effort(60, 600), [&](const ReductionCase& each) {
    if (each.space.states.size() > 400) return GoOn::Yes;
    // Each edge has a label of its own, or is hidden, at random.
    std::map<std::uint32_t, std::uint32_t> label_of;
    LabelledGraph graph;
    std::vector<LabelledGraph::Arc> arcs;
    for (const std::vector<NaiveSpace::Step>& steps : each.space.steps) {
      arcs.clear();
      for (const NaiveSpace::Step& step : steps) {
        const std::uint32_t edge = step.edge.value_or(0xffffffff);
        const auto known = label_of.find(edge);
        const std::uint32_t label =
            known != label_of.end() ? known->second
                                    : static_cast<std::uint32_t>(
                                          random() % 4 == 0 ? random() % 9 : 0);
        label_of.emplace(edge, label);
        arcs.push_back({label, static_cast<std::uint32_t>(step.target)});
      }
      graph.add_state(arcs);
    }
    ++graphs;
    CAPTURE(each.text);
    for (const Equivalence equivalence : kBoth) {
      const Partition partition = coarsest_partition(graph, equivalence);
      REQUIRE(partition == signature_partition(graph, equivalence));
      check_quotient(graph, partition, equivalence);
    }
    return GoOn::Yes;
  });
  CHECK_COVERED(graphs > 40);
}

TEST_CASE("nothing is left of a budget: minimising says so") {
  class NoTime : public Budget {
   public:
    Spent look() override { return Spent::Time; }
  };
  std::mt19937 random(46);
  const LabelledGraph graph = random_graph(random, 400);
  for (const Equivalence equivalence : kBoth) {
    const Partition partition = coarsest_partition(graph, equivalence);
    NoTime budget;
    const BudgetScope scope(&budget);
    CHECK_THROWS_AS(coarsest_partition(graph, equivalence), BudgetSpent);
    CHECK_THROWS_AS(quotient(graph, partition, equivalence), BudgetSpent);
  }
}

}  // namespace btcheck::reference::minimise_cross_check_test
