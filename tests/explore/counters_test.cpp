// SPDX-License-Identifier: MIT
#include "explore/reduce/counters.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>

#include "explore/lowered.hpp"

namespace btcheck::counters_test {
namespace {

constexpr NodeId kCounting{1};  // below the root

Network retrying(int attempts) {
  return lowered(
      fmt::format("(BehaviorTree :name t (RetryUntilSuccessful :name r"
                  " :num_attempts {} (Action :ID a)))",
                  attempts));
}

Automaton& retry_of(Network& network) {
  return network.automata[index(network.node_automaton[index(kCounting)])];
}

VariableId count_of(const Network& network) {
  return *local_of(network, kCounting, LocalRole::Rounds);
}

Edge& first_edge(Automaton& automaton,
                 const std::function<bool(const Edge&)>& is_it) {
  const auto found = std::ranges::find_if(automaton.edges, is_it);
  REQUIRE(found != automaton.edges.end());
  return *found;
}

bool sets(const Edge& edge, VariableId variable, int value) {
  return std::ranges::any_of(edge.updates, [&](const Assignment& update) {
    return update.variable == variable &&
           update.value == Expression::constant(value);
  });
}

}  // namespace

TEST_CASE("attempts, rounds and recoveries are counted") {
  const std::string rest = " (Action :ID a)))";
  for (const std::string node :
       {"Repeat :repeat 3", "RetryUntilSuccessful :num_attempts 3",
        "Recovery :num_retries 2 (Condition :ID c)"}) {
    CAPTURE(node);
    const Network network = lowered("(BehaviorTree :name t (" + node + rest);
    const auto counter = round_counter(network, kCounting);
    REQUIRE(counter);
    CHECK(network.variable(counter->variable).max == 2);
    CHECK(counter->automaton == network.node_automaton[index(kCounting)]);
  }
  CHECK(round_counter(retrying(2), kCounting));
  CHECK_FALSE(round_counter(retrying(1), kCounting));
  CHECK_FALSE(round_counter(retrying(3), NodeId{2}));
}

TEST_CASE("what is used otherwise is no counter") {
  const auto is_one = [](const std::function<void(Network&)>& change) {
    Network network = retrying(4);
    change(network);
    return round_counter(network, kCounting).has_value();
  };
  CHECK(is_one([](Network&) {}));
  SUBCASE("another automaton reads it") {
    CHECK_FALSE(is_one([](Network& network) {
      Automaton& other =
          network.automata[index(network.node_automaton[index(NodeId{2})])];
      other.edges[0].guard =
          both(other.edges[0].guard, equals(count_of(network), 0));
    }));
  }
  SUBCASE("it asks for a value in the middle") {
    CHECK_FALSE(is_one([](Network& network) {
      const VariableId count = count_of(network);
      Edge& edge = first_edge(retry_of(network), [&](const Edge& each) {
        return each.updates.empty();
      });
      edge.guard = both(edge.guard, equals(count, 2));
    }));
  }
  SUBCASE("it is given another value") {
    CHECK_FALSE(is_one([](Network& network) {
      const VariableId count = count_of(network);
      Edge& edge = first_edge(retry_of(network), [&](const Edge& each) {
        return sets(each, count, 2);
      });
      edge.updates = {{count, Expression::constant(3)}};
    }));
  }
  SUBCASE("one of the values is not counted") {
    CHECK_FALSE(is_one([](Network& network) {
      const VariableId count = count_of(network);
      Automaton& automaton = retry_of(network);
      std::erase_if(automaton.edges,
                    [&](const Edge& each) { return sets(each, count, 2); });
    }));
  }
  SUBCASE("one of the values is counted elsewhere") {
    CHECK_FALSE(is_one([](Network& network) {
      const VariableId count = count_of(network);
      Edge& edge = first_edge(retry_of(network), [&](const Edge& each) {
        return sets(each, count, 2);
      });
      edge.target = LocationId{0};
    }));
  }
  SUBCASE("something else is computed from it") {
    CHECK_FALSE(is_one([](Network& network) {
      const VariableId count = count_of(network);
      retry_of(network).edges[0].updates.push_back(
          {network.node_status[index(kCounting)], read(count)});
    }));
  }
  SUBCASE("it may count beyond its last value") {
    CHECK_FALSE(is_one([](Network& network) {
      const VariableId count = count_of(network);
      Edge& edge = first_edge(retry_of(network), [&](const Edge& each) {
        return each.updates.empty();
      });
      edge.updates.push_back(
          {count, Expression::binary(Operation::Add, read(count),
                                     Expression::constant(1))});
    }));
  }
}

TEST_CASE("a round is counted or not where the counter is 0, and only there") {
  Network network = retrying(3);
  const std::size_t edges = retry_of(network).edges.size();
  const auto counter = round_counter(network, kCounting);
  REQUIRE(counter);
  leave_rounds_open(*counter, network);
  const Automaton& automaton = retry_of(network);
  REQUIRE(automaton.edges.size() == edges + 1);
  const VariableId uncounted = automaton.locals.back();
  CHECK(network.variable(uncounted).name == kUncounted);
  const auto writes = [](const Edge& edge, VariableId variable) {
    return std::ranges::any_of(edge.updates, [&](const Assignment& update) {
      return update.variable == variable;
    });
  };
  for (const Edge& edge : automaton.edges) {
    const bool is_back = sets(edge, counter->variable, 0);
    CHECK(sets(edge, uncounted, 0) == is_back);
    if (!is_back && writes(edge, uncounted)) {
      CHECK_FALSE(writes(edge, counter->variable));
    }
  }
}

}  // namespace btcheck::counters_test
