// SPDX-License-Identifier: MIT
//
// The advice, to the letter.
#include "report/text/space_report.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace btcheck::space_report_test {

TEST_CASE("a quotient stands beside the whole, with what is seen") {
  const Network network;
  const SpaceOptions options;
  SpaceReport report;
  report.result.is_complete = true;
  report.result.progress.states = 1840;
  report.result.progress.transitions = 2000;
  SpaceQuotient quotient;
  quotient.seen = SeenAnswers::OfLeaves;
  const LabelledGraph::Arc arc{1, 0};
  quotient.graph.add_state({&arc, 1});
  quotient.labels = {"i", "time"};
  SpaceContext context{"t.btf", network, options};
  context.modulo = Equivalence::Branching;
  context.quotient = &quotient;
  const std::string text = space_text(report, context);
  CHECK(text.find("reduce bisimulation\n") != text.npos);
  CHECK(text.ends_with(
      "Modulo branching bisimilarity with divergence; seen: the leaves' "
      "answers, time\n"
      "  states                          1 of 1,840\n"
      "  transitions                     1 of 2,000\n"
      "  labels seen                     1\n"));
  quotient.stopped = StopReason::Memory;
  CHECK(space_text(report, context).find("UNDECIDED  not minimised, ") !=
        std::string::npos);
  quotient.equivalence = Equivalence::Strong;
  CHECK(space_text(report, context).find("Modulo strong bisimilarity;") !=
        std::string::npos);
}

TEST_CASE("the largest parts are named with a way to make them smaller") {
  const auto read = read_btf(
      "t.btf",
      "((defsv sky :states (clear cloudy) :init clear :transitions :all)\n"
      " (BehaviorTree :name t\n"
      "  (RateController :hz 1 :name slowly\n"
      "   (Action :ID fly))))\n");
  REQUIRE(read.value);
  const std::vector<Contribution> parts = {
      {NodeId{1}, std::nullopt, 9.74},
      {std::nullopt, StateVariableId{0}, 2.0},
      {NodeId{2}, std::nullopt, 1.1}};
  CHECK(contribution_text(*read.value, parts) ==
        "What multiplies the states, and what would help\n"
        "  x    9.7  RateController slowly (line 3)\n"
        "             its timer counts ticks: raise :hz, or scale all times "
        "down\n"
        "  x    2.0  sky\n"
        "             it moves at any instant: :moves sampled, if only the "
        "tree looks\n");
}

TEST_CASE("a Parallel is told with the option that helps") {
  const auto read = read_btf(
      "t.btf",
      "(BehaviorTree :name t (ParallelAll (Action :ID a) (Action :ID b)))");
  REQUIRE(read.value);
  const std::vector<Contribution> parts = {{NodeId{1}, std::nullopt, 4.0}};
  CHECK(contribution_text(*read.value, parts) ==
        "What multiplies the states, and what would help\n"
        "  x    4.0  ParallelAll1 (line 1)\n"
        "             its children interleave; --reduce full explores one "
        "order\n");
}

TEST_CASE("parts that hardly matter are not told") {
  const auto read =
      read_btf("t.btf", "(BehaviorTree :name t (Action :ID fly))");
  REQUIRE(read.value);
  const std::vector<Contribution> parts = {{NodeId{1}, std::nullopt, 1.2}};
  CHECK(contribution_text(*read.value, parts).empty());
}

}  // namespace btcheck::space_report_test
