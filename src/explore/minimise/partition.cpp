// SPDX-License-Identifier: MIT
//
// The door: silent cycles are collapsed, blocks are found (refinement.cpp), and
// numbered as their first states are.
#include "explore/minimise/partition.hpp"

#include <algorithm>
#include <utility>

#include "explore/minimise/arcs.hpp"
#include "explore/minimise/refinement.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// In place: `block` by state, with blocks below the number of states.
Partition numbered(std::vector<std::uint32_t> block) {
  Partition made;
  std::vector<std::uint32_t> number(block.size(), kNoNumber);
  for (std::uint32_t& each : block) {
    std::uint32_t& known = number[each];
    if (known == kNoNumber) known = made.blocks++;
    each = known;
  }
  made.block = std::move(block);
  return made;
}

}  // namespace

Partition coarsest_partition(const LabelledGraph& graph,
                             Equivalence equivalence) {
  if (equivalence == Equivalence::Strong) {
    return numbered(refined(arcs_of(graph, equivalence, {})));
  }
  std::vector<std::uint32_t> component = silent_components(graph);
  const std::vector<std::uint32_t> block =
      refined(arcs_of(graph, equivalence, component));
  for (std::uint32_t& each : component) each = block[each];
  return numbered(std::move(component));
}

LabelledGraph quotient(const LabelledGraph& graph, const Partition& partition,
                       Equivalence equivalence) {
  const bool is_branching = equivalence == Equivalence::Branching;
  const std::vector<std::uint32_t> component =
      is_branching ? silent_components(graph) : std::vector<std::uint32_t>();
  const std::vector<std::uint32_t>& block = partition.block;
  // Calls visit(block, arc) for every arc that is not left out.
  const auto each_arc = [&](auto visit) {
    for (std::uint32_t s = 0; s < graph.size(); ++s) {
      for (const LabelledGraph::Arc& arc : graph.arcs(s)) {
        ask_budget();
        const std::uint32_t to = block[arc.target];
        const bool is_inert = is_branching && to == block[s] &&
                              arc.label == LabelledGraph::kSilent &&
                              component[s] != component[arc.target];
        if (!is_inert) visit(block[s], LabelledGraph::Arc{arc.label, to});
      }
    }
  };
  std::vector<std::size_t> first(partition.blocks + std::size_t{1}, 0);
  each_arc(
      [&](std::uint32_t from, const LabelledGraph::Arc&) { ++first[from]; });
  std::size_t count = 0;
  for (std::size_t& each : first) count += std::exchange(each, count);
  std::vector<LabelledGraph::Arc> arcs(count);
  each_arc([&](std::uint32_t from, const LabelledGraph::Arc& arc) {
    arcs[first[from]++] = arc;
  });
  LabelledGraph made;
  auto begin = arcs.begin();
  for (std::uint32_t b = 0; b < partition.blocks; ++b) {
    ask_budget();
    const auto end = arcs.begin() + static_cast<std::ptrdiff_t>(first[b]);
    std::sort(begin, end);
    made.add_state({begin, std::unique(begin, end)});
    begin = end;
  }
  return made;
}

LabelledGraph beside(const LabelledGraph& first, const LabelledGraph& second) {
  LabelledGraph both = first;
  const auto offset = static_cast<std::uint32_t>(first.size());
  std::vector<LabelledGraph::Arc> arcs;
  for (std::uint32_t s = 0; s < second.size(); ++s) {
    arcs.clear();
    for (const LabelledGraph::Arc& arc : second.arcs(s)) {
      arcs.push_back({arc.label, arc.target + offset});
    }
    both.add_state(arcs);
  }
  return both;
}

}  // namespace btcheck
