// SPDX-License-Identifier: MIT
//
// What is known of parts: equal ones are one component, whatever tree they
// stand in and whatever they are called.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "explore/components/component.hpp"
#include "explore/components/component_store.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"

namespace btcheck::components_test {
namespace {

Network network_of(const std::string& text) {
  const auto tree = read_tree("t.xml", text, {});
  REQUIRE(tree.value);
  return lower(*tree.value, TickSemantics::Root);
}

// How many components are known once all subtrees of the tree have been asked
// for, and all outsides.
std::size_t known_with(const std::string& text, ComponentStore& store) {
  const Network network = network_of(text);
  ComponentTable table(
      network, std::vector<bool>(network.variables.size(), false), {}, &store);
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (network.automata[a].kind != AutomatonKind::Node) continue;
    CHECK(table.of(AutomatonId{a}) != nullptr);
    table.of(AutomatonId{a}, PartSide::Outside);
  }
  return store.size();
}

std::string tree(const std::string& inner) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">"
         "<BehaviorTree ID=\"T\">" +
         inner + "</BehaviorTree></root>";
}

// As it was put in.
std::shared_ptr<const Component> sized(std::size_t states) {
  auto made = std::make_shared<Component>();
  made->later.resize(states);
  return made;
}

TEST_CASE("a subtree that stands twice is one component") {
  const std::string part =
      "<Fallback><Action ID=\"Go\"/><Action ID=\"Wait\"/></Fallback>";
  ComponentStore one;
  ComponentStore two;
  const std::size_t alone = known_with(
      tree("<Sequence>" + part + "<Action ID=\"End\"/></Sequence>"), one);
  const std::size_t twice = known_with(
      tree("<Sequence>" + part + part + "<Action ID=\"End\"/></Sequence>"),
      two);
  // A leaf and the part are there once; new are the longer Sequence, and what
  // is outside of each child and grandchild.
  CHECK(twice < 2 * alone);
}

TEST_CASE("names, and what a leaf is told, make no other component") {
  ComponentStore store;
  const std::size_t known =
      known_with(tree("<Sequence><Action ID=\"Go\" to=\"1\"/><Inverter>"
                      "<Condition ID=\"Full\"/></Inverter></Sequence>"),
                 store);
  CHECK(known_with(tree("<Sequence name=\"s\"><Action ID=\"Drive\" to=\"2\"/>"
                        "<Inverter><Condition ID=\"Empty\"/></Inverter>"
                        "</Sequence>"),
                   store) == known);
}

TEST_CASE("behind a change that nobody sees all is known") {
  ComponentStore store;
  const std::size_t known =
      known_with(tree("<Sequence><Action ID=\"Go\"/><Fallback>"
                      "<Condition ID=\"Full\"/><Condition ID=\"Hot\"/>"
                      "</Fallback><Action ID=\"End\"/></Sequence>"),
                 store);
  // Inside of the inverters all is new, and around each of them; what the
  // Sequence is, is not.
  const Network network =
      network_of(tree("<Sequence><Action ID=\"Go\"/><Inverter><Inverter>"
                      "<Fallback><Condition ID=\"Full\"/>"
                      "<Condition ID=\"Hot\"/></Fallback></Inverter>"
                      "</Inverter><Action ID=\"End\"/></Sequence>"));
  ComponentTable table(
      network, std::vector<bool>(network.variables.size(), false), {}, &store);
  std::vector<std::size_t> new_ones;
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    if (automaton.kind != AutomatonKind::Node) continue;
    const std::size_t before = store.size();
    REQUIRE(table.of(AutomatonId{a}) != nullptr);
    if (store.size() > before) new_ones.push_back(automaton.edges.size());
  }
  CHECK(new_ones.size() == 2);
  CHECK(store.size() == known + 2);
}

TEST_CASE("a node may have a local that no edge speaks of") {
  Network network =
      network_of(tree("<Sequence><Action ID=\"Go\"/></Sequence>"));
  for (Automaton& automaton : network.automata) {
    automaton.locals.push_back(
        VariableId{static_cast<std::uint32_t>(network.variables.size())});
    network.variables.push_back(
        {VariableRole::Local, "unused", 0, 3, 0, {}, {}});
  }
  ComponentTable table(network,
                       std::vector<bool>(network.variables.size(), false), {});
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (network.automata[a].kind != AutomatonKind::Node) continue;
    CHECK(table.of(AutomatonId{a}) != nullptr);
  }
}

TEST_CASE("one that is too large for a network is made use of in others") {
  const Network network = network_of(
      tree("<ReactiveFallback><Action ID=\"Go\"/><Sleep msec=\"2000\"/>"
           "</ReactiveFallback>"));
  ComponentTable table(network,
                       std::vector<bool>(network.variables.size(), false),
                       {.edges = 50});
  std::size_t large = 0;
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    if (automaton.kind != AutomatonKind::Node) continue;
    const PlacedComponent* of_it = table.of(AutomatonId{a});
    REQUIRE(of_it != nullptr);
    const bool is_small = of_it->shape->automaton.edges.size() <= 50;
    CHECK((table.placeable(AutomatonId{a}, PartSide::Inside) != nullptr) ==
          is_small);
    if (!is_small) ++large;
  }
  // The Sleep counts. Above it nobody can tell: any tick may be the last.
  CHECK(large == 1);
}

TEST_CASE("of components as many are kept as there is room for") {
  constexpr std::size_t kMost = 100'000;
  ComponentStore store(kMost);
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    store.keep({i, i}, i % 3 == 0 ? nullptr : sized(i % 7));
    CHECK(store.bytes() <= kMost);
    const auto known = store.find({i, i});
    REQUIRE(known);
    CHECK((*known == nullptr) == (i % 3 == 0));
    // What is asked for again and again stays.
    if (i > 0) REQUIRE(store.find({1, 1}));
  }
  CHECK(store.size() > 10);
  CHECK_FALSE(store.find({7, 7}));
  store.forget();
  CHECK(store.size() == 0);
  CHECK(store.bytes() == 0);
  CHECK_FALSE(store.find({1, 1}));
}

TEST_CASE("contents have the same hash where they are the same") {
  const std::vector<std::int32_t> one = {1, 2, 3};
  CHECK(hash_of(one) == hash_of(std::vector<std::int32_t>{1, 2, 3}));
  CHECK_FALSE(hash_of(one) == hash_of(std::vector<std::int32_t>{1, 3, 2}));
  CHECK_FALSE(hash_of(one) == hash_of(std::vector<std::int32_t>{1, 2}));
}

}  // namespace
}  // namespace btcheck::components_test
