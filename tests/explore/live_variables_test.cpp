// SPDX-License-Identifier: MIT
//
// What edges forget, and what they must not: on small trees, and on automata
// made by hand.
#include "explore/reduce/live_variables.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "explore/lowered.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"

namespace btcheck::live_variables_test {
namespace {

LiveNetwork live_of(const Network& network) {
  return forget_dead_values(network, Observed(network));
}

// What an edge leaves in a variable that was `before`, all others at first.
int left_by(const Network& network, const Edge& edge, VariableId variable,
            int before) {
  std::vector<int> values;
  for (const Variable& each : network.variables) values.push_back(each.initial);
  values[index(variable)] = before;
  for (const Assignment& update : edge.updates) {
    const auto value = update.value.evaluate([&](const Term& term) {
      return values[static_cast<std::size_t>(term.operand)];
    });
    values[index(update.variable)] = static_cast<int>(value);
  }
  return values[index(variable)];
}

// A root with a local x that starts at 0 and has four values, or more.
struct Local {
  int greatest = 3;
  toy::Draft draft = {};
  AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"s", "t", "u"});
  VariableId x = draft.variable("x", 0, greatest, 0, VariableRole::Local);

  Network finish() {
    Network network = draft.finish();
    network.automata[index(a)].locals.push_back(x);
    return network;
  }
  // What the live network's edge leaves of a value.
  int left(std::uint32_t edge, int before) {
    const LiveNetwork live = live_of(finish());
    return left_by(live.network, live.network.edge(edge), x, before);
  }
};

// x is chosen, then read once, and then written before it is read again.
Local chosen_and_read(const std::vector<int>& chosen, Expression read,
                      int greatest = 3) {
  Local local{.greatest = greatest};
  local.draft.edge(local.a, 1, 2, kAtOnce, std::move(read));
  local.draft.edge(local.a, 2, 0);
  for (const int value : chosen) {
    local.draft.edge(local.a, 0, 1, {1, 1}, {}, {toy::assign(local.x, value)});
  }
  return local;
}

TEST_CASE("a value that has been read for the last time is forgotten") {
  Local local = chosen_and_read({2}, toy::is(VariableId{2}, 2));
  REQUIRE(local.x == VariableId{2});
  CHECK(local.left(0, 2) == 0);
  CHECK(local.left(2, 0) == 2);
  CHECK(live_of(local.finish()).forgotten[index(local.x)]);
}

TEST_CASE("values that are not compared with are one") {
  Local local = chosen_and_read({1, 2, 3}, toy::is(VariableId{2}, 2));
  CHECK(local.left(2, 0) == 0);
  CHECK(local.left(3, 0) == 2);
  CHECK(local.left(4, 0) == 0);
}

TEST_CASE("of a large domain a value is kept as it is, or forgotten") {
  for (const int greatest : {63, 64, 100'000'000}) {
    CAPTURE(greatest);
    Local local =
        chosen_and_read({1, 2, 60}, toy::is(VariableId{2}, 2), greatest);
    CHECK(local.left(0, 2) == 0);
    CHECK(local.left(3, 0) == 2);
    CHECK(local.left(4, 0) == (greatest == 63 ? 0 : 60));
    Local seen = chosen_and_read({1, 60}, toy::is(VariableId{2}, 0), greatest);
    CHECK(seen.left(2, 0) != 0);
    CHECK(seen.left(3, 0) != 0);
    const Network network = local.finish();
    Observed observed(network);
    observed.add(toy::is(local.x, 60));
    const LiveNetwork live = forget_dead_values(network, observed);
    CHECK(left_by(live.network, live.network.edge(4), local.x, 0) == 60);
  }
}

TEST_CASE("a long Sequence forgets where it began when it goes on") {
  std::string text = "((BehaviorTree :name t (Sequence :name s";
  for (int i = 0; i < 70; ++i)
    text += " (Action :ID a" + std::to_string(i) + ")";
  const Network network = lowered(text + ")))");
  const LiveNetwork live = live_of(network);
  const Automaton& sequence = network.automaton(automaton_of(network, "s"));
  for (const VariableId local : sequence.locals) {
    CHECK(network.variable(local).domain_size() == 70);
    CHECK(live.forgotten[index(local)]);
  }
  CHECK(!sequence.locals.empty());
}

TEST_CASE("what stands for the rest is no value that is compared with") {
  Local local = chosen_and_read({2, 3}, toy::is(VariableId{2}, 0));
  CHECK(local.left(2, 0) != 0);
  CHECK(local.left(2, 0) == local.left(3, 0));
}

