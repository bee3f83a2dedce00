// SPDX-License-Identifier: MIT
//
// Rules of ample sets, read off small trees and networks made by hand: who has
// none, when edges are due, who is a rival and where, and what is visible.
#include "explore/reduce/ample_sets.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "explore/lowered.hpp"
#include "explore/reduce/call_protocol.hpp"

namespace btcheck::ample_sets_test {
namespace {

AmpleSets sets_of(const Network& network) {
  return AmpleSets(network, Observed(network));
}

const AmpleSets::Rule& rule_at(const AmpleSets& sets, const Network& network,
                               std::string_view node, std::string_view word) {
  const AutomatonId automaton = automaton_of(network, node);
  return sets.rule(automaton, location_of(network, automaton, word));
}

// The weather is asked, then something is done.
Network outing(const std::string& moves) {
  return lowered("((defsv w :states (Dry Wet) :init Dry :moves " + moves +
                 " :transitions :all) (BehaviorTree :name t (Sequence"
                 " :name s (Eval :name e (= w Dry)) (Action :ID a))))");
}

TEST_CASE("a location that touches a free variable has no rule") {
  const Network free = outing("free");
  const AmpleSets sets = sets_of(free);
  CHECK(!rule_at(sets, free, "e", "tick_node").may_be_ample);
  CHECK(rule_at(sets, free, "e", "success").may_be_ample);
  CHECK(rule_at(sets, free, "a", "tick_node").may_be_ample);
  const Network sampled = outing("sampled");
  CHECK(rule_at(sets_of(sampled), sampled, "e", "tick_node").may_be_ample);
}

TEST_CASE("free variables and timers never have a rule") {
  const Network network = lowered(
      "((defsv w :states (Dry Wet) :init Dry :transitions :all)"
      " (BehaviorTree :name t (Action :ID a :duration 2)))");
  const AmpleSets sets = sets_of(network);
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (network.automata[a].kind == AutomatonKind::Node) continue;
    for (std::uint32_t l = 0; l < network.automata[a].locations.size(); ++l) {
      CHECK(!sets.rule(AutomatonId{a}, LocationId{l}).may_be_ample);
    }
  }
}

TEST_CASE("a rule waits for the clock at which all its edges are due") {
  const Network network = lowered("((BehaviorTree :name t (Action :ID a)))");
  const AmpleSets sets = sets_of(network);
  CHECK(rule_at(sets, network, "t", "tick_node").may_be_ample);
  CHECK(rule_at(sets, network, "t", "tick_node").due == 1);
  CHECK(rule_at(sets, network, "a", "tick_node").due == 0);
  Family loose;
  loose.draft.edge(loose.parent, 0, 0, {1, 2});
  CHECK(!sets_of(loose.draft.finish())
             .rule(loose.parent, LocationId{0})
             .may_be_ample);
}

TEST_CASE("an edge that fails has no rule") {
  const Network network = lowered(
      "((defsv x :init 0 :min 0 :max 1) (BehaviorTree :name t"
      " (Eval :name e (:= x (+ x 1)))))");
  REQUIRE(network.fault);
  CHECK(!rule_at(sets_of(network), network, "e", "tick_node").may_be_ample);
}

TEST_CASE("a timer of one length is no obstacle to its node, any other is") {
  for (const bool is_fixed : {true, false}) {
    CAPTURE(is_fixed);
    const std::string length = is_fixed ? "[2,2]" : "[1,2]";
    const std::string tree =
        "((BehaviorTree :name t (Action :ID a :duration " + length + ")))";
    const Network timed = lowered(tree);
    CHECK(rule_at(sets_of(timed), timed, "a", "look").may_be_ample == is_fixed);
    const Network untimed = lowered(tree, TickSemantics::None);
    CHECK(!rule_at(sets_of(untimed), untimed, "a", "look").may_be_ample);
  }
}

TEST_CASE("where an automaton goes round one location has no rule") {
  const Network network = lowered(
      "((BehaviorTree :name t (Repeat :name r :repeat 3 (Action :ID a))))");
  const AutomatonId repeat = automaton_of(network, "r");
  const auto heads = cycle_heads(network, CallProtocol(network), repeat);
  REQUIRE(!heads.empty());
  const AmpleSets sets = sets_of(network);
  for (const LocationId head : heads) {
    CHECK(!sets.rule(repeat, head).may_be_ample);
  }
  CHECK(rule_at(sets, network, "r", "success").may_be_ample);
}

TEST_CASE("who sees steps, or breaks the protocol, gets no rule at all") {
  const Network network = outing("sampled");
  Observed observed(network);
  CHECK(!AmpleSets(network, observed).empty());
  observed.add_steps();
  CHECK(AmpleSets(network, observed).empty());
  Family broken;
  CHECK(!sets_of(broken.draft.finish()).empty());
  broken.draft.edge(broken.parent, 1, 0);
  CHECK(sets_of(broken.draft.finish()).empty());
}

// Two trees that share x: `a` writes it once; `b` first does something else,
// then reads it, and is done.
struct Rivals {
  toy::Draft draft;
  VariableId x = draft.variable("x", 0, 1);
  AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"s", "t"});
  AutomatonId b = draft.automaton(AutomatonKind::Node, "b", {"s", "t", "u"});

  explicit Rivals(Interval first = kAtOnce) {
    draft.edge(a, 0, 1, kAtOnce, {}, {toy::assign(x, 1)});
    draft.edge(b, 0, 1, first);
    draft.edge(b, 1, 2, kAtOnce, toy::is(x, 1));
  }
  std::vector<bool> dangers() {
    const AmpleSets sets = sets_of(draft.finish());
    const AmpleSets::Rule& rule = sets.rule(a, LocationId{0});
    CHECK(rule.may_be_ample);
    REQUIRE(rule.rivals.size() == 1);
    CHECK(rule.rivals[0].automaton == b);
    return rule.rivals[0].dangerous;
  }
};

