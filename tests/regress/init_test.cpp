// SPDX-License-Identifier: MIT
//
// `btcheck init`: what it writes passes as it is, and says what holds.
#include <doctest/doctest.h>

#include <string>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::init_test {
namespace {

const std::string kRoot = BTCHECK_SOURCES;
const std::string kProgram = "'" BTCHECK_PROGRAM "'";

// The rules proposed for a tree, written to `rules.ltl`.
std::string proposed(const TemporaryFolder& folder, const std::string& tree,
                     const std::string& options = {}) {
  const Outcome made =
      run_in(folder.path(), kProgram + " init -q '" + kRoot + "/" + tree +
                                "' " + options + " -o rules.ltl 2>/dev/null");
  CAPTURE(made.text);
  CHECK(made.code == 0);
  return file_text(folder.path() / "rules.ltl");
}

}  // namespace

TEST_CASE("proposed rules hold as they stand") {
  for (const std::string tree :
       {"examples/drone3.btf", "examples/train.btf", "examples/mars_rover.btf",
        "examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.xml",
        "examples/nav2/jazzy/navigate_to_pose_w_replanning_and_recovery.xml",
        "examples/nav2/humble/navigate_to_pose_w_replanning_and_recovery"
        ".xml"}) {
    CAPTURE(tree);
    const TemporaryFolder folder;
    const std::string rules = proposed(folder, tree);
    CHECK(rules.find("\nproperty can_succeed:\n    possible root.success\n") !=
          std::string::npos);
    const Outcome checked =
        run_in(folder.path(), kProgram + " -q rules.ltl 2>&1");
    CAPTURE(rules);
    CAPTURE(checked.text);
    CHECK(checked.code == 0);
    CHECK(checked.text.find("0 violated, 0 undecided") != std::string::npos);
    CHECK(checked.text.find("vacuously") == std::string::npos);
  }
}

TEST_CASE("what does not hold is a question, with its run") {
  const TemporaryFolder folder;
  const std::string rules = proposed(folder, "examples/drone3.btf");
  const auto says = [&](const std::string& text) {
    return rules.find(text) != std::string::npos;
  };
  CHECK(
      says("# Not so, is it meant? While `goto_waypoint@27` runs, `Eval24` is "
           "asked in each\n# tick, and answers success.\n#     tick 1   "));
  CHECK(says("\n# property goto_waypoint_watched:\n"));
  CHECK(
      says("\n## `land@46` is begun only after `goto_waypoint@45` has "
           "succeeded.\nproperty land_in_order:\n"));
}

TEST_CASE("rules proposed within limits say what is not known") {
  const TemporaryFolder folder;
  const Outcome made = run_in(
      folder.path(), kProgram + " init -q '" + kRoot +
                         "/examples/drone3.btf' --max-states 10 2>/dev/null");
  CHECK(made.code == 3);
  CHECK(made.text.find("# Not known: ") != std::string::npos);
}

}  // namespace btcheck::init_test
