// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "model/automata/tick_memory.hpp"
#include "model/lowering.hpp"

namespace btcheck::tick_memory_test {
namespace {

Network remembering(const std::string& text, std::vector<NodeId> nodes,
                    TickSemantics ticks = TickSemantics::Root) {
  const auto tree = read_btf("t.btf", text);
  REQUIRE(tree.value.has_value());
  Network network = lower(*tree.value, ticks);
  remember_answers(*tree.value, nodes, network);
  return network;
}

// The edges of a node's automaton that write into the variable:
// "tick_node -> success: 1".
std::string writers(const Network& network, NodeId node, VariableId variable) {
  std::string text;
  const Automaton& automaton = network.automaton(node);
  for (const Edge& edge : automaton.edges) {
    for (const Assignment& update : edge.updates) {
      if (update.variable != variable) continue;
      text += automaton.source(edge).name + " -> " +
              automaton.target(edge).name + ": " +
              network.variable(variable).value_name(
                  update.value.terms()[0].operand) +
              "\n";
    }
  }
  return text;
}

}  // namespace

TEST_CASE("an answer is remembered until the tick is over") {
  const NodeId root{0};
  const NodeId action{2};
  const Network network = remembering(
      "(BehaviorTree (Sequence (Action :ID a) (Action :ID b)))", {action});
  const auto answer = answer_of(network, action);
  REQUIRE(answer.has_value());
  CHECK(qualified_name(network, *answer) == "a_btn2.answer");
  CHECK(network.variable(*answer).value_names ==
        std::vector<std::string>{"none", "success", "failure", "running"});
  CHECK(writers(network, action, *answer) ==
        "tick_node -> success: success\n"
        "tick_node -> failure: failure\n"
        "tick_node -> running: running\n");
  CHECK(writers(network, root, *answer) ==
        "running -> start_: none\n"
        "success -> success: none\n"
        "failure -> failure: none\n");
  CHECK(answer_of(network, root).has_value());
  CHECK(!answer_of(network, NodeId{1}));
  CHECK(!answer_of(network, NodeId{3}));
}

TEST_CASE("a tree that starts over needs no step to end its tick") {
  const Network network =
      remembering("(BehaviorTree :loop 1 (Action :ID a :SF))", {NodeId{1}});
  CHECK(writers(network, NodeId{0}, *answer_of(network, NodeId{1})) ==
        "running -> start_: none\n"
        "success -> start_: none\n"
        "failure -> start_: none\n");
}

TEST_CASE("what is remembered already is not remembered twice") {
  const auto tree = read_btf("t.btf",
                             "(BehaviorTree (Sequence (Action :ID a)"
                             " (Action :ID b)))");
  REQUIRE(tree.value.has_value());
  Network network = lower(*tree.value, TickSemantics::Root);
  const std::vector<NodeId> one = {NodeId{2}};
  const std::vector<NodeId> both = {NodeId{2}, NodeId{3}};
  remember_answers(*tree.value, one, network);
  const std::uint32_t edges = network.edge_count();
  const VariableId answer = *answer_of(network, NodeId{2});
  remember_answers(*tree.value, both, network);
  CHECK(network.edge_count() == edges);
  CHECK(answer_of(network, NodeId{2}) == answer);
  CHECK(writers(network, NodeId{0}, *answer_of(network, NodeId{3})) ==
        writers(network, NodeId{0}, answer));
}

}  // namespace btcheck::tick_memory_test
