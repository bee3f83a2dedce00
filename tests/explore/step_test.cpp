// SPDX-License-Identifier: MIT
//
// The successor function on networks made by hand: intervals, urgency, timers,
// faults, and what happens when nothing can happen.
#include "explore/state/step.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "explore/reduce/labels.hpp"
#include "explore/toy.hpp"

namespace btcheck::step_test {
namespace {

using Names = std::vector<std::string>;

// A network walked by hand. Steps are called "a: x -> y", "time" and "idle"; a
// free move ends in "(free)".
class Walk {
 public:
  explicit Walk(Network network)
      : network_(std::move(network)), system_(network_) {
    system_.initial_states(
        [&](StateView state) { state_.assign(state.begin(), state.end()); });
  }

  Names options() const {
    Names names;
    for (const auto& [name, target] : targets()) names.push_back(name);
    return names;
  }
  void take(const std::string& name) {
    const auto known = targets();
    const auto found = known.find(name);
    INFO(name);
    REQUIRE(found != known.end());
    state_ = found->second;
  }

  int value(VariableId variable) const {
    return static_cast<int>(system_.value(state_, variable));
  }
  int clock(AutomatonId automaton) const {
    return static_cast<int>(system_.clock(state_, automaton));
  }
  Enabled enabled() const { return system_.enabled(state_); }
  const CompiledNetwork& system() const { return system_; }
  const StateVector& state() const { return state_; }

 private:
  std::multimap<std::string, StateVector> targets() const {
    std::multimap<std::string, StateVector> all;
    system_.successors(state_, [&](StateView target, Step step) {
      StateVector next(target.begin(), target.end());
      all.emplace(name_of(step, next), next);
    });
    return all;
  }
  std::string name_of(Step step, const StateVector& target) const {
    if (step.edge == kTimeStep) {
      CHECK(step == kIdleStep);
      return target == state_ ? "idle" : "time";
    }
    CHECK(step.elapsed == 0);
    const Automaton& owner = network_.owner_of_edge(step.edge);
    const Edge& edge = network_.edge(step.edge);
    return owner.name + ": " + owner.source(edge).name + " -> " +
           owner.target(edge).name + (step.progress ? "" : " (free)");
  }

  Network network_;
  CompiledNetwork system_;
  StateVector state_;
};

TEST_CASE("an edge fires within its interval, and time waits for no more") {
  toy::Draft draft;
  const VariableId x = draft.variable("x", 0, 5);
  const AutomatonId a =
      draft.automaton(AutomatonKind::Node, "a", {"idle", "busy", "done"});
  draft.edge(a, 0, 1, {1, 2});
  draft.edge(a, 1, 2, kAtOnce, {}, {toy::assign(x, 3)});
  draft.edge(a, 2, 0, kAnyTime);
  Walk walk(draft.finish());
  CHECK(walk.options() == Names{"time"});
  walk.take("time");
  CHECK(walk.clock(a) == 1);
  CHECK(walk.options() == Names{"a: idle -> busy", "time"});
  walk.take("time");
  CHECK(walk.options() == Names{"a: idle -> busy"});
  walk.take("a: idle -> busy");
  CHECK(walk.clock(a) == 0);
  CHECK(walk.options() == Names{"a: busy -> done"});
  walk.take("a: busy -> done");
  CHECK(walk.value(x) == 3);
  CHECK(walk.value(draft.location(a)) == 2);
  CHECK(walk.options() == Names{"a: done -> idle", "idle"});
  walk.take("idle");
  CHECK(walk.clock(a) == 0);
}

TEST_CASE("a clock without an upper bound stops counting at the lower") {
  toy::Draft draft;
  const AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"x", "y"});
  draft.edge(a, 0, 1, {2, kUnbounded});
  Walk walk(draft.finish());
  walk.take("time");
  CHECK(walk.options() == Names{"time"});
  walk.take("time");
  CHECK(walk.clock(a) == 2);
  CHECK(walk.options() == Names{"a: x -> y", "idle"});
  walk.take("idle");
  CHECK(walk.clock(a) == 2);
}

