// SPDX-License-Identifier: MIT
//
// Factors against counting with sets, and that they name who is to blame.
#include "check/space/contribution.hpp"

#include <doctest/doctest.h>

#include <set>
#include <vector>

#include "check/checked.hpp"
#include "check/replay/replay.hpp"

namespace btcheck::contribution_test {
namespace {

// All states, unpacked by hand: breadth first on the tables.
std::vector<Valuation> all_states(const Network& network) {
  const NetworkInterpreter interpreter(network);
  std::vector<Valuation> states{interpreter.initial()};
  std::set<std::pair<std::vector<int>, std::vector<int>>> seen{
      {states[0].variables, states[0].clocks}};
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (std::uint32_t e = 0; e <= network.edge_count(); ++e) {
      const std::uint32_t edge = e == network.edge_count() ? kTimeStep : e;
      const auto next = interpreter.taken(states[i], {edge, 0, true});
      if (next && seen.insert({next->variables, next->clocks}).second) {
        states.push_back(*next);
      }
    }
  }
  return states;
}

// How many states there are for each that differs in more than the variable.
double factor_of(const std::vector<Valuation>& states, VariableId variable) {
  std::set<std::pair<std::vector<int>, std::vector<int>>> rest;
  for (Valuation state : states) {
    state.variables[index(variable)] = 0;
    rest.insert({state.variables, state.clocks});
  }
  return static_cast<double>(states.size()) / static_cast<double>(rest.size());
}

TEST_CASE("a variable multiplies the states as often as sets say") {
  const Lowered model(
      "((defsv door :states (open shut) :init open :transitions :all)"
      " (defsv floor :init 0 :min 0 :max 5)"
      " (BehaviorTree :name t (Sequence (SetSV :ID look :sv floor)"
      " (Eval (= door open)) (Action :ID go))))");
  const auto states = all_states(model.network);
  REQUIRE(states.size() > 100);
  int variables = 0;
  for (const Contribution& part : measure_contributions(model.network, {})) {
    CHECK(part.factor >= 1);
    if (!part.variable) continue;
    ++variables;
    const double exact =
        factor_of(states, model.network.state_variable[index(*part.variable)]);
    CHECK(part.factor == doctest::Approx(exact).epsilon(0.05));
  }
  CHECK(variables == 2);
}

TEST_CASE("parts come with the largest factor first, and not from a cut") {
  const Lowered model(example("drone1.btf"));
  const auto parts = measure_contributions(model.network, {});
  REQUIRE(parts.size() == model.tree.nodes.size());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    CHECK(parts[i - 1].factor >= parts[i].factor);
  }
  CHECK(measure_contributions(model.network, {.max_states = 100}).empty());
}

}  // namespace
}  // namespace btcheck::contribution_test
