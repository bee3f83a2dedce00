// SPDX-License-Identifier: MIT
//
// A port writes while its leaf is ticked or halted; what a script assigned is
// known until then.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "check/check.hpp"

namespace btcheck::port_writes_test {
namespace {

// `Read` writes {x} by a port of this type.
std::string tree(const std::string& inside,
                 const std::string& type = "std::string") {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">"
         "<BehaviorTree ID=\"T\">" +
         inside +
         "</BehaviorTree><TreeNodesModel>"
         "<Action ID=\"Read\"><output_port name=\"out\" type=\"" +
         type +
         "\"/></Action><Action ID=\"Work\"/><Condition ID=\"Ask\"/>"
         "</TreeNodesModel></root>";
}

CheckResult checked(const std::string& xml, const std::string& rule = {},
                    const std::string& leaves = {}) {
  TreeInput input("t.xml", xml);
  if (!leaves.empty()) input.reading.leaves = {{"t.leaves", leaves}};
  if (rule.empty()) return check(input, {}, {});
  return check(input, {{"t.ltl", "property p: " + rule}}, {});
}

Verdict judged(const std::string& inside, const std::string& rule,
               const std::string& leaves = {}) {
  const CheckResult result = checked(tree(inside), rule, leaves);
  REQUIRE(result.files.size() == 1);
  return result.files[0].verdicts.at(0).verdict;
}

bool throws(const std::string& inside, const std::string& type = "int",
            const std::string& leaves = {}) {
  const CheckResult result = checked(tree(inside, type), {}, leaves);
  REQUIRE(result.files.size() == 1);
  const auto& answers = result.files[0].defaults->tree;
  const auto found = std::find_if(
      answers.begin(), answers.end(), [](const TreeReport& answer) {
        return answer.question == TreeQuestion::InRange;
      });
  return found->verdict == Verdict::Violated;
}

bool is_left_open(const std::string& inside) {
  const auto found = checked(tree(inside)).diagnostics;
  return std::any_of(found.begin(), found.end(), [](const Diagnostic& each) {
    return each.code == "BT1640";
  });
}

const std::string kRead = "<Read out=\"{x}\"/>";
const std::string kMine = "<Script code=\"x := 'me'\"/>";
const std::string kFree =
    "<ScriptCondition name=\"is_free\" code=\"x == 'free'\"/>";

std::string within(const std::string& node, const std::string& inside) {
  return "<" + node + ">" + inside + "</" + node + ">";
}

TEST_CASE("what a script assigned is known until the leaf is ticked again") {
  const std::string once =
      within("Sequence", kRead + kMine + "<Work/>" + kFree);
  CHECK(judged(once, "never is_free.success") == Verdict::Holds);
  CHECK_FALSE(is_left_open(once));
  const std::string again = within("Sequence", kMine + kRead + kFree);
  CHECK(judged(again, "possible is_free.success") == Verdict::Holds);
  CHECK(judged(again, "possible is_free.failure") == Verdict::Holds);
}

TEST_CASE("a leaf may write when it fails, and while it runs") {
  const std::string fails =
      within("Sequence", kMine + "<Inverter>" + kRead + "</Inverter>" + kFree);
  CHECK(judged(fails, "possible is_free.success") == Verdict::Holds);
  const std::string runs = "<Parallel>" +
                           within("Sequence", kMine + "<Work/>" + kFree) +
                           kRead + "</Parallel>";
  const std::string only_runs = "(defaction Read :returns (running))";
  CHECK(judged(runs, "possible is_free.success", only_runs) == Verdict::Holds);
  // The script comes after the leaf in each tick.
  const std::string before =
      "<Parallel>" + kRead + within("Sequence", kMine + kFree) + "</Parallel>";
  CHECK(judged(before, "never is_free.success", only_runs) == Verdict::Holds);
}

TEST_CASE("a leaf may write when it is halted") {
  const std::string race =
      "<ReactiveFallback>"
      "<Sequence><Ask/>" +
      kFree +
      "</Sequence>"
      "<Parallel failure_count=\"1\" success_count=\"2\">" +
      kRead + "<Sequence>" + kMine + "<AlwaysFailure/></Sequence></Parallel>" +
      kFree + "</ReactiveFallback>";
  CHECK(judged(race, "possible is_free.success") == Verdict::Holds);
  const std::string halted =
      "<Fallback><Parallel failure_count=\"1\" success_count=\"2\">" + kRead +
      "<Sequence>" + kMine + "<AlwaysFailure/></Sequence></Parallel>" + kFree +
      "</Fallback>";
  const std::string runs = "(defaction Read :returns (running))";
  CHECK(judged(halted, "possible is_free.success", runs) == Verdict::Holds);
}

TEST_CASE("an entry that no leaf has written yet is read") {
  const std::string few = "<ScriptCondition code=\"x &lt; 10\"/>";
  const std::string maybe =
      within("Sequence", within("Fallback", "<Ask/>" + kRead) + few);
  CHECK(throws(maybe));
  CHECK_FALSE(throws(within("Sequence", kRead + few)));
  CHECK_FALSE(throws(maybe, "int", "(defsv x :init 1)"));
  CHECK_FALSE(throws(
      within("Sequence", "<Script code=\"x := 1\"/>" +
                             within("Fallback", "<Ask/>" + kRead) + few)));
  // A leaf that fails need not have written.
  CHECK(throws(
      within("Sequence", "<ForceSuccess>" + kRead + "</ForceSuccess>" + few)));
}

TEST_CASE("what a leaf writes is what the script needs") {
  CHECK_FALSE(throws(
      within("Sequence", kRead + "<Script code=\"y := x + 1; y &gt; 3\"/>")));
  CHECK_FALSE(throws(within("Sequence", kRead + "<Work _skipIf=\"x\"/>")));
  // What a script has put there is known.
  CHECK(throws(within("Sequence", kRead + "<Script code=\"x := 5\"/>"
                                          "<Work _skipIf=\"x\"/>")));
}

TEST_CASE("a contract says all that a leaf does with an entry it names") {
  const std::string two = within(
      "Sequence",
      "<Read name=\"a\" out=\"{x}\"/><Read name=\"b\" out=\"{x}\"/>" + kFree);
  const std::string says =
      "(defaction a :on-success (:= x \"me\"))"
      "(defaction b :returns (success) :on-success (:= x \"me\"))";
  CHECK(judged(two, "never is_free.success", says) == Verdict::Holds);
  const std::string first = "(defaction a :on-success (:= x \"me\"))";
  CHECK(judged(two, "possible is_free.success", first) == Verdict::Holds);
}

}  // namespace
}  // namespace btcheck::port_writes_test
