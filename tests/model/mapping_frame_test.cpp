// SPDX-License-Identifier: MIT
//
// What every mapping shares: the frame, the root, where time stands, state
// variables, and the order in which automata are numbered.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "model/lowering.hpp"
#include "model/network_text.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::mapping_frame_test {
namespace {

constexpr std::string_view kOneAction =
    "(BehaviorTree :name t (Action :name n))";

std::vector<std::string> automaton_names(const Network& network) {
  std::vector<std::string> names;
  for (const Automaton& automaton : network.automata) {
    names.push_back(automaton.name);
  }
  return names;
}

TEST_CASE("a node begins in start_, uncalled, without a status") {
  const BehaviorTree tree = tree_of(kOneAction);
  const Network network = lower(tree, TickSemantics::Root);
  const Automaton& node = automaton_called(network, "n");
  CHECK(node.locations.front().name == "start_");
  CHECK(node.kind == AutomatonKind::Node);
  REQUIRE(node.gate.has_value());
  CHECK(node.gate == network.node_caller[1]);
  for (const VariableId variable :
       {node.location, *node.gate, network.node_status[1]}) {
    CHECK(network.variable(variable).initial == 0);
  }
  CHECK(network.variable(*node.gate).value_name(0) == "None");
  CHECK(network.variable(*node.gate).value_name(1) == "t_btn0");
  CHECK(network.variable(network.node_status[1]).value_name(4) == "halt_me");
  CHECK(network.variable(node.location).max ==
        static_cast<int>(node.locations.size()) - 1);
}

TEST_CASE("the root has no caller and takes one unit for each tick") {
  const BehaviorTree tree = tree_of(kOneAction);
  const Network network = lower(tree, TickSemantics::Root);
  CHECK(!network.node_caller[0].has_value());
  CHECK(!automaton_called(network, "t").gate.has_value());
  const std::string root = R"(
    start_ -> tick_node rstatus := no_ret_status
    tick_node -> n @[1,1]
    n -> n_done n.caller := t
    n_done -> running [n says running] rstatus := running
    n_done -> success [n says success] rstatus := success
    n_done -> failure [n says failure] rstatus := failure
    running -> start_
  )";
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes}) {
    CAPTURE(tick_name(ticks));
    CHECK(table_of(kOneAction, "t", ticks) == rows(root));
  }
  CHECK(table_of("(BehaviorTree :name t :loop 1 (Action :name n))", "t") ==
        rows(root + "success -> start_\n failure -> start_\n"));
}

TEST_CASE("under root only the root takes time") {
  const BehaviorTree tree = tree_of(example("drone3.btf"));
  const Network network = lower(tree, TickSemantics::Root);
  for (const Automaton& automaton : network.automata) {
    for (const Edge& edge : automaton.edges) {
      const bool is_tick = automaton.kind == AutomatonKind::Node &&
                           tree.node(automaton.node).is_root() &&
                           automaton.source(edge).name == "tick_node";
      CHECK(edge.when == (is_tick ? Interval{1, 1} : kAtOnce));
    }
  }
}

// Leaving tick_node takes a unit, for every edge or for the one to evaluate.
void check_times(const BehaviorTree& tree, TickSemantics ticks) {
  const Network network = lower(tree, ticks);
  for (const Automaton& automaton : network.automata) {
    if (automaton.kind != AutomatonKind::Node) continue;
    const Node& node = tree.node(automaton.node);
    const bool is_timed =
        node.is_root() || ticks == TickSemantics::Nodes || is_leaf(node.type);
    for (const Edge& edge : automaton.edges) {
      const bool leaves = automaton.source(edge).name == "tick_node";
      CAPTURE(automaton.name);
      CHECK(edge.when == (leaves && is_timed ? Interval{1, 1} : kAtOnce));
      if (leaves && is_timed) CHECK(edge.guard.is_true());
    }
  }
}

TEST_CASE("under leaves and nodes a timed node spends its unit in tick_node") {
  for (const char* name : {"drone3.btf", "recovery.btf", "roundrobin.btf"}) {
    CAPTURE(name);
    const BehaviorTree tree = tree_of(example(name));
    check_times(tree, TickSemantics::Leaves);
    check_times(tree, TickSemantics::Nodes);
  }
}