TEST_CASE("time waits for an urgent edge of any automaton") {
  toy::Draft draft;
  const VariableId go = draft.variable("go", 0, 1);
  const AutomatonId slow =
      draft.automaton(AutomatonKind::Node, "slow", {"x", "y"});
  draft.edge(slow, 0, 1, {1, 1}, {}, {toy::assign(go, 1)});
  const AutomatonId fast =
      draft.automaton(AutomatonKind::Node, "fast", {"x", "y"});
  draft.edge(fast, 0, 1, kAtOnce, toy::is(go, 1));
  Walk walk(draft.finish());
  CHECK(walk.options() == Names{"time"});
  walk.take("time");
  CHECK(walk.options() == Names{"slow: x -> y"});
  walk.take("slow: x -> y");
  CHECK(walk.options() == Names{"fast: x -> y"});
  walk.take("fast: x -> y");
  CHECK(walk.options() == Names{"idle"});
  CHECK(!walk.enabled().any);
}

TEST_CASE("all clocks advance together") {
  toy::Draft draft;
  const AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"x"});
  const AutomatonId b = draft.automaton(AutomatonKind::Node, "b", {"x", "y"});
  draft.edge(a, 0, 0, {3, 3});
  draft.edge(b, 0, 1, {2, 2});
  Walk walk(draft.finish());
  walk.take("time");
  walk.take("time");
  CHECK(walk.options() == Names{"b: x -> y"});
  walk.take("b: x -> y");
  CHECK(walk.clock(a) == 2);
  CHECK(walk.clock(b) == 0);
  walk.take("time");
  CHECK(walk.clock(b) == 0);
  CHECK(walk.options() == Names{"a: x -> x"});
  walk.take("a: x -> x");
  CHECK(walk.clock(a) == 0);
}

// A node that ticks every unit, and two timers of one and [0,2] units.
struct Timed {
  Timed() {
    node = draft.automaton(AutomatonKind::Node, "n", {"tick"});
    draft.edge(node, 0, 0, {1, 1}, {}, {toy::assign(ticked, 1)});
    one = draft.automaton(AutomatonKind::Timer, "one",
                          {"counting", "due", "idle"});
    draft.edge(one, 0, 1, {1, 1});
    two = draft.automaton(AutomatonKind::Timer, "two", {"counting", "due"});
    draft.edge(two, 0, 1, {0, 2});
  }

  toy::Draft draft;
  VariableId ticked = draft.variable("ticked", 0, 1);
  AutomatonId node, one, two;
};

TEST_CASE("a timer that is due goes before everything else") {
  Timed timed;
  Walk walk(timed.draft.finish());
  CHECK(walk.options() == Names{"time", "two: counting -> due"});
  walk.take("time");
  CHECK(walk.options() == Names{"one: counting -> due"});
  walk.take("one: counting -> due");
  CHECK(walk.options() == Names{"n: tick -> tick", "two: counting -> due"});
  walk.take("n: tick -> tick");
  walk.take("time");
  CHECK(walk.options() == Names{"two: counting -> due"});
  walk.take("two: counting -> due");
  CHECK(walk.options() == Names{"n: tick -> tick"});
}

TEST_CASE("timers that are due together go in any order") {
  toy::Draft draft;
  for (const char* name : {"a", "b"}) {
    const AutomatonId timer =
        draft.automaton(AutomatonKind::Timer, name, {"counting", "due"});
    draft.edge(timer, 0, 1, {2, 2});
  }
  Walk walk(draft.finish());
  walk.take("time");
  walk.take("time");
  CHECK(walk.options() == Names{"a: counting -> due", "b: counting -> due"});
  walk.take("b: counting -> due");
  CHECK(walk.options() == Names{"a: counting -> due"});
}

