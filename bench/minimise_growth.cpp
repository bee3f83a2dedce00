// SPDX-License-Identifier: MIT
//
// How the time to find the states that nobody can tell apart grows with the
// graph: nanoseconds for m log2 n, of m steps and n states, which stay about
// equal where the algorithm keeps its promise. Prints a table in Markdown.
//
//   minimise_growth [LARGEST]   states of the largest graphs, 1,000,000
//
// Graphs: `random`, four steps from each state to any other, half of them
// hidden, the others of three labels; `chain`, one step after the other, all
// with one label, whose states are told apart one by one from the end, which
// takes a method that splits by rounds n rounds; `hidden chain`, the same of
// hidden steps with one visible step at each hundredth state.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string_view>
#include <vector>

#include "explore/minimise/partition.hpp"

namespace btcheck {
namespace {

using Arc = LabelledGraph::Arc;

LabelledGraph random_steps(std::uint32_t states) {
  std::mt19937 random(7);
  LabelledGraph graph;
  std::vector<Arc> arcs(4);
  for (std::uint32_t s = 0; s < states; ++s) {
    for (Arc& arc : arcs) {
      const auto label = static_cast<std::uint32_t>(random() % 6);
      arc = {label > 3 ? LabelledGraph::kSilent : label,
             static_cast<std::uint32_t>(random() % states)};
    }
    graph.add_state(arcs);
  }
  return graph;
}

// Every `seen`-th step has a label, the others are hidden.
LabelledGraph chain(std::uint32_t states, std::uint32_t seen) {
  LabelledGraph graph;
  for (std::uint32_t s = 0; s + 1 < states; ++s) {
    const Arc arc{s % seen == 0 ? 1 : LabelledGraph::kSilent, s + 1};
    graph.add_state({&arc, 1});
  }
  graph.add_state({});
  return graph;
}

// The shortest of three times, in seconds.
double seconds_for(const LabelledGraph& graph, Equivalence equivalence,
                   std::uint32_t& blocks) {
  double best = 1e9;
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    blocks = coarsest_partition(graph, equivalence).blocks;
    const std::chrono::duration<double> taken =
        std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

void tell(std::string_view name, const LabelledGraph& graph,
          Equivalence equivalence) {
  std::uint32_t blocks = 0;
  const double seconds = seconds_for(graph, equivalence, blocks);
  const auto steps = static_cast<double>(graph.arc_count());
  const double unit = steps * std::log2(static_cast<double>(graph.size()));
  fmt::print("| {} | {} | {} | {} | {} | {:.3f} | {:.1f} |\n", name,
             equivalence == Equivalence::Strong ? "strong" : "branching",
             graph.size(), graph.arc_count(), blocks, seconds,
             seconds * 1e9 / unit);
  std::fflush(stdout);
}

}  // namespace
}  // namespace btcheck

int main(int argc, char** argv) {
  using namespace btcheck;
  const std::uint64_t largest =
      argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  fmt::print(
      "| graph | equivalence | states | steps | blocks | s | ns / (m log2 n) "
      "|\n|---|---|--:|--:|--:|--:|--:|\n");
  for (const Equivalence equivalence :
       {Equivalence::Branching, Equivalence::Strong}) {
    for (std::uint64_t states = 10'000; states <= largest; states *= 10) {
      const auto n = static_cast<std::uint32_t>(states);
      tell("random", random_steps(n), equivalence);
      tell("chain", chain(n, 1), equivalence);
      tell("hidden chain", chain(n, 100), equivalence);
    }
  }
  return 0;
}
