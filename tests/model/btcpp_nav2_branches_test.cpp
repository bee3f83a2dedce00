// SPDX-License-Identifier: MIT
//
// What a branch of Nav2 that is named does not have.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "model/tree_file.hpp"

namespace btcheck::btcpp_nav2_branches_test {
namespace {

// Those of a code, in the order in which they are said.
std::vector<Diagnostic> said(const std::string& inside,
                             std::optional<Profile> profile,
                             const std::string& code) {
  TreeReading reading;
  reading.profile = profile;
  auto found = read_tree("t.xml",
                         "<root main_tree_to_execute=\"M\">"
                         "<BehaviorTree ID=\"M\">" +
                             inside + "</BehaviorTree></root>",
                         reading)
                   .diagnostics;
  std::erase_if(found, [&](const auto& each) { return each.code != code; });
  return found;
}

const std::string kNear = "<Sequence><ArePosesNear/><ArePosesNear/></Sequence>";
const std::string kRound =
    "<RoundRobin wrap_around=\"true\"><Wait/></RoundRobin>";

TEST_CASE("a node of another branch is warned of once") {
  const auto found = said(kNear, Profile::Nav2Humble, "BT1654");
  REQUIRE(found.size() == 1);
  CHECK(found[0].severity == Severity::Warning);
  CHECK(found[0].message == "nav2-humble has no node `ArePosesNear`");
  CHECK(found[0].help ==
        "it is a node of `nav2-jazzy`, `nav2-kilted`, `nav2-lyrical` and "
        "`nav2-main`");
  CHECK(said(kNear, Profile::Nav2Jazzy, "BT1654").empty());
  CHECK(said(kNear, Profile::Nav2Main, "BT1654").empty());
  CHECK(said(kNear, Profile::Btcpp4, "BT1654").empty());
  CHECK(said(kNear, {}, "BT1654").empty());
}

TEST_CASE("a port of another branch is refused") {
  const auto found = said(kRound, Profile::Nav2Kilted, "BT1609");
  REQUIRE(found.size() == 1);
  CHECK(found[0].severity == Severity::Error);
  CHECK(found[0].message ==
        "`RoundRobin` of nav2-kilted has no port `wrap_around`");
  CHECK(found[0].help ==
        "delete it; it is a port of `nav2-lyrical` and `nav2-main`");
  CHECK(said(kRound, Profile::Nav2Lyrical, "BT1609").empty());
  CHECK(said(kRound, Profile::Nav2Main, "BT1609").empty());
  CHECK(said(kRound, {}, "BT1609").empty());
}

TEST_CASE("galactic has ports and nodes of its own") {
  const std::string speed =
      "<SpeedController filter_duration=\"0.3\"><Wait/></SpeedController>";
  CHECK(said(speed, Profile::Nav2Galactic, "BT1609").empty());
  const auto found = said(speed, Profile::Nav2Humble, "BT1609");
  REQUIRE(found.size() == 1);
  CHECK(found[0].help == "delete it; it is a port of `nav2-galactic`");
  const auto guess = said(speed, {}, "BT1637");
  REQUIRE(guess.size() == 1);
  CHECK(guess[0].message == "nodes of Nav2: checked as `nav2-galactic`");
  CHECK(said("<Spin time_allowance=\"5\"/>", Profile::Nav2Galactic, "BT1609")
            .size() == 1);
  CHECK(said("<SmoothPath/>", Profile::Nav2Galactic, "BT1654").size() == 1);
}

}  // namespace
}  // namespace btcheck::btcpp_nav2_branches_test
