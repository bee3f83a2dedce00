// SPDX-License-Identifier: MIT
//
// What lint says without a search against all states of small random trees.
#include <doctest/doctest.h>

#include <string>

#include "check/questions/defaults.hpp"
#include "explore/state/step.hpp"
#include "model/lowering.hpp"
#include "model/tree/answers.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::lint_cross_check_test {
namespace {

Verdict answer(const DefaultReport& report, std::size_t node,
               NodeQuestion question) {
  return report.nodes[node].answers[static_cast<std::size_t>(question)].verdict;
}

TEST_CASE("a node that lint calls dead is never ticked, nor ends otherwise") {
  RandomTreeWeights weights;
  weights.max_nodes = 12;
  weights.contract = 50;
  std::size_t dead_count = 0;
  std::size_t certain_count = 0;
  const int trees = by_effort(1500, 15000);
  for (int seed = 0; seed < trees; ++seed) {
    const std::string text = random_tree(
        shifted_seed(90'000) + static_cast<unsigned>(seed), weights);
    const auto tree = read_btf("t.btf", text);
    REQUIRE(tree.value);
    const Network network = lower(*tree.value, TickSemantics::Root);
    const CompiledNetwork system(network);
    Limits few;
    few.max_states = 20'000;
    const DefaultReport report =
        check_defaults(*tree.value, system, Reduction::None, few);
    if (report.stopped != StopReason::None) continue;
    CAPTURE(text);
    for (const NeverTicked& found : never_ticked(*tree.value)) {
      CHECK(answer(report, index(found.node), NodeQuestion::Ticked) ==
            Verdict::Violated);
      ++dead_count;
    }
    const auto answers = possible_answers(*tree.value);
    for (std::size_t n = 0; n < answers.size(); ++n) {
      if (!answers[n].success) {
        CHECK(answer(report, n, NodeQuestion::Success) == Verdict::Violated);
        ++certain_count;
      }
      if (!answers[n].failure) {
        CHECK(answer(report, n, NodeQuestion::Failure) == Verdict::Violated);
        ++certain_count;
      }
    }
  }
  MESSAGE(trees << " trees: " << dead_count << " dead nodes, " << certain_count
                << " answers ruled out");
  CHECK_COVERED(dead_count > 100);
  CHECK_COVERED(certain_count > 1000);
}

}  // namespace
}  // namespace btcheck::reference::lint_cross_check_test
