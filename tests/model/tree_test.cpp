// SPDX-License-Identifier: MIT
//
// Names, orders, and which variables move, on trees read from text.
#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

#include "btf_text.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::tree_test {
namespace {

constexpr std::string_view kMission = R"((
(BehaviorTree :name mission
 (Sequence :name main
  (Fallback (Condition :ID ok) (SubTree :ID safe))
  (Action :ID land)
  (SubTree :ID safe)))
(BehaviorTree :name safe (Action :ID land))))";

TEST_CASE("a node type has its name") {
  CHECK(type_name(NodeType::BehaviorTree) == "BehaviorTree");
  CHECK(type_name(NodeType::Wait) == "Wait");
}

TEST_CASE("actions, conditions, SetSV, Eval and Wait are the leaves") {
  std::vector<std::string_view> leaves;
  for (const NodeTypeInfo& info : btf_node_types()) {
    if (is_leaf(info.type)) leaves.push_back(info.name);
  }
  CHECK(leaves == std::vector<std::string_view>{"Action", "Condition", "SetSV",
                                                "Eval", "Wait"});
}

TEST_CASE("nodes are numbered in pre-order and have four names each") {
  const BehaviorTree tree = tree_of(kMission);
  REQUIRE(tree.nodes.size() == 9);
  CHECK(unique_name(tree, NodeId{5}) == "land_btn5");
  CHECK(path_name(tree, NodeId{5}) == "main/Fallback4/safe/land");
  CHECK(path_name(tree, NodeId{6}) == "main/land");
  CHECK(path_name(tree, NodeId{0}) == "mission");
  CHECK(short_name(tree, NodeId{6}) == "land@5");
  CHECK(short_name(tree, NodeId{3}) == "ok");
}

TEST_CASE("the post-order visits children from left to right, roots last") {
  const BehaviorTree tree = tree_of(kMission);
  std::vector<unsigned> order;
  for (const NodeId node : post_order(tree)) order.push_back(index(node));
  CHECK(order == std::vector<unsigned>{3, 5, 4, 2, 6, 8, 7, 1, 0});
}

TEST_CASE("trees that run in parallel come one after the other") {
  const BehaviorTree tree = tree_of(R"(
    (BehaviorTree :name b (Action :ID y))
    (BehaviorTree :name a (Action :ID x))
    (Trees a b))");
  REQUIRE(tree.roots.size() == 2);
  CHECK(tree.node(tree.roots[0]).name == "a");
  std::vector<unsigned> order;
  for (const NodeId node : post_order(tree)) order.push_back(index(node));
  CHECK(order == std::vector<unsigned>{1, 0, 3, 2});
}

TEST_CASE("an enumeration that nothing writes moves by itself") {
  const BehaviorTree tree = tree_of(R"(
    (defsv weather :states (Calm Storm))
    (defsv battery :states (Good Low))
    (defsv panel :states (In Out))
    (defsv door :states (Closed Open))
    (defsv level :max 3)
    (defaction unfold :on-success (:= panel Out))
    (defcondition shut :on-failure ((:= door Open)))
    (BehaviorTree :name main (Sequence
     (SetSV :ID measure :sv battery)
     (Action :ID unfold) (Condition :ID shut)
     (Eval (= weather Calm)))))");
  const bool moves[] = {true, false, false, false, false};
  for (std::uint32_t i = 0; i < 5; ++i) {
    CAPTURE(i);
    CHECK(moves_freely(tree, StateVariableId{i}) == moves[i]);
    CHECK(is_written(tree, StateVariableId{i}) == (i > 0 && i < 4));
  }
}

TEST_CASE(":moves has the last word, without it a number does not move") {
  const BehaviorTree tree = tree_of(R"(
    (defsv battery :states (Good Low) :moves free)
    (defsv weather :states (Calm Storm) :moves sampled)
    (defsv level :max 3)
    (defsv charge :max 3 :moves free)
    (BehaviorTree :name main (SetSV :sv battery)))");
  CHECK(moves_freely(tree, StateVariableId{0}));
  CHECK(!moves_freely(tree, StateVariableId{1}));
  CHECK(!moves_freely(tree, StateVariableId{2}));
  CHECK(moves_freely(tree, StateVariableId{3}));
}

TEST_CASE("values are shown by the names of their states") {
  const BehaviorTree tree = tree_of(R"(
    (defsv battery :states (Good Low)) (defsv level :min -2 :max 3)
    (BehaviorTree :name main (Action :ID a)))");
  CHECK(tree.variables[0].value_name(1) == "Low");
  CHECK(tree.variables[0].value_name(2) == "2");
  CHECK(tree.variables[0].value_name(-1) == "-1");
  CHECK(tree.variables[1].value_name(-2) == "-2");
}

}  // namespace
}  // namespace btcheck::tree_test