TEST_CASE("who assigns a timer's location resets its clock") {
  toy::Draft draft;
  const AutomatonId node =
      draft.automaton(AutomatonKind::Node, "n", {"x", "y", "z"});
  const AutomatonId timer =
      draft.automaton(AutomatonKind::Timer, "t", {"counting", "due"});
  draft.edge(node, 0, 1, kAnyTime, {}, {toy::assign(draft.location(timer), 0)});
  draft.edge(node, 1, 2, kAnyTime);
  draft.edge(timer, 0, 1, {2, 2});
  Walk walk(draft.finish());
  walk.take("time");
  CHECK(walk.clock(timer) == 1);
  walk.take("n: x -> y");
  CHECK(walk.clock(timer) == 0);
  walk.take("time");
  walk.take("n: y -> z");
  CHECK(walk.clock(timer) == 1);
  walk.take("time");
  CHECK(walk.options() == Names{"t: counting -> due"});
}

TEST_CASE("after a fault only time passes") {
  toy::Draft draft;
  const VariableId fault = draft.variable("fault", 0, 1);
  const AutomatonId a =
      draft.automaton(AutomatonKind::Node, "a", {"x", "error"});
  draft.edge(a, 0, 1, kAtOnce, {}, {toy::assign(fault, 1)});
  draft.edge(a, 1, 0, kAtOnce);
  const AutomatonId timer =
      draft.automaton(AutomatonKind::Timer, "t", {"counting", "due"});
  draft.edge(timer, 0, 1, {1, 1});
  draft.set_fault(fault);
  Walk walk(draft.finish());
  CHECK(walk.options() == Names{"a: x -> error"});
  walk.take("a: x -> error");
  CHECK(walk.options() == Names{"idle"});
  CHECK(!walk.enabled().any);
  CHECK(!walk.enabled().tree);
}

TEST_CASE("under none time passes only where no edge of the tree is enabled") {
  toy::Draft draft;
  const AutomatonId weather =
      draft.automaton(AutomatonKind::StateVariable, "w", {"calm", "storm"});
  draft.edge(weather, 0, 1, kAnyTime);
  draft.edge(weather, 1, 0, kAnyTime);
  const AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"x", "y"});
  draft.edge(a, 0, 1, kAnyTime, toy::is(draft.location(weather), 1));
  draft.set_ticks(TickSemantics::None);
  Walk walk(draft.finish());
  CHECK(walk.options() == Names{"idle", "w: calm -> storm (free)"});
  CHECK(walk.enabled().any);
  CHECK(!walk.enabled().tree);
  walk.take("w: calm -> storm (free)");
  CHECK(walk.options() == Names{"a: x -> y", "w: storm -> calm (free)"});
  CHECK(walk.enabled().tree);
  walk.take("a: x -> y");
  CHECK(walk.options() == Names{"idle", "w: storm -> calm (free)"});
}

TEST_CASE("free moves are no progress, and hold up no time") {
  toy::Draft draft;
  const AutomatonId weather =
      draft.automaton(AutomatonKind::StateVariable, "w", {"calm", "storm"});
  draft.edge(weather, 0, 1, kAnyTime);
  const AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"x", "y"});
  draft.edge(a, 0, 1, {1, 1});
  Walk walk(draft.finish());
  CHECK(walk.system().has_free_moves());
  CHECK(walk.options() == Names{"time", "w: calm -> storm (free)"});
  walk.take("time");
  CHECK(walk.options() == Names{"a: x -> y", "w: calm -> storm (free)"});

  toy::Draft sampled;
  sampled.automaton(AutomatonKind::StateVariable, "w", {"calm", "storm"});
  const Network network = sampled.finish();
  CHECK(!CompiledNetwork(network).has_free_moves());
}