TEST_CASE("a value that is ordered or copied is kept") {
  const VariableId x{2};
  Local ordered = chosen_and_read(
      {1, 2, 3}, Expression::binary(Operation::Less, toy::variable(x),
                                    Expression::constant(3)));
  for (const int value : {1, 2, 3}) {
    CHECK(ordered.left(1 + static_cast<std::uint32_t>(value), 0) == value);
  }
  Local copied = chosen_and_read({1, 2}, {});
  const VariableId y = copied.draft.variable("y", 0, 3);
  copied.draft.edge(copied.a, 1, 2, kAtOnce, {}, {{y, toy::variable(x)}});
  CHECK(copied.left(2, 0) == 1);
  CHECK(copied.left(3, 0) == 2);
}

TEST_CASE("a value that lasts around the cycle is kept") {
  Local local;
  local.draft.edge(local.a, 0, 1, {1, 1}, {}, {toy::assign(local.x, 1)});
  local.draft.edge(local.a, 1, 2);
  local.draft.edge(local.a, 2, 1, kAtOnce, toy::is(local.x, 1));
  for (std::uint32_t edge : {0u, 1u, 2u}) CHECK(local.left(edge, 1) == 1);
}

TEST_CASE("a local that another automaton reads is left alone") {
  Local local = chosen_and_read({2}, toy::is(VariableId{2}, 2));
  const AutomatonId other =
      local.draft.automaton(AutomatonKind::Node, "b", {"s", "t"});
  local.draft.edge(other, 0, 1, kAtOnce, toy::is(local.x, 2));
  CHECK(local.left(0, 2) == 2);
  CHECK(!live_of(local.finish()).forgotten[index(local.x)]);
}

TEST_CASE("an observed value is never forgotten") {
  for (int seen = 0; seen <= 3; ++seen) {
    CAPTURE(seen);
    Local local = chosen_and_read({1, 2, 3}, toy::is(VariableId{2}, 2));
    const Network network = local.finish();
    Observed observed(network);
    observed.add(toy::is(local.x, seen));
    const Network live = forget_dead_values(network, observed).network;
    for (const std::uint32_t choice : {2u, 3u, 4u}) {
      int was = 0, is = 0;
      for (const std::uint32_t edge : {choice, 0u, 1u}) {
        if (edge == 0 && was != 2) break;  // its guard
        was = left_by(network, network.edge(edge), local.x, was);
        is = left_by(live, live.edge(edge), local.x, is);
        CHECK((was == 2 && edge == choice) == (is == 2 && edge == choice));
        CHECK((was == seen) == (is == seen));
      }
    }
  }
}

TEST_CASE("a variable observed whole is left alone") {
  Local local = chosen_and_read({1, 2, 3}, toy::is(VariableId{2}, 2));
  const Network network = local.finish();
  Observed observed(network);
  observed.add(local.x);
  CHECK(!forget_dead_values(network, observed).forgotten[index(local.x)]);
}

TEST_CASE("nothing is forgotten where the protocol does not hold") {
  Local local = chosen_and_read({2}, toy::is(VariableId{2}, 2));
  const VariableId called =
      local.draft.variable("caller", 0, 1, 0, VariableRole::Caller);
  const AutomatonId child =
      local.draft.automaton(AutomatonKind::Node, "c", {"s", "t"}, called);
  local.draft.edge(child, 0, 1, kAtOnce, toy::is(called, 1),
                   {toy::assign(called, 0)});
  CHECK(local.left(0, 2) == 2);
}

TEST_CASE("what a child looks at when it is called is kept for it") {
  Family family;
  toy::Draft& draft = family.draft;
  const VariableId status = draft.finish().node_status[1];
  // The parent leaves something for the child, and waits before it calls.
  draft.edge(family.parent, 0, 0, kAtOnce, {}, {toy::assign(status, 3)});
  draft.edge(family.parent, 0, 0, kAtOnce, {}, {toy::assign(status, 2)});
  draft.edge(family.parent, 0, 0, kAtOnce, {}, {toy::assign(status, 1)});
  draft.edge(family.child, 0, 1, kAtOnce,
             both(toy::is(family.called, 1), toy::is(status, 2)));
  const Network live = live_of(draft.finish()).network;
  CHECK(left_by(live, live.edge(2), status, 0) != 2);
  CHECK(left_by(live, live.edge(3), status, 0) == 2);
  CHECK(left_by(live, live.edge(4), status, 0) ==
        left_by(live, live.edge(2), status, 0));
}

