// SPDX-License-Identifier: MIT
//
// Workflow commands, as GitHub's runner reads them.
#include "report/formats/formats.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "cli/checked_report.hpp"

namespace btcheck::github_test {
namespace {

std::vector<std::string> lines_of(const Report& report) {
  std::vector<std::string> lines;
  std::istringstream stream(github_text(report));
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::ptrdiff_t count_of(const std::vector<std::string>& lines,
                        const std::string& start) {
  return std::count_if(
      lines.begin(), lines.end(),
      [&](const std::string& line) { return line.starts_with(start); });
}

TEST_CASE("a violation is an error on its node") {
  const auto lines =
      lines_of(report_of(kSmallTree, "property p: never a.failure\n"));
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] ==
        "::error file=trees/t.btf,line=2,endLine=2,col=21,endColumn=27,"
        "title=p [BT2001]::p is violated (after 1 tick): never a.failure."
        "%0AWhy: a -> failure in tick 1 breaks the rule; with a -> success or "
        "a -> running it need not have been broken."
        "%0A-- tick 1 begins%0A  c -> success (chosen)"
        "%0A  a -> failure (chosen)%0A-- here it is so: a.failure");
  CHECK(lines[1] == "btcheck: 1 error, 0 warnings, 0 notices");
}

TEST_CASE("warnings and notices have commands of their own") {
  const auto lines = lines_of(report_of(kSmallTree, ""));
  CHECK(count_of(lines, "::notice file=trees/t.btf,line=2,") == 1);
  CHECK(lines.back() == "btcheck: 0 errors, 0 warnings, 1 notice");
  const auto warned = lines_of(
      report_of(kSmallTree, "property p: a.halted leadsto c.ticked\n"));
  CHECK(count_of(warned, "::warning file=rules/p.ltl,line=1,") == 1);
}

TEST_CASE("nothing wrong is one line") {
  CHECK(lines_of(report_of(kSmallTree, "property p: never a.halted\n")) ==
        std::vector<std::string>{"btcheck: 0 errors, 0 warnings, 0 notices"});
}

TEST_CASE("of each kind ten are annotated and the others counted") {
  std::string rules;
  for (int i = 0; i < 13; ++i) {
    rules += "property p" + std::to_string(i) + ": never a.failure\n";
  }
  rules += "property q: a.halted leadsto c.ticked\n";
  const auto lines = lines_of(report_of(kSmallTree, rules));
  CHECK(count_of(lines, "::error ") == 10);
  CHECK(count_of(lines, "::warning ") == 1);
  CHECK(lines.back() ==
        "btcheck: 13 errors, 1 warning, 0 notices (3 not annotated)");
}

TEST_CASE("what is said of a file as a whole has no line") {
  Report report = report_of("", "");
  const auto lines = lines_of(report);
  CHECK(count_of(lines, "::error file=trees/t.btf,") == 1);
  report.trees[0].diagnostics[0].span = {};
  CHECK(count_of(lines_of(report), "::error file=trees/t.btf,title=") == 1);
}

TEST_CASE("no text becomes a command or a property") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  Finding& finding = report.trees[0].findings[0];
  finding.title = "a,line=9::b\n::error::c";
  finding.message = "100%\n::set-output name=x::y\r\nz\x1b";
  finding.place.file = "a,b:c\n.btf";
  finding.run.reset();
  const auto lines = lines_of(report);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] ==
        "::error file=a%2Cb%3Ac%0A.btf,line=2,endLine=2,col=21,endColumn=27,"
        "title=a%2Cline=9%3A%3Ab%0A%3A%3Aerror%3A%3Ac [BT2001]::"
        "100%25%0A::set-output name=x::y%0Az?");
}

TEST_CASE("of a long run the end is told") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  ToldRun& run = *report.trees[0].findings[0].run;
  run.steps.assign(100, run.steps[1]);
  run.steps.back().text = "the last";
  const std::string line = lines_of(report)[0];
  CHECK(line.find("%0A(80 steps before)%0A") != std::string::npos);
  CHECK(line.ends_with("the last (chosen)"));
}

TEST_CASE("the page of the job has what is wrong, then what else was found") {
  const std::string wrong =
      job_summary_text(report_of(kSmallTree,
                                 "property p: never a.failure\n"
                                 "property q: a.halted leadsto c.ticked\n"));
  const std::size_t row = wrong.find("| trees/t.btf | VIOLATED | p: ");
  const std::size_t others = wrong.find(
      "<details><summary>1 warning</summary>\n\n| | where | what |\n"
      "|---|---|---|\n| warning BT2004 | rules/p.ltl:2:10 | q holds ");
  CHECK(row != wrong.npos);
  CHECK(others != wrong.npos);
  CHECK(row < others);
  CHECK(others < wrong.find("<summary>every tree</summary>"));
}

TEST_CASE("no text ends a row, a cell or what is folded in the page") {
  Report report = report_of(kSmallTree, "");
  Finding& finding = report.trees[0].findings.at(0);
  finding.message = "</details> | ```\nnext";
  finding.place.file = "a|b\n<img>.btf";
  const std::string page = job_summary_text(report);
  CHECK(page.find("| note " + finding.code +
                  " | a&#124;b &#60;img&#62;.btf:2:3 | "
                  "&#60;/details&#62; &#124; &#96;&#96;&#96; |\n") !=
        page.npos);
}

}  // namespace
}  // namespace btcheck::github_test