TEST_CASE("a node that decides by guards goes through evaluate when timed") {
  const auto has_evaluate = [](const std::string& node, TickSemantics ticks) {
    const std::string text =
        "(defsv v :states (x y)) (BehaviorTree :name t " + node + ")";
    const std::string table = table_of(text, "n", ticks);
    return table.find("tick_node -> evaluate @[1,1]\n") != std::string::npos;
  };
  const auto root = TickSemantics::Root;
  const auto leaves = TickSemantics::Leaves;
  const auto nodes = TickSemantics::Nodes;
  const std::string sequence = "(Sequence :name n (Action :name a))";
  for (const std::string& leaf : std::vector<std::string>{
           "(Eval :name n (= v x))", "(SetSV :name n :sv v)",
           "(Wait :name n :duration 2)"}) {
    CAPTURE(leaf);
    CHECK(!has_evaluate(leaf, root));
    CHECK(has_evaluate(leaf, leaves));
    CHECK(has_evaluate(leaf, nodes));
  }
  CHECK(!has_evaluate(sequence, leaves));
  CHECK(has_evaluate(sequence, nodes));
  CHECK(!has_evaluate("(Action :name n)", nodes));
  CHECK(!has_evaluate("(Condition :name n)", nodes));
}

TEST_CASE("under none every edge may fire at any time") {
  const BehaviorTree tree = tree_of(R"(
    (defsv v :states (x y))
    (BehaviorTree :name t (Sequence
     (Wait :duration 3) (Eval (= v x)) (Action :ID a :duration [1,2])
     (RateController :hz 5 (Action :ID b)))))");
  const Network network = lower(tree, TickSemantics::None);
  for (const Automaton& automaton : network.automata) {
    CAPTURE(automaton.name);
    CHECK(!automaton.find_location("evaluate").has_value());
    for (const Edge& edge : automaton.edges) CHECK(edge.when == kAnyTime);
  }
}

TEST_CASE("the four tick semantics have their names") {
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
        TickSemantics::None}) {
    CHECK(tick_semantics(tick_name(ticks)) == ticks);
  }
  CHECK(tick_name(TickSemantics::Leaves) == "leaves");
  CHECK(!tick_semantics("leaf").has_value());
}

