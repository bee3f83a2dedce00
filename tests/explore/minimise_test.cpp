// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "explore/minimise/partition.hpp"
#include "explore/state/split_mix.hpp"

namespace btcheck::minimise_test {
namespace {

using Arc = LabelledGraph::Arc;

LabelledGraph graph_of(const std::vector<std::vector<Arc>>& arcs) {
  LabelledGraph graph;
  for (const auto& each : arcs) graph.add_state(each);
  return graph;
}

LabelledGraph random_graph(std::uint64_t seed) {
  SplitMix64 random(seed);
  const std::uint64_t states = 1 + random.below(16);
  const std::uint64_t labels = 1 + random.below(3);
  const std::uint64_t silent = random.below(90);
  std::vector<std::vector<Arc>> arcs(states);
  for (std::uint64_t i = random.below(3 * states); i > 0; --i) {
    const bool is_silent = random.below(100) < silent;
    const auto label = is_silent ? 0 : 1 + random.below(labels);
    arcs[random.below(states)].push_back(
        {static_cast<std::uint32_t>(label),
         static_cast<std::uint32_t>(random.below(states))});
  }
  return graph_of(arcs);
}

// The partition by its definition: what can be done from a state behind silent
// steps within its block, each block looked through anew for each state.
class Naive {
 public:
  Naive(const LabelledGraph& graph, Equivalence equivalence)
      : graph_(graph),
        is_branching_(equivalence == Equivalence::Branching),
        block_(graph.size(), 0) {}

  Partition partition() {
    for (std::size_t before = 0;;) {
      std::map<std::pair<std::uint32_t, std::set<Arc>>, std::uint32_t> known;
      std::vector<std::uint32_t> next;
      for (std::uint32_t s = 0; s < graph_.size(); ++s) {
        next.push_back(
            known
                .try_emplace({block_[s], seen_from(s)},
                             static_cast<std::uint32_t>(known.size()))
                .first->second);
      }
      block_ = std::move(next);
      if (known.size() == before) break;
      before = known.size();
    }
    const auto most = std::ranges::max_element(block_);
    return {block_, block_.empty() ? 0 : *most + 1};
  }

 private:
  bool is_inert(std::uint32_t from, const Arc& arc) const {
    return is_branching_ && arc.label == LabelledGraph::kSilent &&
           block_[arc.target] == block_[from];
  }

  std::vector<std::uint32_t> silently_from(std::uint32_t state) const {
    std::vector<std::uint32_t> way = {state};
    for (std::size_t next = 0; next < way.size(); ++next) {
      for (const Arc& arc : graph_.arcs(way[next])) {
        if (!is_inert(way[next], arc)) continue;
        if (std::ranges::count(way, arc.target) == 0) {
          way.push_back(arc.target);
        }
      }
    }
    return way;
  }

  std::set<Arc> seen_from(std::uint32_t state) const {
    std::set<Arc> seen;
    for (const std::uint32_t at : silently_from(state)) {
      for (const Arc& arc : graph_.arcs(at)) {
        if (!is_inert(at, arc)) {
          seen.insert({arc.label, block_[arc.target]});
          continue;
        }
        // It can go on for ever.
        const auto behind = silently_from(arc.target);
        if (std::ranges::count(behind, at) > 0) seen.insert({99, 0});
      }
    }
    return seen;
  }

  const LabelledGraph& graph_;
  const bool is_branching_;
  std::vector<std::uint32_t> block_;
};

std::string text_of(const LabelledGraph& graph) {
  std::string text;
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    for (const Arc& arc : graph.arcs(s)) {
      text += fmt::format("{} -{}-> {}\n", s, arc.label, arc.target);
    }
  }
  return text;
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

TEST_CASE("partitions of 4,000 random graphs are those of the definition") {
  std::uint64_t merged = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const LabelledGraph graph = random_graph(seed);
    for (const Equivalence equivalence :
         {Equivalence::Strong, Equivalence::Branching}) {
      const Partition blocks = coarsest_partition(graph, equivalence);
      const Partition naive = Naive(graph, equivalence).partition();
      REQUIRE_MESSAGE(blocks == naive, text_of(graph));
      merged += graph.size() - blocks.blocks;
      const LabelledGraph small = quotient(graph, blocks, equivalence);
      REQUIRE(small.size() == blocks.blocks);
      const Partition again = coarsest_partition(small, equivalence);
      REQUIRE_MESSAGE(again.blocks == small.size(), text_of(graph));
      const Partition both =
          coarsest_partition(beside(graph, small), equivalence);
      for (std::uint32_t s = 0; s < graph.size(); ++s) {
        REQUIRE_MESSAGE(
            both.block[s] == both.block[graph.size() + blocks.block[s]],
            text_of(graph));
      }
    }
  }
  CHECK(merged > 4000);
}

}  // namespace btcheck::minimise_test
