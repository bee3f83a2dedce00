// SPDX-License-Identifier: MIT
//
// What is told of many findings, and of runs that no time passes on.
#include "report/text/report.hpp"

#include <doctest/doctest.h>

#include <string>

#include "check/check.hpp"

namespace btcheck {
namespace {

std::string findings(const std::string& tree, Detail detail) {
  const CheckResult result = check({"t.btf", tree}, {}, {});
  REQUIRE(result.files.size() == 1);
  return findings_text(*result.tree, result.files[0], detail);
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

TEST_CASE("of many stale guards the first eight are told") {
  const std::string some = findings(guarded(8), Detail::Events);
  CHECK(lines_with(some, "is not ticked again while") == 8);
  CHECK(lines_with(some, "more (-v)") == 0);
  const std::string many = findings(guarded(11), Detail::Events);
  CHECK(lines_with(many, "is not ticked again while") == 8);
  CHECK(lines_with(many, "  and 3 more (-v)\n") == 1);
  const std::string all = findings(guarded(11), Detail::EveryStep);
  CHECK(lines_with(all, "is not ticked again while") == 11);
  CHECK(lines_with(all, "c -> success") == 11);
  CHECK(lines_with(all, "more (-v)") == 0);
}

TEST_CASE("the first time is told in the unit there is") {
  CHECK(when_text(", e.g. ", TickSemantics::Root, 3) == ", e.g. in tick 3");
  CHECK(when_text(", e.g. ", TickSemantics::Leaves, 3) == ", e.g. at time 3");
  CHECK(when_text(", e.g. ", TickSemantics::Nodes, 3) == ", e.g. at time 3");
  CHECK(when_text(", e.g. ", TickSemantics::None, 0) == "");
}

}  // namespace
}  // namespace btcheck
