// SPDX-License-Identifier: MIT
//
// States are put into blocks by what they show. A block is split as long as
// its states differ in their signature: which blocks can be left for, after
// any steps within the block that show nothing, and whether such steps can go
// on for ever. When no block can be split any more, states of one block are
// bisimilar. No cleverness: the graphs have some thousand states.
#include "mutation/same_runs.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "explore/search/reachability.hpp"
#include "explore/state/step.hpp"

namespace btcheck::mutation {
namespace {

constexpr std::uint64_t kMostCompared = 200'000;

struct Arc {
  std::uint32_t to = 0;
  std::uint32_t edge = 0;
  bool is_time = false;

  friend bool operator==(const Arc&, const Arc&) = default;
};

struct Graph {
  bool is_complete = false;
  std::vector<std::vector<Arc>> arcs;  // by state
  std::vector<std::vector<int>> shown;
};

// What a location looks like from outside: those within a node all the same.
int shown_location(const Automaton& automaton, std::int64_t location) {
  static const std::vector<std::string> kFrame = {
      "start_",  "tick_node", "success", "failure",
      "running", "halt",      "halted",  "done"};
  const std::string& name =
      automaton.locations[static_cast<std::size_t>(location)].name;
  const auto found = std::find(kFrame.begin(), kFrame.end(), name);
  return static_cast<int>(found - kFrame.begin());
}

std::vector<int> shown_in(const CompiledNetwork& system, StateView state) {
  const Network& network = system.network();
  std::vector<int> shown;
  for (const VariableId variable : network.state_variable) {
    shown.push_back(static_cast<int>(system.value(state, variable)));
  }
  for (const Automaton& automaton : network.automata) {
    if (automaton.kind != AutomatonKind::Node) continue;
    shown.push_back(
        shown_location(automaton, system.value(state, automaton.location)));
    shown.push_back(static_cast<int>(system.value(
        state, network.node_status[btcheck::index(automaton.node)])));
  }
  return shown;
}

Graph graph_of(const Network& network) {
  struct Visitor : ReachabilityVisitor {
    const CompiledNetwork& system;
    Graph& graph;
    Visitor(const CompiledNetwork& of, Graph& into) : system(of), graph(into) {}
    std::vector<Arc>& from(StateId state) {
      if (graph.arcs.size() <= btcheck::index(state)) {
        graph.arcs.resize(btcheck::index(state) + 1);
        graph.shown.resize(graph.arcs.size());
      }
      return graph.arcs[btcheck::index(state)];
    }
    void stepped(StateId state, Step step, StateId to) {
      from(state).push_back({btcheck::index(to), step.edge, step.elapsed > 0});
    }
    GoOn expanded(StateId state, StateView view, bool) {
      from(state);
      graph.shown[btcheck::index(state)] = shown_in(system, view);
      return GoOn::Yes;
    }
  };
  Graph graph;
  const CompiledNetwork system(network);
  const Limits limits{.max_states = kMostCompared};
  Visitor visitor(system, graph);
  BreadthFirst search(system, limits);
  graph.is_complete = search.run(visitor).is_complete;
  return graph;
}

// The second graph's states are numbered on from the first's.
Graph union_of(Graph one, const Graph& other) {
  const auto offset = static_cast<std::uint32_t>(one.arcs.size());
  for (std::vector<Arc> arcs : other.arcs) {
    for (Arc& arc : arcs) arc.to += offset;
    one.arcs.push_back(std::move(arcs));
  }
  one.shown.insert(one.shown.end(), other.shown.begin(), other.shown.end());
  return one;
}

using Blocks = std::vector<std::uint32_t>;  // by state
using Signature = std::vector<std::uint64_t>;

bool is_silent(const Blocks& blocks, std::uint32_t from, const Arc& arc) {
  return !arc.is_time && blocks[from] == blocks[arc.to];
}

// The states from which silent steps can go on for ever.
std::vector<bool> divergent(const Graph& graph, const Blocks& blocks) {
  std::vector<bool> may(graph.arcs.size(), true);
  for (bool changes = true; changes;) {
    changes = false;
    for (std::uint32_t s = static_cast<std::uint32_t>(may.size()); s-- > 0;) {
      if (!may[s]) continue;
      const auto& arcs = graph.arcs[s];
      may[s] = std::any_of(arcs.begin(), arcs.end(), [&](const Arc& arc) {
        return is_silent(blocks, s, arc) && may[arc.to];
      });
      changes |= !may[s];
    }
  }
  return may;
}

std::vector<Signature> signatures(const Graph& graph, const Blocks& blocks) {
  const std::vector<bool> diverges = divergent(graph, blocks);
  std::vector<Signature> result(graph.arcs.size());
  for (bool changes = true; changes;) {
    changes = false;
    for (std::uint32_t s = static_cast<std::uint32_t>(result.size());
         s-- > 0;) {
      Signature found = {diverges[s] ? 1u : 0u};
      for (const Arc& arc : graph.arcs[s]) {
        if (is_silent(blocks, s, arc)) {
          const Signature& next = result[arc.to];
          if (!next.empty()) {
            found.insert(found.end(), next.begin() + 1, next.end());
          }
        } else {
          found.push_back(std::uint64_t{blocks[arc.to]} * 2 +
                          (arc.is_time ? 1 : 0) + 2);
        }
      }
      std::sort(found.begin() + 1, found.end());
      found.erase(std::unique(found.begin() + 1, found.end()), found.end());
      if (found == result[s]) continue;
      result[s] = std::move(found);
      changes = true;
    }
  }
  return result;
}

template <class Key>
std::size_t number(const std::vector<Key>& keys, Blocks& blocks) {
  std::map<Key, std::uint32_t> numbers;
  for (std::size_t s = 0; s < keys.size(); ++s) {
    blocks[s] =
        numbers.emplace(keys[s], static_cast<std::uint32_t>(numbers.size()))
            .first->second;
  }
  return numbers.size();
}

}  // namespace

bool have_same_runs(const Network& one, const Network& other) {
  Graph first = graph_of(one);
  const Graph second = graph_of(other);
  if (!first.is_complete || !second.is_complete) return false;
  if (first.arcs == second.arcs && first.shown == second.shown) return true;
  const std::size_t start_of_other = first.arcs.size();
  const Graph graph = union_of(std::move(first), second);
  Blocks blocks(graph.arcs.size());
  std::size_t count = number(graph.shown, blocks);
  while (blocks[0] == blocks[start_of_other]) {
    const std::vector<Signature> found = signatures(graph, blocks);
    std::vector<std::pair<std::uint32_t, Signature>> keys;
    for (std::size_t s = 0; s < blocks.size(); ++s) {
      keys.emplace_back(blocks[s], found[s]);
    }
    const std::size_t finer = number(keys, blocks);
    if (finer == count) return true;
    count = finer;
  }
  return false;
}

std::set<std::uint32_t> edges_taken(const Network& network) {
  std::set<std::uint32_t> taken;
  for (const auto& arcs : graph_of(network).arcs) {
    for (const Arc& arc : arcs) {
      if (arc.edge != kTimeStep) taken.insert(arc.edge);
    }
  }
  return taken;
}

}  // namespace btcheck::mutation
