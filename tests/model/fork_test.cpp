// SPDX-License-Identifier: MIT
//
// Where two nodes part, which nodes remember their running child, and which
// edges bring a node where.
#include <doctest/doctest.h>

#include <string_view>

#include "btf_text.hpp"
#include "model/automata/network.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::fork_test {
namespace {

// t0: s1 (f2 (a3, b4), c5); u6: d7.
constexpr std::string_view kTrees =
    "(BehaviorTree :name t (Sequence :name s"
    " (Fallback :name f (Action :name a) (Action :name b))"
    " (Action :name c)))"
    "(BehaviorTree :name u (Action :name d))"
    "(Trees t u)";

TEST_CASE("two nodes part at the lowest node above both") {
  const BehaviorTree tree = tree_of(kTrees);
  const auto near = fork_of(tree, NodeId{4}, NodeId{3});
  REQUIRE(near.has_value());
  CHECK(near->node == NodeId{2});
  CHECK(near->one == 1);
  CHECK(near->other == 0);
  const auto far = fork_of(tree, NodeId{3}, NodeId{5});
  REQUIRE(far.has_value());
  CHECK(far->node == NodeId{1});
  CHECK(far->one == 0);
  CHECK(far->other == 1);
}

TEST_CASE("a node does not part from itself, its parent or another tree") {
  const BehaviorTree tree = tree_of(kTrees);
  CHECK(!fork_of(tree, NodeId{3}, NodeId{3}));
  CHECK(!fork_of(tree, NodeId{3}, NodeId{1}));
  CHECK(!fork_of(tree, NodeId{0}, NodeId{5}));
  CHECK(!fork_of(tree, NodeId{3}, NodeId{7}));
}

// A node resumes if its table has, from where it decides, edges that call a
// child other than the first.
bool decides_between_children(const Network& network, NodeId node) {
  const Automaton& automaton =
      network.automaton(network.node_automaton[index(node)]);
  const auto decides = automaton.find_location("tick_node");
  std::size_t calls = 0;
  for (const Edge& edge : automaton.edges) {
    const std::string& target = automaton.target(edge).name;
    calls += edge.source == decides && target.rfind("kid", 0) == 0;
  }
  return calls > 1;
}

TEST_CASE("who resumes its running child is who can call one at once") {
  for (const NodeTypeInfo& info : btf_node_types()) {
    if (info.max_children < 2 || info.type == NodeType::BehaviorTree) continue;
    std::string options;
    if (info.type == NodeType::Recovery) options = " :num_retries 1";
    if (info.type == NodeType::Parallel) options = " :success 1";
    const BehaviorTree tree =
        tree_of("(BehaviorTree :name t (" + std::string(info.name) + options +
                " (Action :name kid1) (Action :name kid2)))");
    CAPTURE(info.name);
    CHECK(decides_between_children(lower(tree, TickSemantics::Root),
                                   NodeId{1}) == (info.beside == Beside::None));
  }
}

TEST_CASE("a control node has a sign in pictures") {
  for (const NodeTypeInfo& info : kNodeTypes) {
    CAPTURE(info.name);
    const bool is_control =
        info.max_children > 1 && info.type != NodeType::OtherControl;
    CHECK(info.sign.empty() != is_control);
  }
}

TEST_CASE("an edge tells which node it brings where") {
  const BehaviorTree tree = tree_of(
      "(defsv w :states (Calm Storm))(BehaviorTree :name t (Action :ID a))");
  const Network network = lower(tree, TickSemantics::Root);
  std::size_t ticks = 0;
  for (std::uint32_t edge = 0; edge < network.edge_count(); ++edge) {
    const bool is_nodes =
        network.owner_of_edge(edge).kind == AutomatonKind::Node;
    CHECK((is_nodes || !node_entering(network, edge, LocationRole::Inner)));
    ticks += node_entering(network, edge, LocationRole::Tick) == NodeId{1};
  }
  CHECK(ticks == 1);
}

}  // namespace
}  // namespace btcheck::fork_test