TEST_CASE("a free enumeration moves along its transitions at any instant") {
  const std::string tree = "(BehaviorTree :name t (Eval :name n (= w Calm)))";
  CHECK(table_of("(defsv w :states (Calm Storm Fog))" + tree, "w") ==
        rows(R"(Calm -> Storm @[0,inf[
                Calm -> Fog @[0,inf[
                Storm -> Calm @[0,inf[
                Storm -> Fog @[0,inf[
                Fog -> Calm @[0,inf[
                Fog -> Storm @[0,inf[)"));
  CHECK(table_of("(defsv w :states (Calm Storm Fog) :init Fog"
                 " :transitions ((Calm Storm) (Storm Fog)))" +
                     tree,
                 "w") == rows(R"(Calm -> Storm @[0,inf[
                                 Storm -> Fog @[0,inf[)"));
}

TEST_CASE("an enumeration that the tree writes stays where it is put") {
  const std::string tree = "(BehaviorTree :name t (SetSV :name n :sv w))";
  CHECK(table_of("(defsv w :states (Calm Storm))" + tree, "w") == "");
  CHECK(table_of("(defsv w :states (Calm Storm) :moves free)" + tree, "w") ==
        rows(R"(Calm -> Storm @[0,inf[
                Storm -> Calm @[0,inf[)"));
  CHECK(table_of("(defsv w :states (Calm Storm) :moves sampled)"
                 "(BehaviorTree :name t (Eval :name n (= w Calm)))",
                 "w") == "");
}

TEST_CASE("the location of an enumeration's automaton is the variable") {
  const BehaviorTree tree = tree_of(R"(
    (defsv level :min -2 :max 3 :init 1)
    (defsv w :states (Calm Storm) :init Storm)
    (BehaviorTree :name t (Eval (= w Calm))))");
  const Network network = lower(tree, TickSemantics::Root);
  CHECK(!network.state_automaton[0].has_value());
  REQUIRE(network.state_automaton[1].has_value());
  const Automaton& weather = network.automaton(*network.state_automaton[1]);
  CHECK(weather.kind == AutomatonKind::StateVariable);
  CHECK(weather.location == network.state_variable[1]);
  CHECK(weather.location_names() == std::vector<std::string>{"Calm", "Storm"});
  CHECK(network.variable(weather.location).initial == 1);
  const Variable& level = network.variable(network.state_variable[0]);
  CHECK(level.min == -2);
  CHECK(level.max == 3);
  CHECK(level.initial == 1);
  CHECK(level.role == VariableRole::State);
}

TEST_CASE("processes of drone3 are numbered as in the paper") {
  const BehaviorTree tree = tree_of(example("drone3.btf"));
  const Network network = lower(tree, TickSemantics::Root);
  REQUIRE(network.automata.size() == 39);
  const auto process = [&](std::size_t number) {
    const Automaton& automaton = network.automata[number - 1];
    return automaton.kind == AutomatonKind::Node
               ? short_name(tree, automaton.node)
               : automaton.name;
  };
  const auto line = [&](std::size_t number) {
    return tree.node(network.automata[number - 1].node).span.line;
  };
  CHECK(process(1) == "battery");
  CHECK(process(5) == "measure_battery");
  CHECK(process(8) == "land@23");
  CHECK(network.automata[7].name == "land_btn12");
  CHECK(process(12) == "Eval26");
  CHECK(line(12) == 26);
  CHECK(process(13) == "goto_waypoint@27");
  CHECK(network.automata[12].name == "goto_waypoint_btn16");
  CHECK(process(16) == "localization_ok");
  CHECK(network.automata[15].name == "localization_ok_btn18");
  CHECK(process(17) == "land@31");
  CHECK(network.automata[16].name == "land_btn20");
  CHECK(process(21) == "camera_track");
  CHECK(process(39) == "drone");
}

TEST_CASE("several trees come one after the other, timers after all") {
  const BehaviorTree tree = tree_of(R"(
    (defsv v :states (x y))
    (BehaviorTree :name one (Sequence :name s
      (Wait :name w :duration 3) (Action :name a)))
    (BehaviorTree :name two (RateController :hz 2 :name r (Action :name b)))
    (Trees one two))");
  const Network network = lower(tree, TickSemantics::Root);
  CHECK(automaton_names(network) ==
        std::vector<std::string>{"v", "w_btn2", "a_btn3", "s_btn1", "one_btn0",
                                 "b_btn6", "r_btn5", "two_btn4", "w_btn2_timer",
                                 "r_btn5_timer"});
  CHECK(!network.node_caller[0].has_value());
  CHECK(!network.node_caller[4].has_value());
  CHECK(table_of("(BehaviorTree :name one (Action :name a))"
                 "(BehaviorTree :name two (Action :name b)) (Trees one two)",
                 "two") == rows(R"(
    start_ -> tick_node rstatus := no_ret_status
    tick_node -> b @[1,1]
    b -> b_done b.caller := two
    b_done -> running [b says running] rstatus := running
    b_done -> success [b says success] rstatus := success
    b_done -> failure [b says failure] rstatus := failure
    running -> start_)"));
}

TEST_CASE("every edge has a number, and the number finds it") {
  const BehaviorTree tree = tree_of(example("nav2.btf"));
  const Network network = lower(tree, TickSemantics::Nodes);
  std::uint32_t number = 0;
  for (const Automaton& automaton : network.automata) {
    CHECK(automaton.first_edge == number);
    for (const Edge& edge : automaton.edges) {
      CHECK(&network.edge(number) == &edge);
      CHECK(&network.owner_of_edge(number) == &automaton);
      ++number;
    }
  }
  CHECK(network.edge_count() == number);
}

}  // namespace
}  // namespace btcheck::mapping_frame_test
