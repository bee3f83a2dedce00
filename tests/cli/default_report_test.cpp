// SPDX-License-Identifier: MIT
//
// What is told of many findings, and of runs that no time passes on.
#include "report/text/report.hpp"

#include <doctest/doctest.h>

#include <string>

#include "check/check.hpp"

namespace btcheck::default_report_test {
namespace {

std::string findings(const std::string& tree, Detail detail) {
  const CheckResult result = check({"t.btf", tree}, {}, {});
  REQUIRE(result.files.size() == 1);
  return findings_text(result, result.files[0], detail);
}

// A condition before so many actions.
std::string guarded(int actions) {
  std::string tree = "(BehaviorTree :name t (Sequence (Condition :ID c)";
  for (int i = 0; i < actions; ++i) {
    tree += " (Action :ID a" + std::to_string(i) + ")";
  }
  return tree + "))";
}

std::size_t lines_with(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST_CASE("a tree without findings gets no heading") {
  CHECK(findings("(BehaviorTree :name t (Action :ID a))", Detail::Events) ==
        "");
}

TEST_CASE("a guard is told once, with all that runs unguarded") {
  const std::string some = findings(guarded(2), Detail::Events);
  CHECK(lines_with(some, "`c` is not asked again while `a0` and `a1` run") ==
        1);
  const std::string many = findings(guarded(11), Detail::Events);
  CHECK(lines_with(many, "`a0`, `a1` and 9 more run") == 1);
  CHECK(lines_with(many, "c -> success") == 1);
}

TEST_CASE("the first time is told in the unit there is") {
  CHECK(when_text(", e.g. ", TickSemantics::Root, 3) == ", e.g. in tick 3");
  CHECK(when_text(", e.g. ", TickSemantics::Leaves, 3) == ", e.g. at time 3");
  CHECK(when_text(", e.g. ", TickSemantics::Nodes, 3) == ", e.g. at time 3");
  CHECK(when_text(", e.g. ", TickSemantics::None, 0) == "");
}

}  // namespace
}  // namespace btcheck::default_report_test