// One node of many types, with children that may run.
const char* const kForest =
    "((defsv x :init 0 :min 0 :max 2) (BehaviorTree :name t :loop 1"
    " (ReactiveSequence :name r :halt 1 (Condition :ID c)"
    " (Parallel :name p :success 1 :halt 1 (Action :ID a)"
    " (Sequence :name s (Action :ID b) (Eval :name e (:= x 1)))))))";

TEST_CASE("edges keep their numbers, guards and times, and write no less") {
  const Network network = lowered(kForest);
  const LiveNetwork live = live_of(network);
  REQUIRE(live.network.edge_count() == network.edge_count());
  for (std::uint32_t e = 0; e < network.edge_count(); ++e) {
    const Edge& before = network.edge(e);
    const Edge& after = live.network.edge(e);
    CHECK(before.source == after.source);
    CHECK(before.target == after.target);
    CHECK(before.guard == after.guard);
    CHECK(before.when == after.when);
    REQUIRE(before.updates.size() <= after.updates.size());
    for (std::size_t u = 0; u < after.updates.size(); ++u) {
      const VariableId variable = after.updates[u].variable;
      if (u >= before.updates.size()) {
        CHECK(live.forgotten[index(variable)]);
        continue;
      }
      CHECK(before.updates[u].variable == variable);
      CHECK(before.updates[u].value == after.updates[u].value);
    }
  }
}

TEST_CASE("only locals and statuses are ever forgotten") {
  const Network network = lowered(kForest);
  const LiveNetwork live = live_of(network);
  int forgotten = 0;
  for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
    if (!live.forgotten[v]) continue;
    ++forgotten;
    const VariableRole role = network.variables[v].role;
    CHECK((role == VariableRole::Local || role == VariableRole::Status));
  }
  CHECK(forgotten > 0);
}

// Whether some edge of the node into a location forgets a child's success.
bool forgets_success(const Network& network, const LiveNetwork& live,
                     std::string_view node, std::string_view location,
                     std::string_view child) {
  const AutomatonId parent = automaton_of(network, node);
  const NodeId called = network.automaton(automaton_of(network, child)).node;
  const VariableId status = network.node_status[index(called)];
  const int success = static_cast<int>(NodeStatus::Success);
  const LocationId target = location_of(network, parent, location);
  const auto& edges = live.network.automaton(parent).edges;
  return std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    return edge.target == target &&
           left_by(live.network, edge, status, success) != success;
  });
}

TEST_CASE("a Parallel forgets its children's answers when it has decided") {
  const Network network = lowered(
      "((BehaviorTree :name t :loop 1 (ParallelAll :name p (Action :ID a)"
      " (Action :ID b))))");
  const LiveNetwork live = live_of(network);
  for (const std::string child : {"a", "b"}) {
    CHECK(forgets_success(network, live, "p", "success", child));
    // `active` is 1 still: it goes on counting.
    CHECK(!forgets_success(network, live, "p", "running", child));
  }
}

TEST_CASE("a parent that only asks who runs forgets whether it was success") {
  const Network network = lowered(
      "((BehaviorTree :name t :loop 1 (ReactiveSequence :name r :halt 1"
      " (Condition :ID c) (Action :ID a) (Action :ID b))))");
  const LiveNetwork live = live_of(network);
  CHECK(forgets_success(network, live, "r", "success", "b"));
  const NodeId called = network.automaton(automaton_of(network, "b")).node;
  const VariableId status = network.node_status[index(called)];
  const int running = static_cast<int>(NodeStatus::Running);
  for (const Edge& edge :
       live.network.automaton(automaton_of(network, "r")).edges) {
    const bool leads_on =
        edge.target ==
        location_of(network, automaton_of(network, "r"), "running");
    if (leads_on)
      CHECK(left_by(live.network, edge, status, running) == running);
  }
}

std::size_t updates_in(const Network& network) {
  std::size_t count = 0;
  for (const Automaton& automaton : network.automata) {
    for (const Edge& edge : automaton.edges) count += edge.updates.size();
  }
  return count;
}

// Each child's failure leads to where all of them are reset.
TEST_CASE("of hundreds of children no edge forgets all") {
  const auto written = [](int children) {
    std::string text =
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><Sequence>";
    for (int i = 0; i < children; ++i) text += fmt::format("<A{}/>", i);
    text += "</Sequence></BehaviorTree></root>";
    const auto tree = read_tree("t.xml", text, {});
    REQUIRE(tree.value);
    const Network network = lower(*tree.value, TickSemantics::Root);
    return updates_in(live_of(network).network);
  };
  const std::size_t hundred = written(100);
  CHECK(written(400) < 5 * hundred);
}

}  // namespace
}  // namespace btcheck::live_variables_test
