// SPDX-License-Identifier: MIT
//
// Who calls whom, and what breaks the protocol of calling.
#include "explore/reduce/call_protocol.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "explore/lowered.hpp"

namespace btcheck::call_protocol_test {
namespace {

TEST_CASE("a parent that waits for its child keeps the protocol") {
  Family family;
  const CallProtocol protocol(family.draft.finish());
  CHECK(protocol.holds());
  CHECK(protocol.gated(family.called) == family.child);
  CHECK(protocol.gated(family.draft.location(family.child)) == std::nullopt);
  CHECK(protocol.parent(family.child) == family.parent);
  CHECK(protocol.parent(family.parent) == std::nullopt);
  CHECK(protocol.waits_for(family.child) ==
        std::vector<LocationId>{LocationId{1}});
  CHECK(protocol.is_line(family.child, family.parent));
  CHECK(protocol.is_line(family.parent, family.child));
  CHECK(protocol.is_line(family.child, family.child));
}

TEST_CASE("a turn ends on the way back to the first location, a root's never") {
  Family family;
  const Network network = family.draft.finish();
  const auto ends = [&](AutomatonId id, std::uint32_t from, std::uint32_t to) {
    Edge edge;
    edge.source = LocationId{from};
    edge.target = LocationId{to};
    return ends_turn(network.automaton(id), edge);
  };
  CHECK(ends(family.child, 1, 0));
  CHECK(ends(family.child, 0, 0));
  CHECK(!ends(family.child, 0, 1));
  CHECK(!ends(family.parent, 1, 0));
}

TEST_CASE("a second caller breaks the protocol") {
  Family family;
  const AutomatonId other =
      family.draft.automaton(AutomatonKind::Node, "other", {"start", "wait"});
  family.draft.edge(other, 0, 1, kAtOnce, {}, {toy::assign(family.called, 1)});
  family.draft.edge(other, 1, 0, kAtOnce, toy::is(family.called, 0));
  CHECK(!CallProtocol(family.draft.finish()).holds());
}

TEST_CASE("an edge that leaves a waiting location early breaks the protocol") {
  Family without_guard;
  without_guard.draft.edge(without_guard.parent, 1, 0);
  CHECK(!CallProtocol(without_guard.draft.finish()).holds());
  Family too_early;
  too_early.draft.edge(too_early.parent, 1, 0, kAtOnce,
                       toy::is(too_early.called, 1));
  CHECK(!CallProtocol(too_early.draft.finish()).holds());
}

TEST_CASE("a child that goes on after giving control back breaks it") {
  Family family;
  family.draft.edge(family.child, 0, 1, kAtOnce, toy::is(family.called, 1),
                    {toy::assign(family.called, 0)});
  CHECK(!CallProtocol(family.draft.finish()).holds());
}

TEST_CASE("a child that calls itself breaks the protocol") {
  Family family;
  family.draft.edge(family.child, 1, 0, kAtOnce, toy::is(family.called, 1),
                    {toy::assign(family.called, 1)});
  CHECK(!CallProtocol(family.draft.finish()).holds());
}

TEST_CASE("the protocol of a lowered tree is the tree") {
  const Network network = lowered(
      "((BehaviorTree :name t (Parallel :name p :halt 1 :success 1"
      " (Sequence :name s (Action :ID a) (Condition :ID c))"
      " (Action :ID b))))");
  const CallProtocol protocol(network);
  REQUIRE(protocol.holds());
  const AutomatonId p = automaton_of(network, "p");
  const AutomatonId s = automaton_of(network, "s");
  const AutomatonId a = automaton_of(network, "a");
  const AutomatonId b = automaton_of(network, "b");
  CHECK(protocol.parent(a) == s);
  CHECK(protocol.parent(s) == p);
  CHECK(protocol.parent(b) == p);
  CHECK(protocol.parent(p) == automaton_of(network, "t"));
  CHECK(protocol.is_line(a, p));
  CHECK(!protocol.is_line(a, b));
  CHECK(!protocol.is_line(s, b));
  const auto waiting = [&](std::string_view word) {
    const auto& waits = protocol.waits_for(b);
    return std::find(waits.begin(), waits.end(),
                     location_of(network, p, word)) != waits.end();
  };
  CHECK(waiting("children_done"));
  CHECK(waiting("halt_wait"));
  CHECK(!waiting("counting"));
}

TEST_CASE("every node type keeps the protocol under every tick semantics") {
  for (const std::string type :
       {"Sequence", "Fallback", "SequenceWithMemory", "RoundRobin",
        "ReactiveSequence :halt 1", "ReactiveFallback :wait 1",
        "Parallel :success 1 :halt 1", "ParallelAll :wait 1",
        "PipelineSequence", "Recovery :num_retries 2"}) {
    CAPTURE(type);
    for (const TickSemantics ticks :
         {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
          TickSemantics::None}) {
      const Network network =
          lowered("((BehaviorTree :name t (" + type +
                      " (Action :ID a :duration [1,2])"
                      " (Repeat :repeat 2 (RateController :hz 5"
                      " (Action :ID b))))))",
                  ticks);
      CHECK(CallProtocol(network).holds());
    }
  }
}

}  // namespace
}  // namespace btcheck::call_protocol_test
