// SPDX-License-Identifier: MIT
//
// Which names are taken for misspellings of one another.
#include <doctest/doctest.h>

#include "model/btcpp/expand/spelling.hpp"

namespace btcheck::btcpp {
namespace {

TEST_CASE("one slip of the finger") {
  CHECK(is_one_slip("waypoint", "waypiont"));
  CHECK(is_one_slip("waypoint", "waypont"));
  CHECK(is_one_slip("waypoint", "wayppoint"));
  CHECK(is_one_slip("waypoint", "waypoimt"));
  CHECK(is_one_slip("waypoint", "xwaypoint"));
}

TEST_CASE("names that are meant to differ") {
  CHECK(!is_one_slip("waypoint", "waypoint"));
  CHECK(!is_one_slip("waypoint", "waypoints"));
  CHECK(!is_one_slip("waypoint1", "waypoint2"));
  CHECK(!is_one_slip("waypoint", "waypoint2"));
  CHECK(!is_one_slip("pose_a", "pose_bc"));
  CHECK(!is_one_slip("goal", "gaol"));
  CHECK(!is_one_slip("", ""));
}

TEST_CASE("capitals and underscores are folded away") {
  CHECK(folded_name("nearGoal") == folded_name("near__goal"));
  CHECK(folded_name("near") != folded_name("fear"));
}

}  // namespace
}  // namespace btcheck::btcpp
