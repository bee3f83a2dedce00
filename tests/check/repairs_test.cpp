// SPDX-License-Identifier: MIT
//
// Repairs are tried, and told where they hold: one that does not help is not,
// nor one that breaks a rule or brings another finding.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "check/repairs/problems.hpp"
#include "check/repairs/repairs.hpp"

namespace btcheck::repairs_test {
namespace {

std::string tree_of(const std::string& nodes) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">\n"
         "<BehaviorTree ID=\"T\">\n" +
         nodes +
         "</BehaviorTree>\n"
         "</root>\n";
}

CheckResult checked(const std::string& nodes,
                    const std::vector<InputFile>& rules = {},
                    const CheckOptions& options = {}) {
  CheckResult result =
      check_and_repair(TreeInput("t.xml", tree_of(nodes)), rules, options);
  REQUIRE(result.files.size() > 0);
  return result;
}

std::string diff(const std::optional<CheckedRepair>& repair) {
  if (!repair) return "none";
  std::string text = repair->comes_from;
  for (const std::string& line : diff_lines(*repair, 99)) {
    text += line + "\n";
  }
  return text;
}

// That of the first finding of a code.
std::string repair_of(const CheckResult& result, std::string_view code) {
  for (const TreeFinding& each : result.files[0].findings) {
    if (each.code == code) return diff(each.repair);
  }
  return "no such finding";
}

const std::string kRetry =
    "<Fallback>\n"
    "<RetryUntilSuccessful num_attempts=\"-1\">\n"
    "<Action ID=\"OpenDoor\"/>\n"
    "</RetryUntilSuccessful>\n"
    "<Action ID=\"CallPorter\"/>\n"
    "</Fallback>\n";
const std::string kFiveAttempts =
    "@@ -3,3 +3,3 @@\n"
    " <Fallback>\n"
    "-<RetryUntilSuccessful num_attempts=\"-1\">\n"
    "+<RetryUntilSuccessful num_attempts=\"5\">\n"
    " <Action ID=\"OpenDoor\"/>\n";

TEST_CASE("a repair that helps is told as a diff") {
  CHECK(repair_of(checked(kRetry), "BT2215") == kFiveAttempts);
}

TEST_CASE("no repair is tried where none is asked for, or nothing is left") {
  CheckOptions options;
  options.tries_repairs = false;
  CHECK(repair_of(checked(kRetry, {}, options), "BT2215") == "none");
}

TEST_CASE("a search that was not complete has no repairs") {
  CheckOptions options;
  options.limits.max_states = 3;
  for (const TreeFinding& each :
       checked(kRetry, {}, options).files[0].findings) {
    CHECK_FALSE(each.repair);
  }
}

// Time and memory are half used up from the beginning.
class Busy : public SearchMonitor {
 public:
  StopReason observe(const SearchProgress&) override {
    return StopReason::None;
  }
  bool has_spare() override { return false; }
};

TEST_CASE("without spare time no repair is tried") {
  Busy busy;
  CheckOptions options;
  options.limits.monitor = &busy;
  CHECK(repair_of(checked(kRetry, {}, options), "BT2215") == "none");
}

TEST_CASE("a repair that breaks a rule is not told") {
  const InputFile holds{"r.ltl", "property p: never CallPorter.ticked\n"};
  const CheckResult result = checked(kRetry, {holds});
  REQUIRE(result.files[0].verdicts[0].verdict == Verdict::Holds);
  CHECK(repair_of(result, "BT2215") == "none");
  const InputFile other{"r.ltl", "property p: possible OpenDoor.success\n"};
  CHECK(repair_of(checked(kRetry, {other}), "BT2215") == kFiveAttempts);
}

// `IsLow` is asked while B runs; BT2208 of the RoundRobin proposes an attribute
// that changes none of it, BT2207 of the Inverter a Fallback that would.
TEST_CASE("a repair that takes a guard away is not told") {
  const std::string watched =
      "<Inverter>\n"
      "<ReactiveSequence>\n"
      "<Condition ID=\"IsLow\"/>\n"
      "<Action ID=\"B\"/>\n"
      "</ReactiveSequence>\n"
      "</Inverter>\n";
  CHECK(repair_of(checked(watched), "BT2207") == "none");
  const std::string asked_once =
      "<Inverter>\n"
      "<Sequence>\n"
      "<Condition ID=\"IsLow\"/>\n"
      "<Action ID=\"B\"/>\n"
      "</Sequence>\n"
      "</Inverter>\n";
  CHECK(repair_of(checked(asked_once), "BT2207") != "none");
}

// A step of which nobody knows that it may count as done is left to its owner.
TEST_CASE("a low battery does not come to count as success") {
  const auto step = [](const std::string& type, const std::string& asks,
                       const std::string& acts) {
    return "<Sequence>\n<" + type + ">\n<Inverter>\n<Condition ID=\"" + asks +
           "\"/>\n</Inverter>\n<Action ID=\"" + acts + "\"/>\n</" + type +
           ">\n<Action ID=\"Report\"/>\n</Sequence>\n";
  };
  const auto repair = [&](const std::string& tree) {
    return repair_of(checked(tree), "BT2208");
  };
  CHECK(repair(step("Sequence", "check_battery", "mission")) == "none");
  const std::string done = repair(step("Sequence", "IsDoorOpen", "OpenDoor"));
  CHECK(done.find("+<Fallback>") != done.npos);
  // Watched while the door is opened, it would be asked no more.
  CHECK(repair(step("ReactiveSequence", "IsDoorOpen", "OpenDoor")) == "none");
}

// Of two children that can never succeed, none is left to ask for.
TEST_CASE("a repair that does not help is not told") {
  const std::string never =
      "<Parallel success_count=\"2\" failure_count=\"2\">\n"
      "<ForceFailure><Action ID=\"A\"/></ForceFailure>\n"
      "<ForceFailure><Action ID=\"B\"/></ForceFailure>\n"
      "</Parallel>\n";
  const CheckResult stuck = checked(never);
  CHECK(repair_of(stuck, "BT2202") == "none");
  // The text that is near is put in, and the condition fails all the same.
  const std::string spelt =
      "<Sequence>\n"
      "<Script code=\"mode := 'night'; other := 1\"/>\n"
      "<ScriptCondition code=\"mode == 'nights' &amp;&amp; other == 2\"/>\n"
      "<Action ID=\"Go\"/>\n"
      "</Sequence>\n";
  CHECK(repair_of(checked(spelt), "BT2204") == "none");
  CHECK(!checked(spelt).files[0].findings[0].repairs.empty());
}

// The Sequence that is proposed has the Action done once, but then the battery
// is not asked again while the next one runs.
TEST_CASE("a repair that brings another finding is not told") {
  const std::string models =
      "<TreeNodesModel>\n"
      "<Action ID=\"Drive\"/>\n"
      "<Action ID=\"Speak\"/>\n"
      "<Condition ID=\"BatteryOk\"/>\n"
      "</TreeNodesModel>\n";
  std::string text = tree_of(
      "<ReactiveSequence>\n"
      "<Speak/>\n"
      "<BatteryOk/>\n"
      "<Drive/>\n"
      "</ReactiveSequence>\n");
  text.insert(text.find("<BehaviorTree"), models);
  const CheckResult result =
      check_and_repair(TreeInput("t.xml", text), {}, CheckOptions{});
  REQUIRE(result.files.size() == 1);
  REQUIRE(result.files[0].findings.size() > 0);
  const TreeFinding& finding = result.files[0].findings[0];
  CHECK(finding.code == "BT2211");
  CHECK(finding.repairs.size() == 1);
  CHECK_FALSE(finding.repair);
}

TEST_CASE("a finding that the repair of another mends says so") {
  const CheckResult result = checked(
      "<Sequence>\n"
      "<Script code=\"sonar_ok := false\"/>\n"
      "<ForceSuccess>\n"
      "<Sequence>\n"
      "<Condition ID=\"IsSonarAnswering\"/>\n"
      "<Script code=\"sonar_okay := true\"/>\n"
      "</Sequence>\n"
      "</ForceSuccess>\n"
      "<ScriptCondition code=\"sonar_ok\"/>\n"
      "<Action ID=\"Go\"/>\n"
      "</Sequence>\n");
  const auto misspelt =
      std::ranges::find(result.diagnostics, "BT1628", &Diagnostic::code);
  REQUIRE(misspelt != result.diagnostics.end());
  CHECK(diff(misspelt->repair) ==
        "@@ -7,3 +7,3 @@\n"
        " <Condition ID=\"IsSonarAnswering\"/>\n"
        "-<Script code=\"sonar_okay := true\"/>\n"
        "+<Script code=\"sonar_ok := true\"/>\n"
        " </Sequence>\n");
  CHECK(repair_of(result, "BT2204").starts_with("BT1628 in line 8@@"));
}

TEST_CASE("the file that is included is the one that is edited") {
  TreeInput tree("t.xml",
                 "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">\n"
                 "<include path=\"other.xml\"/>\n"
                 "<BehaviorTree ID=\"T\">\n"
                 "<SubTree ID=\"Door\"/>\n"
                 "</BehaviorTree>\n"
                 "</root>\n");
  std::string other = tree_of(kRetry);
  other.replace(other.find("ID=\"T\""), 6, "ID=\"Door\"");
  other.replace(other.find(" main_tree_to_execute=\"T\""), 25, "");
  tree.reading.included = {{"other.xml", other}};
  const CheckResult result = check_and_repair(tree, {}, {});
  REQUIRE(result.files.size() == 1);
  REQUIRE(result.files[0].findings.size() > 0);
  const auto& repair = result.files[0].findings[0].repair;
  REQUIRE(repair);
  CHECK(repair->files[0].file == "other.xml");
  CHECK(diff(repair) == kFiveAttempts);
}

TEST_CASE("a .btf tree is repaired in its own language") {
  const std::string text =
      "(BehaviorTree :name t\n"
      "  (Parallel :success 2\n"
      "    (ForceFailure (Action :ID a))\n"
      "    (Action :ID b)))\n";
  const CheckResult result =
      check_and_repair(TreeInput("t.btf", text), {}, CheckOptions{});
  REQUIRE(result.files.size() == 1);
  CHECK(repair_of(result, "BT2202") ==
        "@@ -1,3 +1,3 @@\n"
        " (BehaviorTree :name t\n"
        "-  (Parallel :success 2\n"
        "+  (Parallel :success 1\n"
        "     (ForceFailure (Action :ID a))\n");
}

}  // namespace

}  // namespace btcheck::repairs_test
