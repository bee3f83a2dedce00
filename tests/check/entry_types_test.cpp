// SPDX-License-Identifier: MIT
//
// What BehaviorTree.CPP does with the types and values of entries, each of
// these tried on 4.10.0 or 3.8.8 itself: exceptions that are certain, values
// that are many, entries of version 3.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "check/check.hpp"

namespace btcheck::entry_types_test {
namespace {

std::string version4(const std::string& inside, const std::string& more = {}) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">"
         "<BehaviorTree ID=\"T\">" +
         inside + "</BehaviorTree>" + more + "</root>";
}

std::string sequence(const std::string& inside) {
  return version4("<Sequence>" + inside + "</Sequence>");
}

std::string script(const std::string& code) {
  return "<Script code=\"" + code + "\"/>";
}
std::string condition(const std::string& code) {
  return "<ScriptCondition name=\"asks\" code=\"" + code + "\"/>";
}

bool has_code(const CheckResult& result, std::string_view code) {
  return std::any_of(
      result.diagnostics.begin(), result.diagnostics.end(),
      [&](const Diagnostic& found) { return found.code == code; });
}

// The answer of the default report, and the run that shows it.
const TreeReport& answer_of(const CheckResult& result, TreeQuestion question) {
  const auto& answers = result.files.at(0).defaults->tree;
  return *std::find_if(
      answers.begin(), answers.end(),
      [&](const TreeReport& answer) { return answer.question == question; });
}

bool throws(const std::string& xml) {
  const CheckResult result = check({"t.xml", xml}, {}, {});
  REQUIRE(result.files.size() == 1);
  return answer_of(result, TreeQuestion::InRange).verdict == Verdict::Violated;
}

struct Judged {
  Verdict verdict{};
  int ticks = 0;
  std::string open;
  bool is_named = false;  // BT1640
};

Judged judged(const std::string& xml, const std::string& rule,
              bool loops = false) {
  TreeInput tree("t.xml", xml);
  tree.reading.loops = loops;
  const CheckResult result =
      check(tree, {{"t.ltl", "property p: " + rule}}, {});
  REQUIRE(result.files.size() == 1);
  const PropertyVerdict& verdict = result.files[0].verdicts.at(0);
  Judged all{verdict.verdict, 0, verdict.open, has_code(result, "BT1640")};
  if (!verdict.run) return all;
  for (const RunStep& step : verdict.run->steps) all.ticks += step.step.elapsed;
  return all;
}

// Of `actions` the first is a leaf that writes `x`, as its contract says.
bool throws_beside_leaf(const std::string& effect, const std::string& actions) {
  TreeInput tree(
      "t.xml", version4("<Sequence>" + actions + "</Sequence>",
                        "<BehaviorTree ID=\"S\"><a/></BehaviorTree>"
                        "<TreeNodesModel><Action ID=\"a\"/></TreeNodesModel>"));
  tree.reading.leaves = {
      {"t.leaves", "(defaction a :on-success (" + effect + "))"}};
  const CheckResult result = check(tree, {}, {});
  REQUIRE(result.files.size() == 1);
  const TreeReport& answer = answer_of(result, TreeQuestion::InRange);
  CHECK(answer.verdict != Verdict::Undecided);
  return answer.verdict == Verdict::Violated;
}

TEST_CASE("an entry takes over the type of what a leaf writes") {
  const std::string text = "(:= x \"b\")";
  const std::string made = script("x := 'a'; y := 'c'");
  const std::string set = "<SetBlackboard value=\"{y}\" output_key=\"x\"/>";
  CHECK_FALSE(throws_beside_leaf(text, made + "<a/>" + set + set));
  CHECK(throws_beside_leaf(text, made + set + set));
  // A text makes an entry without a type.
  CHECK(throws_beside_leaf(text, script("y := 'c'") + "<a/>" + set + set));
  // One that has a type keeps it.
  const std::string typed =
      script("y := 'c'") + "<SetBlackboard value=\"a\" output_key=\"x\"/>";
  CHECK_FALSE(throws_beside_leaf(text, typed + "<a/>" + set + set));
  // So does one of a parent's, to which the key is remapped.
  const std::string below = "<SubTree ID=\"S\" x=\"{x}\"/>";
  CHECK(throws_beside_leaf(text, made + below + set + set));
  // A number is an int, or a double.
  CHECK(throws_beside_leaf("(:= x 2)", "<a/>" + script("x := 0.5")));
  CHECK_FALSE(throws_beside_leaf("(:= x 2)", "<a/>" + script("x := 5")));
}

TEST_CASE("an exception that is certain is a fault") {
  const std::vector<std::string> trees = {
      sequence(script("speed := 1") + script("speed := 0.5")),
      sequence(script("n := 5") + condition("n")),
      sequence(script("x := 2") + condition("x &amp;&amp; true")),
      sequence(script("s := 'a'") + condition("s == 1")),
      sequence(script("s := 'a'") + script("s := 3")),
      sequence(script("x := 5") + script("x /= 2")),
      sequence(script("x := 1") +
               "<SetBlackboard value=\"abc\" output_key=\"x\"/>" +
               condition("x == 1")),
      sequence("<SetBlackboard value=\"7\" output_key=\"x\"/>" +
               script("x := 3")),
      sequence(script("x := 1") + "<UnsetBlackboard key=\"x\"/>" +
               condition("x == 1")),
      sequence(condition("x == 1") + script("x := 1")),
      sequence("<AlwaysSuccess _skipIf=\"x == 1\"/>" + script("x := 1"))};
  for (const std::string& tree : trees) {
    CAPTURE(tree);
    CHECK(throws(tree));
  }
}

TEST_CASE("what does not throw is no fault") {
  const std::vector<std::string> trees = {
      sequence(script("speed := 1.0") + script("speed := 0.5")),
      sequence(script("n := 2 + 3") + condition("n")),  // a double
      sequence(script("n := 1") + condition("n")),
      sequence(script("s := '3a'") + condition("s == 3")),
      sequence(script("x := 4") + script("x /= 2")),
      sequence(script("x := 1") + script("x := '5'") + script("x := 0.5")),
      sequence("<SetBlackboard value=\"7\" output_key=\"x\"/>"
               "<SetBlackboard value=\"8\" output_key=\"x\"/>" +
               condition("x == '8'")),
      sequence(script("x := 1") + "<UnsetBlackboard key=\"x\"/>" +
               script("x := 'a'"))};
  for (const std::string& tree : trees) {
    CAPTURE(tree);
    CHECK_FALSE(throws(tree));
  }
}

// Everything that asks for a truth value (Any::cast<bool>) refuses a negative
// one, whatever made it; `!` and `? :` do not ask for one.
TEST_CASE("a negative number is no truth value, wherever one is asked for") {
  const auto asked_by = [](const std::string& place, const std::string& code) {
    const std::string begin = script("y := 1; x := 2; z := 0.5 - 1; h := 0.5");
    if (place == "ScriptCondition") return sequence(begin + condition(code));
    if (place == "Precondition") {
      return sequence(begin + "<Precondition if=\"" + code +
                      "\" else=\"SUCCESS\"><AlwaysSuccess/></Precondition>");
    }
    return sequence(begin + "<AlwaysSuccess " + place + "=\"" + code + "\"/>");
  };
  const auto fault = [](const std::string& tree, Profile profile) {
    TreeInput input("t.xml", tree);
    input.reading.profile = profile;
    const CheckResult result = check(input, {}, {});
    REQUIRE(result.files.size() == 1);
    return answer_of(result, TreeQuestion::InRange).verdict;
  };
  for (const std::string place :
       {"ScriptCondition", "Precondition", "_failureIf", "_successIf",
        "_skipIf", "_while"}) {
    CAPTURE(place);
    for (const std::string code :
         {"y - x", "z", "-h", "(y - x) || false", "false || (y - x)",
          "true || z", "(y - x) &amp;&amp; true", "false &amp;&amp; z",
          "!(z || true)", "z / 0", "y ? z : h", "w := z", "y += -3"}) {
      CAPTURE(code);
      CHECK(fault(asked_by(place, code), Profile::Btcpp4) == Verdict::Violated);
    }
    for (const std::string code :
         {"!(y - x)", "(y - x) ? true : false", "z &lt; 0", "x - y", "h",
          "h &amp;&amp; x - y", "-z", "0 * z", "-z / 0", "!z || h"}) {
      CAPTURE(code);
      CHECK(fault(asked_by(place, code), Profile::Btcpp4) == Verdict::Holds);
    }
  }
  // Postconditions and Scripts ask for none.
  CHECK(fault(asked_by("_onSuccess", "y - x"), Profile::Btcpp4) ==
        Verdict::Holds);
  CHECK(fault(asked_by("_post", "z"), Profile::Btcpp4) == Verdict::Holds);
  CHECK(fault(asked_by("_onSuccess", "z || y"), Profile::Btcpp4) ==
        Verdict::Violated);
  for (const Profile profile :
       {Profile::Btcpp41, Profile::Btcpp43, Profile::Btcpp46, Profile::Btcpp48,
        Profile::Nav2Jazzy}) {
    CHECK(fault(asked_by("Precondition", "y - x"), profile) ==
          Verdict::Violated);
    CHECK(fault(asked_by("_skipIf", "z || true"), profile) ==
          Verdict::Violated);
    CHECK(fault(asked_by("_skipIf", "!z || h"), profile) == Verdict::Holds);
  }
}

TEST_CASE("a number given to a subtree gives its entry a type") {
  const std::string inside =
      "<BehaviorTree ID=\"S\"><Switch2 variable=\"{mode}\" case_1=\"1\" "
      "case_2=\"2\"><AlwaysSuccess/><AlwaysFailure/><AlwaysSuccess/></Switch2>"
      "</BehaviorTree>";
  const auto refused = [&](const std::string& mode) {
    TreeInput tree(
        "t.xml", version4("<SubTree ID=\"S\" mode=\"" + mode + "\"/>", inside));
    tree.reading.profile = Profile::Btcpp4;
    const CheckResult result = check(tree, {}, {});
    return has_code(result, "BT1616");
  };
  CHECK(refused("1"));
  CHECK(refused("0.5"));
  CHECK_FALSE(refused("one"));
}

TEST_CASE("a counterexample over many values is the engine's own") {
  const auto counts_down = [](int from) {
    return sequence(script("battery := " + std::to_string(from)) +
                    "<KeepRunningUntilFailure><Sequence>" +
                    script("battery -= 1") + condition("battery > 20") +
                    "</Sequence></KeepRunningUntilFailure>");
  };
  for (const int from : {100, 125, 126, 200, 2000}) {
    CAPTURE(from);
    const Judged found = judged(counts_down(from), "never asks.failure");
    CHECK(found.verdict == Verdict::Violated);
    CHECK(found.ticks == from - 20);
  }
  const Judged many = judged(counts_down(50'000), "never asks.failure");
  CHECK(many.verdict == Verdict::Undecided);
  CHECK(many.is_named);
  CHECK(many.open.find("`battery > 20` cannot be false: battery is 49999") !=
        std::string::npos);
  // What holds needs no values.
  const Judged holds = judged(counts_down(50'000), "never root.success");
  CHECK(holds.verdict == Verdict::Holds);
}

TEST_CASE("values beyond the numbers in the scripts") {
  CHECK(judged(sequence(script("y := 64") + condition("y == 64") +
                        script("y /= 2")),
               "never asks.failure")
            .verdict == Verdict::Holds);
  CHECK(judged(sequence(script("x:=2; y:=x+x") + condition("y == x+x")),
               "never asks.failure")
            .verdict == Verdict::Holds);
}

TEST_CASE("entries of version 3 keep what SetBlackboard writes") {
  const std::string old =
      "<root main_tree_to_execute=\"T\"><BehaviorTree ID=\"T\"><Sequence>"
      "<SetBlackboard value=\"0\" output_key=\"u\"/>"
      "<BlackboardCheckInt name=\"asks\" value_A=\"{u}\" value_B=\"0\" "
      "return_on_mismatch=\"FAILURE\"><AlwaysSuccess/></BlackboardCheckInt>"
      "</Sequence></BehaviorTree></root>";
  CHECK(judged(old, "never asks.failure", true).verdict == Verdict::Holds);
  CHECK(judged(old, "possible asks.success").verdict == Verdict::Holds);
}

}  // namespace
}  // namespace btcheck::entry_types_test
