// SPDX-License-Identifier: MIT
//
// Chains of steps and the states between them, on networks made by hand.
#include "explore/reduce/reduced_network.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "explore/lowered.hpp"

namespace btcheck::reduced_network_test {
namespace {

// A network with its ample sets, and what follows from its states.
class Reduced {
 public:
  struct Next {
    StateVector state;
    Step step;
  };

  Reduced(const Network& network, const Observed& observed)
      : network_(network),
        system_(network_),
        ample_(network_, observed),
        reduced_(system_, ample_) {}
  explicit Reduced(const Network& network)
      : Reduced(network, Observed(network)) {}
  Reduced(const Reduced&) = delete;
  Reduced& operator=(const Reduced&) = delete;

  const CompiledNetwork& system() const { return system_; }
  const ReducedNetwork& reduced() const { return reduced_; }
  StateVector initial() const {
    StateVector first;
    reduced_.initial_states(
        [&](StateView state) { first.assign(state.begin(), state.end()); });
    return first;
  }
  std::vector<Next> next(const StateVector& state) const {
    std::vector<Next> found;
    reduced_.successors(state, [&](StateView target, Step step) {
      found.push_back({{target.begin(), target.end()}, step});
    });
    return found;
  }
  std::size_t states() const {
    std::set<StateVector> seen{initial()};
    std::vector<StateVector> open{initial()};
    while (!open.empty()) {
      const StateVector here = open.back();
      open.pop_back();
      for (const Next& each : next(here)) {
        if (seen.insert(each.state).second) open.push_back(each.state);
      }
    }
    return seen.size();
  }

 private:
  Network network_;
  CompiledNetwork system_;
  AmpleSets ample_;
  ReducedNetwork reduced_;
};

using Edges = std::vector<std::uint32_t>;

Edges edges_of(const std::vector<RunState>& steps) {
  Edges edges;
  for (const RunState& each : steps) edges.push_back(each.step.edge);
  return edges;
}

// Each step of the network leads from the state before to the next.
void check_steps(const CompiledNetwork& system, StateVector from,
                 const std::vector<RunState>& steps) {
  for (const RunState& each : steps) {
    bool is_found = false;
    system.successors(from, [&](StateView target, Step step) {
      is_found = is_found ||
                 (step == each.step &&
                  std::equal(target.begin(), target.end(), each.state.begin()));
    });
    CHECK(is_found);
    from = each.state;
  }
}

TEST_CASE("a round in which nothing is chosen or seen is no idle step") {
  Family family;
  const Reduced toy(family.draft.finish());
  CHECK(toy.reduced().is_reduced());
  const auto next = toy.next(toy.initial());
  REQUIRE(next.size() == 1);
  CHECK(next[0].step == Step{kTimeStep, 1, true});
  CHECK(next[0].state != toy.initial());
  const auto back = toy.next(next[0].state);
  REQUIRE(back.size() == 1);
  CHECK(back[0].step.edge != kTimeStep);
  CHECK(back[0].state == toy.initial());
  CHECK(toy.states() == 2);
}

TEST_CASE("a chain is told in single steps, or up to one of them") {
  Family family;
  const Reduced toy(family.draft.finish());
  const StateVector start = toy.initial();
  const auto next = toy.next(start);
  const auto all =
      toy.reduced().single_steps(start, next.at(0).step, next.at(0).state);
  CHECK(edges_of(all) == Edges{kTimeStep, 0, 2, 3});
  check_steps(toy.system(), start, all);
  CHECK(all.back().state == next[0].state);
  const auto some = toy.reduced().steps_up_to(start, 2);
  CHECK(edges_of(some) == Edges{kTimeStep, 0, 2});
  check_steps(toy.system(), start, some);
}

TEST_CASE("passed is told of every step of a chain, in order") {
  Family family;
  const Reduced toy(family.draft.finish());
  Edges passed;
  StateVector at = toy.initial();
  toy.reduced().successors(
      toy.initial(), [&](StateView, Step) { CHECK(passed.size() == 4); },
      [&](StateView before, Step step, StateView after) {
        CHECK(StateVector(before.begin(), before.end()) == at);
        at.assign(after.begin(), after.end());
        passed.push_back(step.edge);
      });
  CHECK(passed == Edges{kTimeStep, 0, 2, 3});
}

TEST_CASE("a chain ends before a step that is seen") {
  Family family;
  const Network network = family.draft.finish();
  Observed observed(network);
  observed.add(toy::is(family.draft.location(family.child), 1));
  const Reduced toy(network, observed);
  const auto called = toy.next(toy.initial());
  REQUIRE(called.size() == 1);
  CHECK(edges_of(toy.reduced().single_steps(toy.initial(), called[0].step,
                                            called[0].state)) ==
        Edges{kTimeStep, 0});
  const auto works = toy.next(called[0].state);
  REQUIRE(works.size() == 1);
  CHECK(works[0].step.edge == 2);
  CHECK(toy.system().value(works[0].state,
                           family.draft.location(family.child)) == 1);
  CHECK(toy.states() == 3);
}

TEST_CASE("a choice ends a chain, and each of its steps begins another") {
  Family family;
  family.draft.edge(family.child, 0, 1, kAtOnce, toy::is(family.called, 1));
  const Reduced toy(family.draft.finish());
  const auto called = toy.next(toy.initial());
  REQUIRE(called.size() == 1);
  const auto works = toy.next(called[0].state);
  REQUIRE(works.size() == 2);
  CHECK(works[0].state == toy.initial());
  CHECK(works[1].state == toy.initial());
  CHECK(works[0].step.edge == 2);
  CHECK(works[1].step.edge == 4);
  CHECK(edges_of(toy.reduced().steps_up_to(called[0].state, 4)) == Edges{4});
}

TEST_CASE("a lasso in single steps has the chain into its cycle in front") {
  Family family;
  const Reduced toy(family.draft.finish());
  const auto there = toy.next(toy.initial()).at(0);
  const auto back = toy.next(there.state).at(0);
  REQUIRE(back.state == toy.initial());
  Lasso lasso;
  lasso.prefix = {{toy.initial(), {}}};
  lasso.cycle = {{there.state, there.step}, {back.state, back.step}};
  lasso.closing = there.step;
  const Lasso told = in_single_steps(toy.reduced(), lasso);
  CHECK(told.prefix.size() == 4);
  CHECK(told.cycle.size() == 5);
  std::vector<RunState> steps(told.prefix.begin() + 1, told.prefix.end());
  steps.insert(steps.end(), told.cycle.begin(), told.cycle.end());
  steps.push_back({told.cycle.front().state, told.closing});
  check_steps(toy.system(), toy.initial(), steps);
  CHECK(edges_of(steps) == Edges{kTimeStep, 0, 2, 3, 1, kTimeStep, 0, 2, 3});
}

TEST_CASE("a finite run in single steps stays finite") {
  Family family;
  const Reduced toy(family.draft.finish());
  const auto next = toy.next(toy.initial());
  Lasso run;
  run.prefix = {{toy.initial(), {}}, {next.at(0).state, next.at(0).step}};
  const Lasso told = in_single_steps(toy.reduced(), run);
  CHECK(told.prefix.size() == 5);
  CHECK(told.cycle.empty());
  const ReducedNetwork whole(toy.system());
  CHECK(in_single_steps(whole, run).prefix.size() == 2);
}

// Two steps, and nothing more.
struct Ending {
  toy::Draft draft;
  AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"s", "t", "u"});
  VariableId x = draft.variable("x", 0, 1);
  Ending() {
    draft.edge(a, 0, 1);
    draft.edge(a, 1, 2);
  }
};

