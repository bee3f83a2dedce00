// SPDX-License-Identifier: MIT
//
// What the trees' own answers rule out, held against all runs, for every type
// of node that XML trees have over one or two children.
#include "model/tree/answers.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/node_rows.hpp"

namespace btcheck::answers_test {
namespace {

const std::vector<std::string> kChildren = {
    "<A/>",
    "<AlwaysSuccess/>",
    "<AlwaysFailure/>",
    "<AlwaysFailure _skipIf=\"true\"/>",
    "<C _failureIf=\"true\"/>",
    "<Inverter><ForceFailure><A/></ForceFailure></Inverter>",
    "<KeepRunningUntilFailure><AlwaysSuccess/></KeepRunningUntilFailure>"};

const std::vector<std::string> kOverOne = {
    "Inverter",
    "ForceSuccess",
    "ForceFailure",
    "KeepRunningUntilFailure",
    "Repeat num_cycles=\"2\"",
    "Repeat num_cycles=\"0\"",
    "Repeat num_cycles=\"-1\"",
    "RetryUntilSuccessful num_attempts=\"2\"",
    "RetryUntilSuccessful num_attempts=\"0\"",
    "RetryUntilSuccessful num_attempts=\"-1\"",
    "RateController hz=\"5\"",
    "Precondition if=\"x == 1\" else=\"RUNNING\"",
    "Timeout msec=\"200\"",
    "Delay delay_msec=\"200\"",
    "RunOnce then_skip=\"false\"",
    "LoopInt queue=\"1;2\" value=\"{v}\"",
    "SkipUnlessUpdated entry=\"{e}\"",
    "WaitValueUpdate entry=\"{e}\"",
    "DistanceController",
    "GoalUpdater",
    "PathLongerOnApproach",
    "SingleTrigger"};

struct Counts {
  int trees = 0;
  int dead = 0;
  int ruled_out = 0;
};

bool may(const DefaultReport& report, std::size_t node, NodeQuestion question) {
  const Verdict verdict =
      report.nodes[node].answers[static_cast<std::size_t>(question)].verdict;
  REQUIRE(verdict != Verdict::Undecided);
  return verdict == Verdict::Holds;
}

// What the search says of each node agrees with what was ruled out without it.
void compare(const std::string& tree, Counts& counts) {
  CAPTURE(tree);
  TreeInput input("t.xml", "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\">" +
                               tree + "</BehaviorTree></root>");
  input.reading.profile = Profile::Nav2Main;
  input.reading.loops = true;
  input.reading.leaves = {
      {"t.leaves",
       "(defaction A :returns (success failure running)) (defcondition C)"}};
  const CheckResult result = check(input, {}, {});
  if (result.files.empty()) return;  // refused: two children that may run
  ++counts.trees;
  const DefaultReport& report = *result.files[0].defaults;
  for (const NeverTicked& found : never_ticked(*result.tree)) {
    CAPTURE(found.why);
    ++counts.dead;
    CHECK(!may(report, index(found.node), NodeQuestion::Ticked));
  }
  const std::vector<Answers> answers = possible_answers(*result.tree);
  for (std::size_t n = 0; n < answers.size(); ++n) {
    CAPTURE(n);
    counts.ruled_out += !answers[n].success + !answers[n].failure;
    if (!answers[n].success) CHECK(!may(report, n, NodeQuestion::Success));
    if (!answers[n].failure) CHECK(!may(report, n, NodeQuestion::Failure));
    if (!answers[n].runs) CHECK(!may(report, n, NodeQuestion::Running));
  }
}

// Also where the parent does not reset it: a condition without an else branch.
void compare_in_places(const std::string& node, Counts& counts) {
  compare(node, counts);
  compare("<IfThenElse>" + node + "<AlwaysSuccess/></IfThenElse>", counts);
}

std::string over(const std::string& written, const std::string& children) {
  return "<" + written + ">" + children + "</" +
         written.substr(0, written.find(' ')) + ">";
}

TEST_CASE("answers that a type rules out are given in no run") {
  Counts counts;
  for (const std::string& written : kOverOne) {
    for (const std::string& child : kChildren) {
      compare_in_places(over(written, child), counts);
    }
  }
  for (const auto& [type, written] : kInXml) {
    if (written.empty() || profile_with(type) == Profile::PyTrees) continue;
    for (const std::string& one : kChildren) {
      for (const std::string& two : kChildren) {
        compare_in_places(over(written, one + two), counts);
        if (info_of(type).max_children == 2) continue;
        compare(over(written, one + two + "<C/>"), counts);
      }
    }
  }
  MESSAGE(counts.trees << " trees: " << counts.dead << " nodes never ticked, "
                       << counts.ruled_out << " answers ruled out");
  CHECK(counts.trees > 2000);
  CHECK(counts.dead > 300);
  CHECK(counts.ruled_out > 5000);
}

// "B: why" of each, in the order of the tree.
std::string dead(const std::string& tree) {
  TreeInput input(
      "t.xml", "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"M\">\n" + tree +
                   "\n</BehaviorTree></root>");
  std::string told;
  for (const Diagnostic& found : lint_inputs(input, {}).diagnostics) {
    if (found.code == "BT1629") told += found.message + ": " + found.label;
  }
  return told;
}

TEST_CASE("which children the tick never gets to, and why") {
  CHECK(dead("<Fallback><AlwaysSuccess/><B/></Fallback>") ==
        "`B` is never ticked: `AlwaysSuccess` (line 3) never fails");
  CHECK(dead("<Fallback><B/><AlwaysSuccess/></Fallback>") == "");
  const std::string no_success =
      "`B` is never ticked: `n` (line 3) never succeeds";
  for (const std::string type :
       {"Sequence", "AsyncSequence", "ReactiveSequence", "SequenceWithMemory",
        "PipelineSequence"}) {
    CAPTURE(type);
    CHECK(dead(over(type, "<AlwaysFailure name=\"n\"/><B/>")) == no_success);
    CHECK(dead(over(type, "<AlwaysFailure _skipIf=\"true\"/><B/>")) == "");
  }
  CHECK(dead("<Sequence><KeepRunningUntilFailure name=\"n\"><A/>"
             "</KeepRunningUntilFailure><B/></Sequence>") == no_success);
  CHECK(dead("<TryCatch><AlwaysFailure name=\"n\"/><B/><C/></TryCatch>") ==
        no_success);
  CHECK(dead("<IfThenElse><AlwaysFailure name=\"n\"/><B/><A/></IfThenElse>") ==
        no_success);
  CHECK(
      dead("<WhileDoElse><AlwaysSuccess name=\"n\"/><A/><B/></WhileDoElse>") ==
      "`B` is never ticked: `n` (line 3) never fails");
  CHECK(dead("<RecoveryNode><AlwaysSuccess name=\"n\"/><B/></RecoveryNode>") ==
        "`B` is never ticked: `n` (line 3) never fails");
  CHECK(dead("<Switch2 variable=\"{v}\" case_1=\"1\" case_2=\"1\"><A/><B/><A/>"
             "</Switch2>") ==
        "`B` is never ticked: `case_1` has the same value");
  CHECK(dead("<Repeat num_cycles=\"0\"><B/></Repeat>") ==
        "`B` is never ticked: it goes round 0 times");
  CHECK(
      dead("<Repeat num_cycles=\"0\"><Sequence name=\"B\"><AlwaysFailure/><B/>"
           "</Sequence></Repeat>") ==
      "`Sequence` is never ticked: it goes round 0 times");
}

}  // namespace
}  // namespace btcheck::answers_test
