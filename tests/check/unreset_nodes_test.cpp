// SPDX-License-Identifier: MIT
//
// What nodes of XML trees keep where they are ticked again and nobody has reset
// them, or where they are reset and not halted, told by verdicts. Each rule had
// another verdict once.
#include <doctest/doctest.h>

#include <string>

#include "check/asked.hpp"

namespace btcheck::unreset_nodes_test {
namespace {

// A child that is skipped on every tick, below nodes that run on meanwhile.
const std::string kSkipped = "<AlwaysSuccess _skipIf=\"true\"/>";

}  // namespace

TEST_CASE("a RecoveryNode halts a recovery that is skipped and runs on") {
  const std::string tree =
      "<Sequence><Script code=\"x := 0\"/><RecoveryNode "
      "number_of_retries=\"1\">"
      "<AlwaysFailure/><Inverter _onHalted=\"x := 7\">" +
      kSkipped + "</Inverter></RecoveryNode></Sequence>";
  for (const Profile profile : {Profile::Nav2Main, Profile::Nav2Jazzy}) {
    CHECK(verdicts({tree, "", profile}, "prove never x == 7\n") == "V");
  }
}

TEST_CASE("the queue of a Loop is loaded in a tick that finds it idle") {
  const std::string tree =
      "<IfThenElse><LoopInt queue=\"1;2\" _failureIf=\"true\">"
      "<AlwaysSuccess name=\"n3\"/></LoopInt><AlwaysSuccess name=\"n4\"/>"
      "</IfThenElse>";
  CHECK(verdicts({tree},
                 "prove n3.ticked precedes n4.ticked\n"
                 "prove never n3.ticked\nprove possible n4.ticked\n") == "VHH");
}

TEST_CASE("children that are skipped are counted on after a failure") {
  const std::string begin = "<IfThenElse>";
  const std::string end = "<A/></IfThenElse>";
  CHECK(verdicts({begin + "<Sequence name=\"s\">" + kSkipped +
                  "<C/></Sequence>" + end},
                 "prove never s.skipped\n") == "V");
  CHECK(verdicts({begin + "<TryCatch name=\"s\">" + kSkipped +
                  "<C/><B/></TryCatch>" + end},
                 "prove never s.skipped\n") == "V");
  // Where it is reset in between, it is not.
  CHECK(verdicts({"<Sequence name=\"s\">" + kSkipped + "<C/></Sequence>"},
                 "prove never s.skipped\n") == "H");
}

TEST_CASE("a TryCatch counts more children as skipped than it has") {
  CHECK(verdicts({"<IfThenElse><TryCatch name=\"s\">" + kSkipped +
                      "<C/><B/></TryCatch><A/></IfThenElse>",
                  "(defcondition C :returns (failure skipped))"},
                 "prove possible s.skipped\nprove possible s.failure\n") ==
        "HH");
}

TEST_CASE("a WhileDoElse resets its children before it throws") {
  const std::string tree =
      "<Sequence><Script code=\"x := 0; y := 0\"/><WhileDoElse><ForceSuccess>"
      "<AlwaysSuccess _skipIf=\"y == 1\" _onSuccess=\"y := 1\"/></ForceSuccess>"
      "<A _onHalted=\"x := 7\"/></WhileDoElse></Sequence>";
  CHECK(verdicts({tree}, "prove never x == 7\n") == "V");
}

// SubTreeNode::tick calls setStatus(RUNNING) only where it is idle: one that
// has ended keeps that when its child is skipped, is not halted when it is
// reset, and its child runs on. An Inverter, which calls it always, is.
TEST_CASE("a SubTree that has ended, and is skipped, is reset without a halt") {
  const std::string child =
      "<Sequence name=\"seq\" _onHalted=\"x := 1\"><RunOnce><AlwaysSuccess/>"
      "</RunOnce></Sequence>";
  const std::string begin =
      "<Sequence><RunOnce><Script code=\"x := 0\"/></RunOnce>";
  const auto told = [&](const std::string& decorated) {
    Asked asked{begin + "<PipelineSequence name=\"p\">" + decorated +
                    "<A/></PipelineSequence></Sequence>",
                "", Profile::Nav2Main};
    asked.models = "<BehaviorTree ID=\"S\">" + child + "</BehaviorTree>";
    return verdicts(asked,
                    "prove every tick: p.answered success and "
                    "seq.answered skipped => x == 1\n"
                    "prove possible seq.skipped\n");
  };
  const std::string sub = "<SubTree ID=\"S\" x=\"{x}\"/>";
  CHECK(told(sub) == "VH");
  // One that begins in a tick in which its child is skipped does run.
  CHECK(told("<ForceSuccess>" + sub + "</ForceSuccess>") == "HH");
  CHECK(told("<IfThenElse><AlwaysSuccess/>" + sub + "</IfThenElse>") == "HH");
}

TEST_CASE("a node that has ended and is skipped has still ended") {
  // Its precondition is not asked again, though x is 1 by then.
  const std::string tree =
      "<Sequence><Script code=\"x := 0\"/><PipelineSequence>"
      "<RunOnce name=\"r\" _failureIf=\"x == 1\"><Script code=\"x := 1\"/>"
      "</RunOnce><A/></PipelineSequence></Sequence>";
  CHECK(verdicts({tree, "(defaction A :returns (running))", Profile::Nav2Main},
                 "prove never r.failure\nprove possible r.skipped\n") == "HH");
}

TEST_CASE("a GoalUpdater whose child is skipped does not run") {
  const std::string tree =
      "<Sequence><Script code=\"x := 0\"/><GoalUpdater _onHalted=\"x := 7\">" +
      kSkipped + "</GoalUpdater><A/></Sequence>";
  CHECK(verdicts({tree, "", Profile::Nav2Main}, "prove never x == 7\n") == "H");
}

TEST_CASE("a DistanceController may lose the pose once its child is done") {
  const std::string tree =
      "<Sequence><Script code=\"x := 0; y := 0\"/>"
      "<DistanceController _onFailure=\"x := y\"><A _onSuccess=\"y := 1\"/>"
      "</DistanceController></Sequence>";
  CHECK(verdicts({tree, "(defaction A :returns (success))", Profile::Nav2Main},
                 "prove never x == 1\n") == "V");
}

TEST_CASE("a SpeedController of galactic keeps its period") {
  const auto said = [](Profile profile) {
    return verdicts(
        {"<Repeat num_cycles=\"2\"><SpeedController name=\"s\"><A/>"
         "</SpeedController></Repeat>",
         "(defaction A :returns (success))", profile},
        "prove never s.running\nprove A.ticked precedes s.running\n");
  };
  CHECK(said(Profile::Nav2Galactic) == "VH");
  CHECK(said(Profile::Nav2Humble) == "HH");
}

TEST_CASE("a PauseResumeController is asked to pause while it is pausing") {
  const std::string tree =
      "<PauseResumeController><Work/><Rest/><Stop/><Go/></"
      "PauseResumeController>";
  CHECK(verdicts({tree, "", Profile::Nav2Main},
                 "prove never Stop.halted\nprove never Go.halted\n"
                 "prove never Work.ticked and Rest.status == running\n") ==
        "VVH");
}

TEST_CASE("a RateController that no tick has begun knows no period") {
  const std::string tree =
      "<PipelineSequence><RateController hz=\"5\" _successIf=\"true\"><A/>"
      "</RateController><B/></PipelineSequence>";
  CHECK(verdicts({tree, "", Profile::Nav2Main}, "prove never A.ticked\n") ==
        "V");
}

TEST_CASE("a time of no length may be up in its first tick or in the next") {
  const std::string leaves = "(defaction A :returns (success))";
  CHECK(verdicts({"<Delay name=\"d\" delay_msec=\"0\"><A/></Delay>", leaves},
                 "prove never d.running\nprove d.running precedes A.ticked\n"
                 "prove d.ticked leadsto A.ticked within 1 tick\n"
                 "prove d.ticked leadsto A.ticked within 0 ticks\n") == "VVHV");
  CHECK(verdicts({"<Delay name=\"d\" delay_msec=\"{t}\"><A/></Delay>", leaves},
                 "prove d.running precedes A.ticked\n") == "V");
  CHECK(verdicts({"<Sleep name=\"s\" msec=\"{t}\"/>"},
                 "prove s.running precedes s.success\n") == "V");
}

TEST_CASE("children of unknown nodes may have been reset") {
  // The engine resets the child of a decorator, a control node may do it.
  const std::string leaves =
      "(defaction A :answers once :on-success ((:= x 1)) "
      ":on-failure ((:= y x)))";
  const std::string begin = "<Sequence><Script code=\"x := 0; y := 0\"/>";
  const std::string rule = "prove never y == 1\n";
  CHECK(verdicts({begin + "<Mine><A/></Mine></Sequence>", leaves}, rule) ==
        "V");
  CHECK(verdicts({begin + "<Mine><A/><B/></Mine></Sequence>", leaves}, rule) ==
        "V");
  CHECK(verdicts({begin + "<Mine><B _onHalted=\"x := 2; y := 1\"/><A/></Mine>"
                          "</Sequence>",
                  leaves},
                 "prove never x == 1 and y == 1\n") == "V");
}

TEST_CASE("a PersistentSequence begins where its entry says") {
  const std::string tree =
      "<Sequence><Script code=\"i := 1\"/><PersistentSequence "
      "current_child_idx=\"{i}\"><A/><B/></PersistentSequence></Sequence>";
  CHECK(verdicts({tree, "", Profile::Nav2Main},
                 "prove A.ticked precedes B.ticked\n") == "V");
}

}  // namespace btcheck::unreset_nodes_test