TEST_CASE("a dead state ends the chain, and is told apart when death is seen") {
  Ending ending;
  const Network network = ending.draft.finish();
  const VariableId place = ending.draft.location(ending.a);
  const Reduced blind(network);
  const auto last = blind.next(blind.initial());
  REQUIRE(last.size() == 1);
  CHECK(blind.system().value(last[0].state, place) == 2);
  Observed observed(network);
  observed.add(StatePredicate{toy::is(ending.x, 0), toy::is(ending.x, 1)});
  const Reduced seeing(network, observed);
  const auto first = seeing.next(seeing.initial());
  REQUIRE(first.size() == 1);
  CHECK(seeing.system().value(first[0].state, place) == 1);
  const auto second = seeing.next(first[0].state);
  REQUIRE(second.size() == 1);
  CHECK(seeing.system().value(second[0].state, place) == 2);
}

TEST_CASE("without ample sets every step of the network is one") {
  Family family;
  const Network network = family.draft.finish();
  Observed observed(network);
  observed.add_steps();
  const Reduced toy(network, observed);
  CHECK(!toy.reduced().is_reduced());
  CHECK(toy.states() == 5);
}

// `a` writes x; `b` does something else, reads x, and is done.
struct Contest {
  toy::Draft draft;
  VariableId x = draft.variable("x", 0, 1);
  AutomatonId a = draft.automaton(AutomatonKind::Node, "a", {"s", "t"});
  AutomatonId b = draft.automaton(AutomatonKind::Node, "b", {"s", "t", "u"});
  Contest() {
    draft.edge(a, 0, 1, kAtOnce, {}, {toy::assign(x, 1)});
    draft.edge(b, 0, 1);
    draft.edge(b, 1, 2, kAtOnce, toy::is(x, 0));
    draft.edge(b, 1, 2, kAtOnce, toy::is(x, 1));
  }
};

TEST_CASE("what is shared is explored only while the rival is a danger") {
  Contest contest;
  const Reduced toy(contest.draft.finish());
  const VariableId place = contest.draft.location(contest.b);
  // In the first state b moves alone: what it does first concerns nobody.
  const auto first = toy.next(toy.initial());
  REQUIRE(first.size() == 1);
  CHECK(first[0].step.edge == 1);
  CHECK(toy.system().value(first[0].state, place) == 1);
  // Now each of the two may be first; then the other goes on alone.
  const auto second = toy.next(first[0].state);
  REQUIRE(second.size() == 2);
  CHECK(edges_of(toy.reduced().single_steps(first[0].state, second[0].step,
                                            second[0].state)) == Edges{0, 3});
  CHECK(edges_of(toy.reduced().single_steps(first[0].state, second[1].step,
                                            second[1].state)) == Edges{2, 0});
  CHECK(second[0].state == second[1].state);
}

}  // namespace
}  // namespace btcheck::reduced_network_test