TEST_CASE("an automaton moves only while its gate is open") {
  toy::Draft draft;
  const VariableId gate =
      draft.variable("caller", 0, 1, 0, VariableRole::Caller);
  const AutomatonId a =
      draft.automaton(AutomatonKind::Node, "a", {"x", "y"}, gate);
  draft.edge(a, 0, 1, kAtOnce, {}, {toy::assign(gate, 0)});
  draft.edge(a, 1, 0, kAtOnce);
  const AutomatonId parent =
      draft.automaton(AutomatonKind::Node, "p", {"x", "y"});
  draft.edge(parent, 0, 1, kAtOnce, {}, {toy::assign(gate, 1)});
  Walk walk(draft.finish());
  CHECK(walk.options() == Names{"p: x -> y"});
  walk.take("p: x -> y");
  CHECK(walk.options() == Names{"a: x -> y"});
  walk.take("a: x -> y");
  CHECK(walk.options() == Names{"idle"});
}

TEST_CASE("assignments are executed in order, each seeing those before it") {
  toy::Draft draft;
  const VariableId x = draft.variable("x", 0, 9, 2);
  const VariableId y = draft.variable("y", 0, 9, 5);
  const VariableId z = draft.variable("z", 0, 9, 7);
  const auto sum =
      Expression::binary(Operation::Add, toy::variable(x), toy::variable(y));
  const AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"p", "q"});
  draft.edge(a, 0, 1, kAtOnce, toy::is(x, 2),
             {toy::assign(x, 1),
              {z, sum},
              {y, toy::variable(x)},
              toy::assign(x, 4),
              toy::assign(x, 3),
              {x, Expression::binary(Operation::Add, toy::variable(x),
                                     toy::variable(z))}});
  Walk walk(draft.finish());
  walk.take("a: p -> q");
  CHECK(walk.value(z) == 6);
  CHECK(walk.value(y) == 1);
  CHECK(walk.value(x) == 9);
}

TEST_CASE("a guard sees the state before the step, not halfway through it") {
  toy::Draft draft;
  const VariableId x = draft.variable("x", 0, 1);
  const AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"p", "q"});
  draft.edge(a, 0, 1, kAtOnce, {}, {toy::assign(x, 1)});
  const AutomatonId b = draft.automaton(AutomatonKind::Node, "b", {"p", "q"});
  draft.edge(b, 0, 1, kAtOnce, toy::is(x, 1));
  draft.edge(b, 0, 1, kAtOnce, toy::is(x, 0));
  Walk walk(draft.finish());
  CHECK(walk.options() == Names{"a: p -> q", "b: p -> q"});
  walk.take("b: p -> q");
  CHECK(walk.value(x) == 0);
}

TEST_CASE("a marking is a state without its clocks") {
  Timed timed;
  Walk walk(timed.draft.finish());
  const StateVector start = walk.state();
  walk.take("time");
  CHECK(walk.state() != start);
  StateVector marking = walk.state();
  walk.system().clear_clocks(marking);
  CHECK(marking == start);
}

TEST_CASE("labels know a dead state, and what holds in it") {
  toy::Draft draft;
  const AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"p", "q"});
  draft.edge(a, 0, 1, {1, 1});
  const Network network = draft.finish();
  const CompiledNetwork system(network);
  const Expression in_q = toy::is(draft.location(a), 1);
  const std::vector<StatePredicate> predicates = {
      {in_q, {}},
      {Expression::constant(0), Expression::constant(1)},
      {in_q, Expression::constant(0)},
      {{}, {}}};
  const LabelledNetwork labels(system, predicates);
  StateVector state = system.layout().initial(network);
  CHECK(labels.label(state) == 0b1000);
  const Field& location = system.layout().fields[index(draft.location(a))];
  location.put(state.data(), 1);
  CHECK(labels.label(state) == 0b1011);
  CHECK(labels.holds(2, state, false));
  CHECK(!labels.holds(2, state, true));
}

}  // namespace
}  // namespace btcheck::step_test
