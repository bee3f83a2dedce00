// SPDX-License-Identifier: MIT
#include "reference/naive_bisimulation.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace btcheck::reference {
namespace {

using Arc = LabelledGraph::Arc;
using States = std::set<std::uint32_t>;

constexpr std::uint32_t kDivergence = 0xffffffff;

bool is_inert(const Arc& arc, std::uint32_t from,
              const std::vector<std::uint32_t>& block) {
  return arc.label == LabelledGraph::kSilent &&
         block[arc.target] == block[from];
}

// Where inert steps lead to, the state itself among them.
States inertly_reached(const LabelledGraph& graph, std::uint32_t start,
                       const std::vector<std::uint32_t>& block) {
  States reached{start};
  std::vector<std::uint32_t> open{start};
  while (!open.empty()) {
    const std::uint32_t state = open.back();
    open.pop_back();
    for (const Arc& arc : graph.arcs(state)) {
      if (is_inert(arc, state, block) && reached.insert(arc.target).second) {
        open.push_back(arc.target);
      }
    }
  }
  return reached;
}

// Inert steps can go on for ever: a state is reached that comes back to itself.
bool diverges(const LabelledGraph& graph, std::uint32_t start,
              const std::vector<std::uint32_t>& block) {
  for (const std::uint32_t state : inertly_reached(graph, start, block)) {
    for (const Arc& arc : graph.arcs(state)) {
      if (is_inert(arc, state, block) &&
          inertly_reached(graph, arc.target, block).contains(state)) {
        return true;
      }
    }
  }
  return false;
}

// What an equivalent state must have as well: labels and blocks.
std::set<std::pair<std::uint32_t, std::uint32_t>> signature(
    const LabelledGraph& graph, std::uint32_t state,
    const std::vector<std::uint32_t>& block, bool is_branching) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> can;
  for (const std::uint32_t from :
       is_branching ? inertly_reached(graph, state, block) : States{state}) {
    for (const Arc& arc : graph.arcs(from)) {
      if (is_branching && is_inert(arc, from, block)) continue;
      can.insert({arc.label, block[arc.target]});
    }
  }
  return can;
}

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

bool answers(const LabelledGraph& graph, std::uint32_t from, const Arc& arc,
             std::uint32_t other, const std::vector<std::uint32_t>& block,
             Equivalence equivalence) {
  const bool is_branching = equivalence == Equivalence::Branching;
  if (is_branching && is_inert(arc, from, block)) return true;
  const States around =
      is_branching ? inertly_reached(graph, other, block) : States{other};
  return std::ranges::any_of(around, [&](std::uint32_t state) {
    return std::ranges::any_of(graph.arcs(state), [&](const Arc& each) {
      return each.label == arc.label && block[each.target] == block[arc.target];
    });
  });
}

bool contains(const Partition& coarse, const Partition& fine) {
  for (std::size_t s = 0; s < fine.block.size(); ++s) {
    for (std::size_t t = 0; t < s; ++t) {
      if (fine.block[s] == fine.block[t] && coarse.block[s] != coarse.block[t])
        return false;
    }
  }
  return true;
}

}  // namespace

Partition signature_partition(const LabelledGraph& graph,
                              Equivalence equivalence) {
  const bool is_branching = equivalence == Equivalence::Branching;
  const auto size = static_cast<std::uint32_t>(graph.size());
  std::vector<std::uint32_t> block(size, 0);
  for (std::size_t blocks = 0;;) {
    std::map<std::pair<std::uint32_t,
                       std::set<std::pair<std::uint32_t, std::uint32_t>>>,
             std::uint32_t>
        known;
    std::vector<std::uint32_t> next(size);
    for (std::uint32_t s = 0; s < size; ++s) {
      auto can = signature(graph, s, block, is_branching);
      if (is_branching && diverges(graph, s, block)) {
        can.insert({kDivergence, 0});
      }
      next[s] = known
                    .try_emplace({block[s], std::move(can)},
                                 static_cast<std::uint32_t>(known.size()))
                    .first->second;
    }
    block = std::move(next);
    if (known.size() == blocks) return numbered(block);
    blocks = known.size();
  }
}

bool is_bisimulation(const LabelledGraph& graph, const Partition& partition,
                     Equivalence equivalence) {
  const std::vector<std::uint32_t>& block = partition.block;
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    for (std::uint32_t t = 0; t < graph.size(); ++t) {
      if (block[s] != block[t]) continue;
      for (const Arc& arc : graph.arcs(s)) {
        if (!answers(graph, s, arc, t, block, equivalence)) return false;
      }
      if (equivalence == Equivalence::Branching && diverges(graph, s, block) &&
          !diverges(graph, t, block)) {
        return false;
      }
    }
  }
  return true;
}

Partition greatest_bisimulation(const LabelledGraph& graph,
                                Equivalence equivalence) {
  std::vector<Partition> found;
  // Every partition once: a block is that of a state before, or the next.
  std::vector<std::uint32_t> block(graph.size(), 0);
  for (;;) {
    const Partition partition = numbered(block);
    if (is_bisimulation(graph, partition, equivalence)) {
      found.push_back(partition);
    }
    std::size_t last = block.size();
    while (last-- > 0) {
      const auto end = block.begin() + static_cast<std::ptrdiff_t>(last);
      if (last > 0 && block[last] <= *std::max_element(block.begin(), end)) {
        break;
      }
    }
    if (last > block.size()) break;
    ++block[last];
    std::fill(block.begin() + static_cast<std::ptrdiff_t>(last) + 1,
              block.end(), 0);
  }
  for (const Partition& each : found) {
    if (std::ranges::all_of(found, [&](const Partition& other) {
          return contains(each, other);
        })) {
      return each;
    }
  }
  throw std::runtime_error("no bisimulation contains all others");
}

LabelledGraph random_graph(std::mt19937& random, std::uint32_t most) {
  const auto below = [&](std::uint32_t end) {
    return static_cast<std::uint32_t>(random() % end);
  };
  const std::uint32_t size = 1 + below(most);
  const std::uint32_t labels = 1 + below(4);
  const std::uint32_t silent = below(91);  // of 100
  const std::uint32_t shape = below(3);
  std::poisson_distribution<int> degree(0.3 + below(100) / 40.0);
  LabelledGraph graph;
  std::vector<Arc> arcs;
  for (std::uint32_t s = 0; s < size; ++s) {
    arcs.clear();
    for (int left = degree(random); left > 0; --left) {
      // Anywhere, or onwards only but for the last, or within a part.
      const std::uint32_t target = shape == 0   ? below(size)
                                   : shape == 1 ? s + 1 + below(4)
                                                : s / 8 * 8 + below(8);
      const std::uint32_t label = below(100) < silent ? 0 : 1 + below(labels);
      arcs.push_back({label, std::min(target, size - 1)});
    }
    graph.add_state(arcs);
  }
  return graph;
}

}  // namespace btcheck::reference
