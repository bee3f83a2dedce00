// SPDX-License-Identifier: MIT
//
// States on one silent cycle are equivalent, and become one; that they are on a
// cycle is then a step of its own that leads back. Blocks are split by
// signatures (Blom and Orzan 2003): what can be done from a state, silent steps
// within its block first.
#include "explore/minimise/partition.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "explore/search/strong_components.hpp"

namespace btcheck {
namespace {

using Arc = LabelledGraph::Arc;

// Of a step from a silent cycle to itself.
constexpr std::uint32_t kDiverges = 0xffffffff;

// By state: on which silent cycle it is, or the number of a component of its
// own. A component that another leads to silently has the smaller number.
std::vector<std::uint32_t> silent_components(const LabelledGraph& graph) {
  const auto arcs_of = [&](std::uint32_t state) { return graph.arcs(state); };
  ComponentSearch<decltype(arcs_of)> search(graph.size(), arcs_of);
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    search.search_from(s, [&](const Arc& arc) {
      return arc.label == LabelledGraph::kSilent
                 ? arc.target
                 : ComponentSearch<decltype(arcs_of)>::kOutside;
    });
  }
  return search.take_components();
}

void make_a_set(std::vector<Arc>& arcs) {
  std::ranges::sort(arcs);
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
}

// The graph with one state for each silent cycle.
LabelledGraph without_cycles(const LabelledGraph& graph,
                             const std::vector<std::uint32_t>& component) {
  std::uint32_t count = 0;
  for (const std::uint32_t each : component) count = std::max(count, each + 1);
  std::vector<std::vector<Arc>> arcs(count);
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    const std::uint32_t from = component[s];
    for (const Arc& arc : graph.arcs(s)) {
      const std::uint32_t to = component[arc.target];
      const bool is_loop = arc.label == LabelledGraph::kSilent && from == to;
      arcs[from].push_back({is_loop ? kDiverges : arc.label, to});
    }
  }
  LabelledGraph made;
  for (std::vector<Arc>& each : arcs) {
    make_a_set(each);
    made.add_state(each);
  }
  return made;
}

// Blocks, numbered as their first states are.
Partition numbered(const std::vector<std::uint32_t>& block_of) {
  Partition made;
  std::map<std::uint32_t, std::uint32_t> number;
  for (const std::uint32_t block : block_of) {
    made.block.push_back(
        number.try_emplace(block, static_cast<std::uint32_t>(number.size()))
            .first->second);
  }
  made.blocks = static_cast<std::uint32_t>(number.size());
  return made;
}

// Silent steps of the graph lead to smaller states only.
std::vector<std::uint32_t> refined(const LabelledGraph& graph,
                                   bool passes_silently) {
  std::vector<std::uint32_t> block(graph.size(), 0);
  std::size_t blocks = 1;
  for (;;) {
    std::vector<std::vector<Arc>> signatures(graph.size());
    std::map<std::pair<std::uint32_t, std::vector<Arc>>, std::uint32_t> known;
    std::vector<std::uint32_t> next(graph.size());
    for (std::uint32_t s = 0; s < graph.size(); ++s) {
      std::vector<Arc>& signature = signatures[s];
      for (const Arc& arc : graph.arcs(s)) {
        const bool passes = passes_silently && block[arc.target] == block[s] &&
                            arc.label == LabelledGraph::kSilent;
        if (passes) {
          const std::vector<Arc>& behind = signatures[arc.target];
          signature.insert(signature.end(), behind.begin(), behind.end());
        } else {
          signature.push_back({arc.label, block[arc.target]});
        }
      }
      make_a_set(signature);
      next[s] = known
                    .try_emplace({block[s], signature},
                                 static_cast<std::uint32_t>(known.size()))
                    .first->second;
    }
    block = std::move(next);
    if (known.size() == blocks) return block;
    blocks = known.size();
  }
}

}  // namespace

Partition coarsest_partition(const LabelledGraph& graph,
                             Equivalence equivalence) {
  if (equivalence == Equivalence::Strong) {
    return numbered(refined(graph, false));
  }
  const std::vector<std::uint32_t> component = silent_components(graph);
  const std::vector<std::uint32_t> block =
      refined(without_cycles(graph, component), true);
  std::vector<std::uint32_t> block_of;
  for (const std::uint32_t each : component) block_of.push_back(block[each]);
  return numbered(block_of);
}

LabelledGraph quotient(const LabelledGraph& graph, const Partition& partition,
                       Equivalence equivalence) {
  const bool is_branching = equivalence == Equivalence::Branching;
  std::vector<std::vector<Arc>> arcs(partition.blocks);
  const std::vector<std::uint32_t> component =
      is_branching ? silent_components(graph) : std::vector<std::uint32_t>();
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    const std::uint32_t from = partition.block[s];
    for (const Arc& arc : graph.arcs(s)) {
      const std::uint32_t to = partition.block[arc.target];
      const bool is_inert =
          is_branching && arc.label == LabelledGraph::kSilent && from == to;
      if (is_inert && component[s] != component[arc.target]) continue;
      arcs[from].push_back({arc.label, to});
    }
  }
  LabelledGraph made;
  for (std::vector<Arc>& each : arcs) {
    make_a_set(each);
    made.add_state(each);
  }
  return made;
}

LabelledGraph beside(const LabelledGraph& first, const LabelledGraph& second) {
  LabelledGraph both = first;
  const auto offset = static_cast<std::uint32_t>(first.size());
  std::vector<Arc> arcs;
  for (std::uint32_t s = 0; s < second.size(); ++s) {
    arcs.clear();
    for (const Arc& arc : second.arcs(s)) {
      arcs.push_back({arc.label, arc.target + offset});
    }
    both.add_state(arcs);
  }
  return both;
}

}  // namespace btcheck
