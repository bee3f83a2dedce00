// SPDX-License-Identifier: MIT
//
// What is wrong with a tree as it stands, and what is not.
#include "check/questions/lint.hpp"

#include <doctest/doctest.h>

#include <string>

#include "check/check.hpp"

namespace btcheck::lint_test {
namespace {

// "code line message" of each finding, a line for each.
std::string findings(const std::string& tree, const std::string& rules = "") {
  std::vector<InputFile> files;
  if (!rules.empty()) files.push_back({"rules.ltl", rules});
  std::string text;
  for (const Diagnostic& found :
       lint_inputs({"t.btf", tree}, files).diagnostics) {
    text += found.code + ' ' + std::to_string(found.span.line) + ' ' +
            found.message + '\n';
  }
  return text;
}

std::string dead(const std::string& children) {
  return findings("(BehaviorTree :name t " + children + ")");
}

constexpr std::string_view kDead = "BT2302 1 `b` can never be ticked\n";

TEST_CASE("what follows a child that never fails or succeeds is dead") {
  CHECK(dead("(Fallback (ForceSuccess (Action :ID a)) (Action :ID b))") ==
        kDead);
  CHECK(
      dead("(ReactiveFallback (ForceSuccess (Action :ID a)) (Action :ID b))") ==
      kDead);
  for (const std::string type : {"Sequence", "ReactiveSequence",
                                 "SequenceWithMemory", "PipelineSequence"}) {
    CAPTURE(type);
    CHECK(dead("(" + type + " (ForceFailure (Action :ID a)) (Action :ID b))") ==
          kDead);
    CHECK(dead("(" + type + " (ForceSuccess (Action :ID a)) (Action :ID b))") ==
          "");
  }
}

TEST_CASE("certainty goes up through the tree") {
  CHECK(dead("(Fallback (Inverter (ForceFailure (Action :ID a)))"
             " (Action :ID b))") == kDead);
  CHECK(dead("(Fallback (Sequence (ForceSuccess (Action :ID a))"
             " (ForceSuccess (Action :ID c))) (Action :ID b))") == kDead);
  CHECK(dead("(Fallback (Sequence (ForceSuccess (Action :ID a))"
             " (Action :ID c)) (Action :ID b))") == "");
  CHECK(dead("(Fallback (Repeat :repeat 2 (ForceSuccess (Action :ID a)))"
             " (Action :ID b))") == kDead);
  CHECK(dead("(Fallback (Repeat :repeat 2 (Action :ID a)) (Action :ID b))") ==
        "");
  CHECK(dead("(Parallel :success 1 (ForceSuccess (Action :ID a))"
             " (Action :ID b))") == "");
}

TEST_CASE("contracts say how leaves end") {
  const std::string tree =
      "(BehaviorTree :name t (Fallback (Action :ID a) (Action :ID b)))";
  CHECK(findings("(defaction a :returns (success running)) " + tree) == kDead);
  CHECK(findings("(defsv k :max 1) (defaction a :returns (success running) "
                 ":requires (= k 0)) " +
                 tree) == "");
}

TEST_CASE("of what lies below or behind a dead node nothing more is said") {
  CHECK(dead("(Fallback (ForceSuccess (Action :ID a))"
             " (Fallback :name b (ForceSuccess (Action :ID c))"
             " (Action :ID d)) (Action :ID e))") == kDead);
}

TEST_CASE("a subtree in two places is told once") {
  CHECK(findings("(BehaviorTree :name t (Sequence (SubTree :ID s)"
                 " (SubTree :ID s)))\n(BehaviorTree :name s (Fallback"
                 " (ForceSuccess (Action :ID a)) (Action :ID b)))") ==
        "BT2302 2 `b` can never be ticked\n");
}

TEST_CASE("a variable is of use to a node, a contract or a rule") {
  const std::string end = "(BehaviorTree :name t (Action :ID a))";
  const std::string unused = "BT2303 1 nothing reads or writes `k`\n";
  const std::string declared = "(defsv k :max 1)";
  CHECK(findings(declared + end) == unused);
  CHECK(findings(declared + end, "property p: possible k == 0") == "");
  CHECK(findings(declared + end, "property p: possible a.success") == unused);
  CHECK(findings(declared + "(defaction a :requires (= k 0))" + end) == "");
  CHECK(findings(declared + "(defaction a :on-success ((:= k 1)))" + end) ==
        "");
  CHECK(findings(declared + "(BehaviorTree :name t (SetSV :ID m :sv k))") ==
        "");
  CHECK(findings(declared + "(BehaviorTree :name t (Eval (= k 1)))") == "");
}

TEST_CASE("an assignment against the transitions, and transitions for nobody") {
  const std::string door =
      "(defsv d :states (Open Shut) :transitions ((Open Shut)))";
  const auto with = [&](const std::string& first, const std::string& value) {
    return findings(door + "(BehaviorTree :name t (Sequence " + first +
                    " (Eval (:= d " + value + "))))");
  };
  const std::string measure = "(SetSV :ID m :sv d)";
  CHECK(with(measure, "Open") ==
        "BT2301 1 no transition of `d` leads to `Open`\n");
  CHECK(with(measure, "Shut") == "");
  CHECK(with("(Action :ID a)", "Open") ==
        "BT2304 1 the `:transitions` of `d` have no effect\n");
  CHECK(findings("(defsv d :states (Open Shut) :transitions :all :moves free)"
                 "(BehaviorTree :name t (Eval (:= d Shut)))") == "");
}

TEST_CASE("what the readers warn of is told as well") {
  CHECK(findings("(BehaviorTree :name t (action :ID a))",
                 "property p: never A.failure") ==
        "BT1007 1 `Action` is written `action` here\n"
        "BT1107 1 `A` differs in case from the node's name `a`\n");
}

}  // namespace
}  // namespace btcheck::lint_test
