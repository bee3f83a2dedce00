// SPDX-License-Identifier: MIT
//
// Trees of which it is known from which number on a rule is so.
#include "check/counts.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "check/check.hpp"

namespace btcheck::counts_test {
namespace {

// "HOLDS from 3", "VIOLATED: why not", by rule; of a tree with one counter.
std::vector<std::string> told(const std::string& file, const std::string& tree,
                              const std::vector<std::string>& rules,
                              CheckOptions how = {}) {
  std::string text;
  for (const std::string& rule : rules) {
    text +=
        fmt::format("{}{}\n", rule.starts_with("assume") ? "" : "prove ", rule);
  }
  how.any_count = true;
  const CheckResult result =
      check(TreeInput(file, FileText(tree)), {{"r.ltl", FileText(text)}}, how);
  REQUIRE(result.files.size() == 1);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < result.files[0].verdicts.size(); ++i) {
    const CountClaims& claims = result.files[0].counts.at(i);
    REQUIRE(claims.size() == 1);
    const Verdict verdict = result.files[0].verdicts[i].verdict;
    std::string& one =
        all.emplace_back(verdict == Verdict::Holds      ? "HOLDS"
                         : verdict == Verdict::Violated ? "VIOLATED"
                                                        : "UNDECIDED");
    one += claims[0].from ? fmt::format(" from {}", *claims[0].from)
                          : ": " + claims[0].open;
  }
  return all;
}
using Told = std::vector<std::string>;

// Each attempt opens the door a bit more.
std::string door(int attempts) {
  return fmt::format(
      "((defsv open :init 0 :min 0 :max 3)"
      " (defaction push :returns (failure))"
      " (BehaviorTree :name t (RetryUntilSuccessful :num_attempts {} (Sequence"
      "  (Fallback (Eval (>= open 3)) (Eval (:= open (+ open 1))))"
      "  (Action :ID push :SF)))))",
      attempts);
}

// One child, which fails as long as nobody helps.
std::string retried(const std::string& child, int attempts = 3) {
  return fmt::format(
      "(BehaviorTree :name t (RetryUntilSuccessful :name r :num_attempts {}"
      " {}))",
      attempts, child);
}

}  // namespace

TEST_CASE("what takes three attempts is told from three on") {
  const Told expected = {"HOLDS from 3", "HOLDS from 3", "HOLDS from 1"};
  for (const int attempts : {3, 4, 7}) {
    CAPTURE(attempts);
    CHECK(told("t.btf", door(attempts),
               {"always (root.failure => open = 3)", "possible open = 3",
                "never open > 3"}) == expected);
  }
}

TEST_CASE("a verdict of less attempts alone is not told of more") {
  CHECK(told("t.btf", door(2), {"never open = 3", "possible open = 2"}) ==
        Told{"HOLDS: some other number may give another verdict",
             "HOLDS from 2"});
}

TEST_CASE("attempts come to an end, however many there are") {
  // Each of the first two has a run on which the rounds go on for ever, if it
  // is left open how many there are, and no rule of fairness ends them.
  CHECK(told("t.btf", retried("(Condition :ID c)"),
             {"eventually root.ended", "c.failure leadsto root.ended",
              "[] <> c.ticked"}) ==
        Told{"HOLDS from 1", "HOLDS from 1", "VIOLATED from 1"});
  // A tree that begins anew resets the counter again and again.
  CHECK(told("t.btf",
             "(BehaviorTree :name t :loop 1 (RetryUntilSuccessful"
             " :num_attempts 3 (Condition :ID c)))",
             {"[] <> tick", "[] <> root.failure", "[] <> c.ticked"}) ==
        Told{"HOLDS from 1", "VIOLATED from 1", "HOLDS from 1"});
}

TEST_CASE("a run may come to rest in any round") {
  // With two attempts a does not fail thrice; with more it does, and then runs
  // for ever: the counter is not set back any more.
  const std::string thrice =
      "ltl not <> (a.failure and <> (a.ticked and <> (a.failure and"
      " <> (a.ticked and <> (a.failure and [] not root.ended)))))";
  CHECK(told("t.btf", retried("(Action :ID a)", 2), {thrice}) ==
        Told{"HOLDS: some other number may give another verdict"});
  CHECK(told("t.btf", retried("(Action :ID a)", 5), {thrice}) ==
        Told{"VIOLATED from 4"});
}

