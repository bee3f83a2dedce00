// SPDX-License-Identifier: MIT
//
// The default report in several attempts, where the limits end the last one.
#include "check/questions/earlier.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "check/check.hpp"
#include "explore/state/step.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"

namespace btcheck::earlier_test {
namespace {

// RetryUntilSuccessful without end: BT2215 after a few steps.
constexpr const char* kEndless = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><Sequence>
  <RetryUntilSuccessful num_attempts="-1"><A/></RetryUntilSuccessful><B/>
</Sequence></BehaviorTree><TreeNodesModel>
<Action ID="A"/><Action ID="B"/></TreeNodesModel></root>)";

bool has(const DefaultReport& report, std::string_view code) {
  return std::ranges::count(report.findings, code, &TreeFinding::code) == 1;
}

DefaultReport searched(const BehaviorTree& tree, const CompiledNetwork& system,
                       std::uint64_t states) {
  Limits limits;
  limits.max_states = states;
  return check_defaults(tree, system, Reduction::None, limits);
}

TEST_CASE("what an attempt has found stays found where the next one is cut") {
  const auto tree = read_tree("t.xml", kEndless, {});
  REQUIRE(tree.value);
  const Network network = lower(*tree.value, TickSemantics::Root);
  const CompiledNetwork system(network);
  const DefaultReport whole = searched(*tree.value, system, UINT64_MAX);
  REQUIRE(has(whole, "BT2215"));
  DefaultReport first = whole;
  first.stopped = StopReason::MaxStates;
  DefaultReport last = searched(*tree.value, system, 1);
  REQUIRE(!has(last, "BT2215"));
  const std::uint64_t states = first.progress.states;
  const Verdict can_succeed = first.tree[0].verdict;
  add_known(*tree.value, std::move(first), last);
  CHECK(has(last, "BT2215"));
  CHECK(last.stopped == StopReason::MaxStates);
  CHECK(last.progress.states == states);
  CHECK(last.tree[0].verdict == can_succeed);
}

TEST_CASE("to a report that is whole nothing is added") {
  const auto tree = read_tree("t.xml", kEndless, {});
  REQUIRE(tree.value);
  const Network network = lower(*tree.value, TickSemantics::Root);
  const CompiledNetwork system(network);
  DefaultReport whole = searched(*tree.value, system, UINT64_MAX);
  DefaultReport other = whole;
  other.findings.front().code = "BT2201";
  add_known(*tree.value, std::move(other), whole);
  CHECK(!has(whole, "BT2201"));
}

}  // namespace
}  // namespace btcheck::earlier_test
