// SPDX-License-Identifier: MIT
//
// What leaf contracts beside an XML tree mean, told by verdicts.
#include <doctest/doctest.h>

#include <string>

#include "check/asked.hpp"

namespace btcheck::leaf_rules_test {
namespace {

std::string verdicts(const std::string& tree, const std::string& leaves,
                     const std::string& rules,
                     Profile profile = Profile::Btcpp4) {
  return verdicts(Asked{tree, leaves, profile, false}, rules);
}

TEST_CASE("an action answers what its contract allows and nothing else") {
  const std::string rules =
      "prove never A.success\nprove never A.failure\n"
      "prove never A.running\nprove never A.skipped\n";
  const std::string tree = "<Sequence><A/><B/></Sequence>";
  CHECK(verdicts(tree, "", rules) == "VVVH");
  CHECK(verdicts(tree, "(defaction A :returns (success))", rules) == "VHHH");
  CHECK(verdicts(tree, "(defaction A :returns (failure running))", rules) ==
        "HVVH");
  CHECK(verdicts(tree, "(defaction A :returns (running skipped))", rules) ==
        "HHVV");
}

TEST_CASE("an answer stands until the reset, or is given anew") {
  // A PipelineSequence ticks what has succeeded again.
  const std::string tree = "<PipelineSequence><A/><B/></PipelineSequence>";
  const std::string rules = "prove never A.failure and B.status == running\n";
  const auto told = [&](const std::string& leaves) {
    return verdicts(tree, leaves, rules, Profile::Nav2Main);
  };
  CHECK(told("") == "V");
  CHECK(told("(defaction A :answers anew)") == "V");
  CHECK(told("(defaction A :answers once)") == "H");
}

TEST_CASE("an action with a duration runs for so many ticks") {
  const auto told = [](const std::string& duration, const std::string& rule) {
    return verdicts("<A/>", "(defaction A :duration " + duration + ")",
                    "prove " + rule + "\n");
  };
  CHECK(told("[2,5]", "A.ticked leadsto root.ended within 5 ticks") == "H");
  CHECK(told("[2,5]", "A.ticked leadsto root.ended within 4 ticks") == "V");
  CHECK(told("[2,5]", "possible A.success") == "H");
  CHECK(told("0", "never A.running") == "H");
  CHECK(told("1", "possible A.running") == "H");
  CHECK(told("3", "A.ticked leadsto root.ended within 3 ticks") == "H");
  CHECK(told("3", "A.ticked leadsto root.ended within 2 ticks") == "V");
}

TEST_CASE("a halted action begins its time anew") {
  const std::string tree = "<ReactiveSequence><C/><A/></ReactiveSequence>";
  const std::string leaves =
      "(defaction C :returns (success running))(defaction A :duration 2)";
  CHECK(verdicts(tree, leaves,
                 "prove A.halted forbids A.success within [0,2]\n"
                 "prove A.halted forbids A.success within [0,3]\n"
                 "prove possible A.success\n") == "HVH");
}

TEST_CASE("a leaf does what it requires and leaves what it assigns") {
  const std::string tree =
      "<Sequence><Charge/><Fly/><Script code=\"done := 1\"/></Sequence>";
  const std::string rules =
      "prove never Fly.success and battery != \"full\"\n"
      "prove possible Fly.failure\nprove never Fly.ticked\n";
  const auto told = [&](const std::string& leaves) {
    return verdicts(tree, leaves, rules);
  };
  const std::string charge =
      "(defaction Charge :on-success ((:= battery \"full\")))";
  CHECK(told(charge + "(defaction Fly :returns (success running)"
                      " :requires (= battery \"full\"))") == "HVV");
  CHECK(told(charge + "(defaction Fly :returns (success running)"
                      " :requires (= battery \"empty\"))") == "HHV");
  CHECK(told(charge + "(defaction Fly :on-failure ((:= battery \"no\")))") ==
        "HHV");
  CHECK(told(charge + "(defaction Fly :on-success ((:= battery \"no\")))") ==
        "VHV");
}

TEST_CASE("a requirement that may be met or not leaves both") {
  // What nothing writes is not known.
  const std::string rules =
      "prove possible A.success\nprove possible A.failure\n";
  const auto told = [&](const std::string& leaves) {
    return verdicts("<A/>", leaves, rules);
  };
  CHECK(told("(defaction A :returns (success) :requires (> x 3))") == "HH");
  CHECK(told("(defaction A :returns (success running) :requires (> x 3) "
             ":duration 2)") == "HH");
}

TEST_CASE("what an entry holds at first is known, when a contract says it") {
  // Each time round takes one of the level's three.
  CHECK(verdicts("<Repeat num_cycles=\"-1\"><A/></Repeat>",
                 "(defsv level :init 3)"
                 "(defaction A :returns (success) :requires (> level 1)"
                 " :on-success ((:= level (- level 1))))",
                 "prove possible level == 1\n"
                 "prove never A.failure and level != 1\n"
                 "prove possible A.failure\n") == "HHH");
}

TEST_CASE("a condition of Nav2 can be bound to what an action has left") {
  const std::string tree =
      "<RecoveryNode number_of_retries=\"1\"><FollowPath/><Sequence>"
      "<WouldAControllerRecoveryHelp/><ClearEntireCostmap/></Sequence>"
      "</RecoveryNode>";
  const std::string rules =
      "prove never WouldAControllerRecoveryHelp.failure\n";
  const std::string leaves =
      "(defaction FollowPath :on-success ((:= code 0))"
      " :on-failure ((:= code 104)))"
      "(defcondition WouldAControllerRecoveryHelp :returns (success)"
      " :requires (> code 0))";
  CHECK(verdicts(tree, "", rules, Profile::Nav2Jazzy) == "V");
  CHECK(verdicts(tree, leaves, rules, Profile::Nav2Jazzy) == "H");
}

TEST_CASE("effects stay where the memory of a condition answers") {
  const std::string tree =
      "<Sequence><TransformAvailable/><FollowPath/></Sequence>";
  const std::string leaves =
      "(defcondition TransformAvailable :requires (= map \"loaded\")"
      " :on-failure ((:= map \"loaded\")))";
  CHECK(verdicts(tree, leaves,
                 "prove never FollowPath.ticked and map == \"unknown\"\n"
                 "prove possible FollowPath.ticked\n",
                 Profile::Nav2Main) == "VH");
}

}  // namespace
}  // namespace btcheck::leaf_rules_test