TEST_CASE("what fails for every number is shown for every number") {
  CHECK(told("t.btf", retried("(Action :ID a :SF)", 5),
             {"never root.failure", "possible root.failure",
              "[] (a.ticked => <> a.success)", "<> root.success",
              "[] not root.failure or <> a.success"}) ==
        Told{"VIOLATED from 1", "HOLDS from 1", "VIOLATED from 1",
             "VIOLATED from 1", "VIOLATED from 1"});
}

TEST_CASE("an exact number of answers is told of no other one") {
  // a fails three times before the tree does: with two X for each attempt the
  // rule would be another one.
  const Told answers =
      told("t.btf", retried("(Action :ID a :SF)", 2),
           {"[] (a.ticked => X (not a.ticked U (a.failure or a.success)))",
            "a.ticked leadsto root.ended within 3 ticks",
            "r.count = 1 leadsto root.ended", "EF root.failure",
            "AG EF root.ended"});
  CHECK(answers[0] == "HOLDS from 1");
  CHECK(answers[2] == "HOLDS: the rule looks at the counter");
  CHECK(answers[4] == "HOLDS: the rule is one of branching time");
}

TEST_CASE("time bounds what a number of rounds can do") {
  // Each attempt takes a tick.
  const std::string tree =
      "((defaction a :duration 1 :returns (failure running))" +
      retried("(Action :ID a)", 2) + ")";
  const Told answers =
      told("t.btf", tree,
           {"a.ticked leadsto root.ended within 9 ticks", "never a.success"});
  CHECK(answers[0] == "HOLDS: some other number may give another verdict");
  CHECK(answers[1] == "HOLDS from 1");
}

TEST_CASE("an answer that comes too late comes later with more rounds") {
  CHECK(told("t.btf",
             "((defaction a :duration 1 :returns (failure running))" +
                 retried("(Action :ID a)", 5) + ")",
             {"a.ticked leadsto root.failure within 3 ticks"}) ==
        Told{"VIOLATED from 4"});
  // The run has to go through all rounds; of a lower bound nothing is told.
  CHECK(told("t.btf", retried("(Action :ID a :SF)", 5),
             {"root.failure leadsto a.success within 2 ticks",
              "root.failure leadsto a.success within [1,2]"}) ==
        Told{"VIOLATED from 1",
             "VIOLATED: some other number may give another verdict"});
}

TEST_CASE("what is assumed is assumed of every number") {
  CHECK(told("t.btf", retried("(Action :ID a)"),
             {"assume every action eventually ends", "eventually root.ended",
              "eventually root.success"}) ==
        Told{"HOLDS from 1", "VIOLATED from 1"});
}

TEST_CASE("a search that is stopped tells nothing") {
  CheckOptions few;
  few.limits.max_states = 1;
  few.choices.reduction = Reduction::None;
  const Told answers =
      told("t.btf", retried("(Action :ID a)"), {"never a.halted"}, few);
  CHECK(answers == Told{"UNDECIDED: the rule is undecided"});
}

TEST_CASE("retries of Nav2 are counted though the node does not ask then") {
  const std::string tree = R"(<root BTCPP_format="4">
  <BehaviorTree ID="T">
    <RecoveryNode number_of_retries="2">
      <Action ID="Drive"/>
      <Action ID="Clear"/>
    </RecoveryNode>
  </BehaviorTree>
</root>)";
  TreeInput input("t.xml", FileText(tree));
  input.reading.profile = Profile::Nav2Jazzy;
  CheckOptions how;
  how.any_count = true;
  const CheckResult result =
      check(input,
            {{"r.ltl", FileText("prove never root.skipped\n"
                                "prove possible Clear.ticked\n"
                                "prove possible root.failure\n")}},
            how);
  REQUIRE(result.files.size() == 1);
  const auto& counts = result.files[0].counts;
  CHECK(counts.at(0).at(0).attribute == "number_of_retries");
  CHECK(counts.at(0).at(0).from == 0);
  CHECK(counts.at(1).at(0).from == 1);
  CHECK(counts.at(2).at(0).from == 0);
}

}  // namespace btcheck::counts_test