TEST_CASE("a rival is a danger where it may come to what is shared") {
  CHECK(Rivals().dangers() == std::vector<bool>{true, true, false});
  Rivals rivals;
  const AmpleSets sets = sets_of(rivals.draft.finish());
  CHECK(sets.rule(rivals.b, LocationId{0}).rivals.empty());
  REQUIRE(sets.rule(rivals.b, LocationId{1}).rivals.size() == 1);
  CHECK(sets.rule(rivals.b, LocationId{1}).rivals[0].dangerous ==
        std::vector<bool>{true, false});
}

TEST_CASE("a rival that must wait before is a danger only where it waits") {
  Rivals rivals({1, 1});
  const AutomatonId b = rivals.b;
  rivals.draft.edge(b, 2, 0);
  // From u it comes to s, and there time has to pass.
  CHECK(rivals.dangers() == std::vector<bool>{true, true, false});
}

TEST_CASE("children of a Parallel that write the same are rivals") {
  const Network network = lowered(
      "((defsv x :init 0 :min 0 :max 1) (BehaviorTree :name t"
      " (ParallelAll :name p (Eval :name e (:= x 1))"
      " (Sequence :name s (Action :ID a :SF) (Eval :name f (= x 0))))))");
  const AmpleSets sets = sets_of(network);
  const auto& rule = rule_at(sets, network, "e", "tick_node");
  CHECK(rule.may_be_ample);
  // The other one, and the Sequence, which may call it; not the Parallel.
  std::vector<AutomatonId> rivals;
  for (const auto& rival : rule.rivals) rivals.push_back(rival.automaton);
  CHECK(rivals == std::vector<AutomatonId>{automaton_of(network, "f"),
                                           automaton_of(network, "s")});
  const AutomatonId sequence = automaton_of(network, "s");
  const auto& dangerous = rule.rivals[1].dangerous;
  const auto is_danger = [&](std::string_view word) {
    return static_cast<bool>(
        dangerous[index(location_of(network, sequence, word))]);
  };
  CHECK(is_danger("tick_node"));
  CHECK(!is_danger("success"));
  CHECK(!is_danger("done"));
  CHECK(rule_at(sets, network, "a", "tick_node").rivals.empty());
}

TEST_CASE("an edge is visible when a question tells what it changes apart") {
  const Network network = outing("sampled");
  const Automaton& eval = network.automaton(automaton_of(network, "e"));
  const int success = static_cast<int>(
      index(location_of(network, automaton_of(network, "e"), "success")));
  Observed observed(network);
  observed.add(toy::is(eval.location, success));
  const AmpleSets sets(network, observed);
  for (std::uint32_t e = 0; e < network.edge_count(); ++e) {
    const Edge& edge = network.edge(e);
    const bool touches = &network.owner_of_edge(e) == &eval &&
                         (static_cast<int>(index(edge.source)) == success ||
                          static_cast<int>(index(edge.target)) == success);
    CHECK(sets.is_visible(e) == touches);
  }
}

TEST_CASE("an assignment is visible where the value before it may differ") {
  toy::Draft draft;
  const VariableId x = draft.variable("x", 0, 3);
  const AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"s", "t"});
  draft.edge(a, 0, 1, kAtOnce, {}, {toy::assign(x, 2)});
  draft.edge(a, 0, 1, kAtOnce, {}, {toy::assign(x, 1)});
  draft.edge(a, 0, 1, kAtOnce, toy::is(x, 0), {toy::assign(x, 1)});
  draft.edge(a, 0, 1, kAtOnce, toy::is(x, 2), {toy::assign(x, 1)});
  draft.edge(a, 0, 1, kAtOnce, toy::is(x, 0), {{x, toy::variable(x)}});
  draft.edge(a, 0, 1);
  const Network network = draft.finish();
  Observed observed(network);
  observed.add(toy::is(x, 2));
  const AmpleSets sets(network, observed);
  CHECK(sets.is_visible(0));
  CHECK(sets.is_visible(1));
  CHECK(!sets.is_visible(2));
  CHECK(sets.is_visible(3));
  CHECK(sets.is_visible(4));
  CHECK(!sets.is_visible(5));
}

TEST_CASE("after a call the child moves, after its turn the parent") {
  Family family;
  const AmpleSets sets = sets_of(family.draft.finish());
  CHECK(sets.next_mover(0) == family.child);
  CHECK(sets.next_mover(1) == family.parent);
  CHECK(sets.next_mover(2) == family.child);
  CHECK(sets.next_mover(3) == family.parent);
}

}  // namespace
}  // namespace btcheck::ample_sets_test
