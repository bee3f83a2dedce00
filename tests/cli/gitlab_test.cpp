// SPDX-License-Identifier: MIT
//
// What GitLab asks of a code quality report. The shape of each report is
// checked by tests/schemas.
#include "report/formats/formats.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli/checked_report.hpp"

namespace btcheck::gitlab_test {
namespace {

using Json = nlohmann::json;

Json issues_of(const Report& report) {
  return Json::parse(gitlab_text(report));
}

TEST_CASE("a violation is a major issue on its node") {
  const Json issues =
      issues_of(report_of(kSmallTree, "property p: never a.failure\n"));
  REQUIRE(issues.size() == 1);
  CHECK(issues[0].at("check_name") == "BT2001");
  CHECK(issues[0].at("severity") == "major");
  CHECK(issues[0].at("location") ==
        Json{{"path", "trees/t.btf"}, {"lines", {{"begin", 2}}}});
  CHECK(issues[0]
            .at("description")
            .get<std::string>()
            .starts_with(
                "p is violated (after 1 tick): never a.failure.\nWhy: "));
}

TEST_CASE("warnings are minor, and notes are information") {
  CHECK(issues_of(report_of(kSmallTree, ""))[0].at("severity") == "info");
  const Json warned = issues_of(
      report_of(kSmallTree, "property p: a.halted leadsto c.ticked\n"));
  CHECK(warned[0].at("severity") == "minor");
  CHECK(warned[0].at("location").at("path") == "rules/p.ltl");
}

TEST_CASE("nothing wrong is an empty list") {
  CHECK(gitlab_text(report_of(kSmallTree, "property p: never a.halted\n")) ==
        "[]\n");
}

TEST_CASE("a fingerprint stays when lines move, and is there once") {
  const std::string rule = "property p: never a.failure\n";
  const Json here = issues_of(report_of(kSmallTree, rule));
  const Json moved = issues_of(report_of("\n\n" + kSmallTree, "\n" + rule));
  CHECK(here[0]["fingerprint"] == moved[0]["fingerprint"]);
  CHECK(here[0]["location"] != moved[0]["location"]);

  Report twice = report_of(kSmallTree, rule + "property q: never a.success\n");
  for (Finding& each : twice.trees[0].findings) each.identity = "the same";
  std::set<std::string> prints;
  for (const Json& issue : issues_of(twice)) {
    CHECK(prints.insert(issue.at("fingerprint").get<std::string>()).second);
  }
  CHECK(prints.size() == 2);
}

TEST_CASE(
    "files are named from the root, a file as a whole by its first line") {
  Report report = report_of("", "");
  report.directory = "/home/robot/trees";
  report.trees[0].diagnostics[0].file = "./b/../t.btf";
  report.trees[0].diagnostics[0].span = {};
  CHECK(issues_of(report)[0].at("location") ==
        Json{{"path", "trees/t.btf"}, {"lines", {{"begin", 1}}}});
}

TEST_CASE("no text has orders for a terminal") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  report.trees[0].findings[0].message = "\x1b[2Ksection_start:0:x\r\"";
  CHECK(issues_of(report)[0].at("description") == "?[2Ksection_start:0:x?\"");
}

}  // namespace
}  // namespace btcheck::gitlab_test
