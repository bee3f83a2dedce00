// SPDX-License-Identifier: MIT
//
// With which statuses nodes are called, by the tables and in every state.
#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <string>

#include "explore/lowered.hpp"
#include "explore/reduce/called_with.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/naive_network.hpp"
#include "reference/reduction_cases.hpp"

namespace btcheck::reference::called_with_cross_check_test {
namespace {

std::vector<std::optional<CalledWith>> calls_in(const Network& network) {
  return called_with(network, CallProtocol(network), Accesses(network));
}

// Is a node ever called as one that has succeeded?
bool is_called_after_success(const std::string& file, const std::string& text,
                             std::string_view node) {
  const auto tree = read_tree(file, text, {});
  REQUIRE(tree.value);
  const Network network = lower(*tree.value, TickSemantics::Root);
  const auto called = calls_in(network)[index(automaton_of(network, node))];
  REQUIRE(called);
  return called->has(static_cast<int>(NodeStatus::Success));
}

TEST_CASE("a node that is reset is not called as one that has succeeded") {
  const std::string xml =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"m\"><Sequence>"
      "<Sequence name=\"s\"><IsReady name=\"c\"/><Drive name=\"a\"/>"
      "</Sequence></Sequence></BehaviorTree></root>";
  CHECK(!is_called_after_success("t.xml", xml, "c"));
  CHECK(!is_called_after_success("t.xml", xml, "s"));
  // In .btf trees an answer is left where it is.
  CHECK(is_called_after_success(
      "t.btf",
      "((BehaviorTree :name t :loop 1 (Sequence (Condition :ID c)"
      " (Action :ID a))))",
      "c"));
}

TEST_CASE("every call finds a status that it may find") {
  std::size_t calls = 0, possible = 0, found = 0;
  for_reduction_cases(85, by_effort(250, 3000), [&](const ReductionCase& each) {
    const Network& network = each.network;
    const auto all = calls_in(network);
    std::vector<std::uint64_t> seen(all.size(), 0);
    for (std::size_t s = 0; s < each.space.states.size(); ++s) {
      for (const NaiveSpace::Step& step : each.space.steps[s]) {
        const NaiveState& before = each.space.states[s];
        const NaiveState& after = each.space.states[step.target];
        for (std::uint32_t a = 0; a < all.size(); ++a) {
          const auto& gate = network.automata[a].gate;
          if (!all[a] || !gate || before.value(*gate) != 0 ||
              after.value(*gate) == 0) {
            continue;
          }
          ++calls;
          const int status = after.value(all[a]->status);
          CAPTURE(network.automata[a].name);
          CAPTURE(status);
          REQUIRE(all[a]->has(status));
          seen[a] |= std::uint64_t{1} << (status - all[a]->lowest);
        }
      }
    }
    for (std::uint32_t a = 0; a < all.size(); ++a) {
      if (seen[a] == 0) continue;
      possible += static_cast<std::size_t>(std::popcount(all[a]->entered));
      found += static_cast<std::size_t>(std::popcount(seen[a]));
    }
    return GoOn::Yes;
  });
  MESSAGE(calls << " calls with " << found << " of " << possible
                << " statuses");
  CHECK_COVERED(calls > 10'000);
  // Most of what is possible by the tables does happen.
  CHECK_COVERED(found * 3 > possible * 2);
}

}  // namespace
}  // namespace btcheck::reference::called_with_cross_check_test
