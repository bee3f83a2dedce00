// SPDX-License-Identifier: MIT
#include "model/tree/leaf_names.hpp"

#include <doctest/doctest.h>

namespace btcheck::leaf_names_test {
namespace {

TEST_CASE("names that ask are told from names that act") {
  for (const std::string_view asks :
       {"IsReady",     "isReady",        "is_ready",    "AreDoorsShut",
        "HasPath",     "have_goal",      "CanReach",    "ShouldDock",
        "NeedsCharge", "WasSeen",        "CheckTorque", "verify-grip",
        "BatteryOK",   "BatteryOk",      "battery_ok",  "BATTERY_LOW",
        "GoalReached", "MapAvailable",   "DoorOpen",    "DoorClosed",
        "TimeExpired", "AltitudeAbove3", "BelowLimit",  "ISOCheck",
        "IsStatusOK"}) {
    CAPTURE(asks);
    CHECK(sounds_like_condition(asks));
  }
  for (const std::string_view acts : {"",
                                      "_",
                                      "Is",
                                      "Check",
                                      "Issue",
                                      "Island",
                                      "IssueTicket",
                                      "Hasten",
                                      "CannedFood",
                                      "OpenDoor",
                                      "CloseDoor",
                                      "SetEnabled",
                                      "WaitUntilReady",
                                      "CheckAndStandUp",
                                      "Lower",
                                      "Grasp",
                                      "MoveAbove",
                                      "isready",
                                      "Ready",
                                      "AreaScan",
                                      "FollowPath"}) {
    CAPTURE(acts);
    CHECK_FALSE(sounds_like_condition(acts));
  }
}

}  // namespace
}  // namespace btcheck::leaf_names_test
