// SPDX-License-Identifier: MIT
//
// Where automata go round by themselves: those that call again, none that halt.
#include "explore/reduce/call_protocol.hpp"

#include <doctest/doctest.h>

#include "explore/lowered.hpp"

namespace btcheck::own_cycles_test {
namespace {

std::size_t heads(const Network& network, AutomatonId automaton) {
  const CallProtocol protocol(network);
  REQUIRE(protocol.holds());
  return cycle_heads(network, protocol, automaton).size();
}

// Of a node `n` with two children that may run.
std::size_t heads_of(const std::string& node, const std::string& children,
                     TickSemantics ticks = TickSemantics::Root) {
  CAPTURE(node);
  const Network network = lowered(
      "((BehaviorTree :name t :loop 1 (ReactiveSequence :halt 1"
      " (Condition :ID c) (" +
          node + " " + children + "))))",
      ticks);
  return heads(network, automaton_of(network, "n"));
}

const char* const kOne = "(Action :ID a)";
const char* const kTwo = "(Action :ID a) (Action :ID b)";

TEST_CASE("a turn that ends is no round") {
  Family family;
  CHECK(heads(family.draft.finish(), family.child) == 0);
}

TEST_CASE("a root that takes time goes round without a head, until untimed") {
  Family family;
  CHECK(heads(family.draft.finish(), family.parent) == 0);
  family.draft.set_ticks(TickSemantics::None);
  CHECK(heads(family.draft.finish(), family.parent) == 1);
}

TEST_CASE("a cycle beside one that takes time has its head") {
  Family family;
  family.draft.edge(family.parent, 0, 0);
  const Network network = family.draft.finish();
  const auto found = cycle_heads(network, CallProtocol(network), family.parent);
  CHECK(found == std::vector<LocationId>{LocationId{0}});
}

TEST_CASE("two cycles through different locations have two heads") {
  toy::Draft draft;
  const AutomatonId a =
      draft.automaton(AutomatonKind::Node, "a", {"w", "x", "y", "z"});
  draft.edge(a, 0, 1);
  draft.edge(a, 1, 0);
  draft.edge(a, 1, 2);
  draft.edge(a, 2, 3);
  draft.edge(a, 3, 2);
  CHECK(heads(draft.finish(), a) == 2);
}

TEST_CASE("nodes that call a child again in one turn have a head") {
  CHECK(heads_of("Repeat :name n :repeat 3", kOne) > 0);
  CHECK(heads_of("RetryUntilSuccessful :name n :num_attempts 3", kOne) > 0);
  CHECK(heads_of("Recovery :name n :num_retries 2", kTwo) > 0);
  CHECK(heads_of("RoundRobin :name n", kTwo) > 0);
}

TEST_CASE("nodes that go through their children once have none, nor to halt") {
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Nodes, TickSemantics::None}) {
    CHECK(heads_of("Sequence :name n", kTwo, ticks) == 0);
    CHECK(heads_of("Fallback :name n", kTwo, ticks) == 0);
    CHECK(heads_of("ReactiveSequence :name n :halt 1", kTwo, ticks) == 0);
    CHECK(heads_of("ReactiveFallback :name n :wait 1", kTwo, ticks) == 0);
    CHECK(heads_of("Parallel :name n :success 1 :halt 1", kTwo, ticks) == 0);
    CHECK(heads_of("PipelineSequence :name n", kTwo, ticks) == 0);
    CHECK(heads_of("Inverter :name n", kOne, ticks) == 0);
    CHECK(heads_of("RateController :name n :hz 5", kOne, ticks) == 0);
  }
}

// A parent that calls its child for as long as the child's status is 3, and
// writes 4 into it beforehand.
struct Halting {
  Family family;
  VariableId status{};

  Halting() {
    toy::Draft& draft = family.draft;
    status = draft.finish().node_status.back();
    draft.edge(family.parent, 1, 1, kAtOnce,
               both(toy::is(family.called, 0), toy::is(status, 3)),
               {toy::assign(status, 4), toy::assign(family.called, 1)});
  }
};

TEST_CASE("asking a child to stop goes round only if the child may go on") {
  Halting stops;
  stops.family.draft.edge(
      stops.family.child, 1, 0, kAtOnce, toy::is(stops.family.called, 1),
      {toy::assign(stops.status, 2), toy::assign(stops.family.called, 0)});
  CHECK(heads(stops.family.draft.finish(), stops.family.parent) == 0);
  Halting goes_on;
  goes_on.family.draft.edge(
      goes_on.family.child, 1, 0, kAtOnce, toy::is(goes_on.family.called, 1),
      {toy::assign(goes_on.status, 3), toy::assign(goes_on.family.called, 0)});
  CHECK(heads(goes_on.family.draft.finish(), goes_on.family.parent) == 1);
}

}  // namespace
}  // namespace btcheck::own_cycles_test
