// SPDX-License-Identifier: MIT
//
// Questions of the default report against all states of small random trees,
// written out: can it always still succeed, and who is left running.
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <utility>

#include "check/questions/defaults.hpp"
#include "explore/state/step.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "reference/effort.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::defaults_cross_check_test {
namespace {

NodeStatus status(const Network& network, const NaiveState& state,
                  NodeId node) {
  return static_cast<NodeStatus>(state.value(network.node_status[index(node)]));
}

bool all_roots_succeeded(const BehaviorTree& tree, const Network& network,
                         const NaiveState& state) {
  for (const NodeId root : tree.roots) {
    const Automaton& automaton =
        network.automaton(network.node_automaton[index(root)]);
    const auto success = automaton.find_location("success");
    if (!success ||
        state.value(automaton.location) != static_cast<int>(index(*success))) {
      return false;
    }
  }
  return true;
}

// States that can reach a success, by going back until nothing is added.
bool can_always_succeed(const BehaviorTree& tree, const Network& network,
                        const NaiveSpace& space) {
  std::vector<bool> can(space.states.size());
  for (std::size_t s = 0; s < can.size(); ++s) {
    can[s] = all_roots_succeeded(tree, network, space.states[s]);
  }
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t s = 0; s < can.size(); ++s) {
      for (const NaiveSpace::Step& step : space.steps[s]) {
        if (can[s] || !can[step.target]) continue;
        can[s] = grows = true;
      }
    }
  }
  for (const bool each : can) {
    if (!each) return false;
  }
  return true;
}

using Pairs = std::set<std::pair<NodeId, NodeId>>;  // leaf, above

// Leaves that run, with all between, when a node of any type ends.
void note_left_running(const BehaviorTree& tree, const Network& network,
                       const NaiveState& state, NodeId above, Pairs& pairs) {
  const NodeStatus decision = status(network, state, above);
  if (decision != NodeStatus::Success && decision != NodeStatus::Failure) {
    return;
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!is_leaf(tree.nodes[n].type)) continue;
    NodeId node{n};
    while (node != above && !tree.node(node).is_root() &&
           status(network, state, node) == NodeStatus::Running) {
      node = tree.node(node).parent;
    }
    if (node == above && above != NodeId{n}) pairs.insert({NodeId{n}, above});
  }
}

Pairs left_running(const BehaviorTree& tree, const Network& network,
                   const NaiveSpace& space) {
  Pairs pairs;
  for (std::size_t s = 0; s < space.states.size(); ++s) {
    for (const NaiveSpace::Step& step : space.steps[s]) {
      if (!step.edge) continue;
      const auto node = node_entering(network, *step.edge, LocationRole::Start);
      if (!node || tree.node(*node).is_root()) continue;
      note_left_running(tree, network, space.states[s], *node, pairs);
    }
  }
  return pairs;
}

}  // namespace

TEST_CASE("the default report agrees with all states written out") {
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(200, 2000);
  std::size_t lost = 0, left = 0, stale = 0, checked = 0;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    const std::string text =
        i % 3 == 2 ? random_tree(here, timed_weather()) : random_tree(here);
    CAPTURE(text);
    const auto tree = read_btf("t.btf", text);
    REQUIRE(tree.value);
    const Network network = lower(*tree.value, TickSemantics::Root);
    const auto space = naive_space(network, 5000);
    if (!space) continue;
    ++checked;
    const CompiledNetwork system(network);
    const bool can = can_always_succeed(*tree.value, network, *space);
    for (const Reduction reduction :
         {Reduction::None, Reduction::Live, Reduction::Full}) {
      CAPTURE(static_cast<int>(reduction));
      const DefaultReport report =
          check_defaults(*tree.value, system, reduction, {});
      REQUIRE(report.error == "");
      for (const TreeReport& answer : report.tree) {
        if (answer.question != TreeQuestion::CanAlwaysSucceed) continue;
        REQUIRE((answer.verdict == Verdict::Holds) == can);
      }
      Pairs found;
      for (const LeftRunningReport& each : report.left_running) {
        found.insert({each.leaf, each.above});
      }
      REQUIRE(found == left_running(*tree.value, network, *space));
      left += found.size();
      stale += report.stale_guards.size();
    }
    lost += !can;
  }
  CHECK_COVERED(checked > trees / 4);
  CHECK_COVERED(lost > trees / 10);
  CHECK_COVERED(lost < checked);
  CHECK_COVERED(left > trees / 50);
  CHECK_COVERED(stale > trees / 50);
}

}  // namespace btcheck::reference::defaults_cross_check_test
