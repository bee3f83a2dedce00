// SPDX-License-Identifier: MIT
//
// Formats and where they go.
#include "cli/options/report_target.hpp"

#include <doctest/doctest.h>

#include <string>
#include <variant>
#include <vector>

namespace btcheck {
namespace {

using Words = std::vector<std::string>;

std::vector<ReportTarget> targets(const Words& words) {
  const auto result = report_targets(words);
  REQUIRE(std::holds_alternative<std::vector<ReportTarget>>(result));
  return std::get<std::vector<ReportTarget>>(result);
}

std::string complaint(const Words& words) {
  const auto result = report_targets(words);
  REQUIRE(std::holds_alternative<TargetComplaint>(result));
  CHECK(!std::get<TargetComplaint>(result).help.empty());
  return std::get<TargetComplaint>(result).message;
}

TEST_CASE("text goes to standard output unless another format does") {
  const auto none = targets({});
  REQUIRE(none.size() == 1);
  CHECK(none[0].format == ReportFormat::Text);
  CHECK(none[0].file.empty());
  const auto json = targets({"json"});
  REQUIRE(json.size() == 1);
  CHECK(json[0].format == ReportFormat::Json);
  CHECK(json[0].file.empty());
}

TEST_CASE("several formats go to several files") {
  const auto several = targets({"sarif=out.sarif", "junit=a=b.xml"});
  REQUIRE(several.size() == 3);
  CHECK(several[0].format == ReportFormat::Text);
  CHECK(several[0].file.empty());
  CHECK(several[1].format == ReportFormat::Sarif);
  CHECK(several[1].file == "out.sarif");
  CHECK(several[2].format == ReportFormat::JUnit);
  CHECK(several[2].file == "a=b.xml");
  CHECK(targets({"github", "text=log.txt", "jsonl=log.jsonl"}).size() == 3);
}

TEST_CASE("a word that is no format is refused") {
  CHECK(complaint({"xml"}) == "--format xml: no such format");
  CHECK(complaint({""}) == "--format : no such format");
  CHECK(complaint({"json="}) == "--format json=: no such format");
  CHECK(complaint({"JSON"}) == "--format JSON: no such format");
}

TEST_CASE("no two formats share a file, or standard output") {
  CHECK(complaint({"json", "sarif"}) == "two formats on standard output");
  CHECK(complaint({"text", "github"}) == "two formats on standard output");
  CHECK(complaint({"json=a", "sarif=a"}) == "two formats in the file `a`");
}

}  // namespace
}  // namespace btcheck
