// SPDX-License-Identifier: MIT
//
// A batch as a table, a page, a job's summary, and as several trees in the
// formats for programs.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "batch/report.hpp"
#include "checked_report.hpp"
#include "report/formats/formats.hpp"

namespace btcheck::batch_report_test {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

ReportedTree entry_of(const std::string& name, const std::string& properties) {
  ReportedTree tree = report_of(kSmallTree, properties).trees.at(0);
  tree.entry = name;
  return tree;
}

// One entry of each kind.
Report batch() {
  Report report = report_of(kSmallTree, "");
  report.trees.clear();
  report.trees.push_back(
      entry_of("good.ltl", "property p: never s.success and s.failure"));
  report.trees.push_back(
      entry_of("a|b <i>.ltl",
               "## Never so.\nproperty bad expect holds: never a.failure"));
  report.trees.push_back(report_of("(nothing", "").trees.at(0));
  report.trees.back().entry = "broken.btf";
  // As after a limit, which no tree this small reaches.
  report.trees.push_back(
      entry_of("large.ltl", "property q: possible a.ticked"));
  ReportedProperty& open = report.trees.back().files.at(0).verdicts.at(0);
  open.verdict = Verdict::Undecided;
  open.note = "after 1,024 states: the limit of --timeout";
  report.trees.back().code = ExitCode::Undecided;
  ReportedTree left = report.trees[2];
  left.entry = "left.btf";
  left.not_run = "interrupted";
  left.diagnostics.clear();
  left.code = ExitCode::Undecided;
  report.trees.push_back(left);
  report.trees.push_back(entry_of("default.btf", ""));
  return report;
}

TEST_CASE("what came of an entry is a word") {
  const Report report = batch();
  std::vector<std::string_view> words;
  for (const ReportedTree& tree : report.trees) {
    words.push_back(word_of(outcome_of(tree)));
  }
  CHECK(words == std::vector<std::string_view>{"MET", "MISSED", "BROKEN",
                                               "UNDECIDED", "NOT RUN",
                                               "NO FAULT"});
  CHECK(sum_of(report) ==
        "6 entries: 1 met, 1 without a fault, 1 missed, 1 broken, 1 undecided, "
        "1 not run; 4 errors, 1 note");
  CHECK(report.code() == ExitCode::BadInput);
  ReportedTree ours;
  ours.code = ExitCode::Internal;
  CHECK(word_of(outcome_of(ours)) == "FAILED");
}

TEST_CASE("properties are counted, and questions of the default report") {
  const Report report = batch();
  CHECK(properties_of(report.trees[0]).holds == 1);
  CHECK(properties_of(report.trees[1]).violated == 1);
  CHECK(properties_of(report.trees[1]).missed == 1);
  CHECK(properties_of(report.trees[2]).all == 0);
  CHECK(properties_of(report.trees[3]).undecided == 1);
  // That a tree can be lost is no fault, and nothing that is violated.
  CHECK(properties_of(report.trees[5]).all == kTreeQuestionCount);
  CHECK(properties_of(report.trees[5]).violated == 0);
}

TEST_CASE("the table has a line for each entry, and then what is missed") {
  const std::string text = batch_text(batch(), Layout());
  CHECK(
      text.starts_with("result        rules       states       time  entry\n"
                       "MET          1 of 1  "));
  CHECK(has(text, "    0.25 s  good.ltl\n"));
  CHECK(has(text, "BROKEN            -            -          -  broken.btf\n"));
  CHECK(has(text, "NOT RUN           -            -          -  left.btf\n"));
  // Where there is no rule none is met.
  CHECK(has(text, "\nNO FAULT   no rules  "));
  CHECK(has(text,
            "  default.btf\n"
            "  note[BT2205] line 2: `c` is not asked again while `a` runs\n"));
  CHECK(has(text,
            "\n\na|b <i>.ltl\n"
            "VIOLATED   bad  (after 1 tick; expected to hold)\n"
            "           Never so.\n"
            "           never a.failure\n"));
  CHECK(has(text, "\nlarge.ltl\nUNDECIDED  q  (after 1,024 states: "));
  CHECK(!has(text, "\ngood.ltl\n"));
  CHECK(
      text.ends_with("\n6 entries: 1 met, 1 without a fault, 1 missed, 1 "
                     "broken, 1 undecided, 1 not run; 4 errors, 1 note\n"));
}

// An entry with so many findings of one kind, each of its own level.
ReportedTree entry_with(const std::vector<Severity>& levels) {
  ReportedTree tree = entry_of("messy.btf", "");
  const auto found = std::ranges::find_if(tree.findings, is_of_tree);
  REQUIRE(found != tree.findings.end());
  const Finding one = *found;
  tree.findings.clear();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    Finding& each = tree.findings.emplace_back(one);
    each.severity = levels[i];
    each.message = fmt::format("number {}.\nWhy: who knows.", i);
    each.told = fmt::format("\nall of {}\n", i);
  }
  return tree;
}

TEST_CASE(
    "below an entry stand its worst five findings, and where the rest is") {
  using enum Severity;
  Report report = batch();
  report.trees = {
      entry_with({Note, Warning, Note, Error, Warning, Note, Note})};
  report.trees[0].main_tree = "A b";
  const std::string text = batch_text(report, Layout());
  CHECK(has(text,
            "  messy.btf\n"
            "  error[BT2205] line 2: number 3\n"
            "  warning[BT2205] line 2: number 1\n"
            "  warning[BT2205] line 2: number 4\n"
            "  note[BT2205] line 2: number 0\n"
            "  note[BT2205] line 2: number 2\n"
            "  2 more: btcheck trees/t.btf --main-tree 'A b'\n\n"));
  CHECK(text.ends_with("; 1 error, 2 warnings, 4 notes\n"));
  // All of them where all is asked for, as the check of one tree tells them.
  const std::string all = batch_text(report, Detail::EveryStep);
  CHECK(has(all, "  messy.btf\n\nall of 3\n\nall of 1\n"));
  CHECK(has(all, "\nall of 6\n"));
  CHECK(!has(all, " more: "));
  // Beside a baseline is asked what is new and may fail a check.
  report.trees[0].judged.has_baseline = true;
  CHECK(!has(batch_text(report, Layout()), "  note["));
}

TEST_CASE("a long finding is told in lines that fit") {
  Report report = batch();
  report.trees = {entry_with({Severity::Warning})};
  report.trees[0].findings[0].message =
      "a message of more words than any line of eighty columns could have, "
      "whatever stands before it";
  report.trees[0].findings[0].place.file = "other.btf";
  const std::string text = batch_text(report, Layout());
  CAPTURE(text);
  CHECK(has(
      text,
      "\n  warning[BT2205] other.btf:2: a message of more words than any "
      "line of eighty\n    columns could have, whatever stands before it\n"));
}

TEST_CASE("what one limit leaves open is told once") {
  Report report = batch();
  report.trees = {entry_of("large.ltl",
                           "property a1: possible a.ticked\n"
                           "property a2: possible a.ticked\n"
                           "property a3: possible a.ticked\n"
                           "property a4: possible a.ticked\n")};
  int states = 1000;
  for (ReportedProperty& open : report.trees[0].files.at(0).verdicts) {
    open.verdict = Verdict::Undecided;
    open.note = fmt::format(
        "after {} states: the limit of --timeout; allow "
        "more",
        ++states);
  }
  report.trees[0].code = ExitCode::Undecided;
  const std::string text = batch_text(report, Layout());
  CHECK(has(text,
            "\nlarge.ltl\nUNDECIDED  a1, a2, a3 and 1 more  (the limit of "
            "--timeout; allow more)\n"));
  CHECK(has(batch_text(report, Detail::EveryStep),
            "UNDECIDED  a3  (after 1003 states: the limit of --timeout; allow "
            "more)\nUNDECIDED  a4  "));
}

TEST_CASE("findings stand in the page, and what is denied in the table") {
  Report report = batch();
  ReportedTree& tree = report.trees.back();
  const auto finding = std::ranges::find_if(tree.findings, is_of_tree);
  REQUIRE(finding != tree.findings.end());
  const std::string begin = fmt::format(
      "{} {}</span> <a href=", severity_name(finding->severity), finding->code);
  CHECK(has(html_report(report, "page.html"), begin));
  // What it has stands a click away, above all entries.
  finding->message = "`go` is <b> `lost`\n  help: write `go`\n2 | x=\"`a`\"";
  finding->run.emplace();
  const std::string page = html_report(report, "page.html");
  CHECK(has(page,
            "<code>go</code> is &lt;b&gt; <code>lost</code> <span "
            "class=\"note\">run"));
  CHECK(has(page, "<pre>  help: write <code>go</code>\n2 | x=&quot;`a`&quot;"));
  CHECK(page.find("id=\"finding-1\"") < page.find("id=\"entries\""));
  CHECK(has(page, "<a href=\"#finding-1\"><code>go</code>"));
  finding->severity = Severity::Error;
  tree.code = ExitCode::Missed;
  const std::string line = fmt::format("error[{}]", finding->code);
  CHECK(has(batch_text(report, Layout()), "  default.btf\n  " + line));
  CHECK(has(html_report(report, "page.html"), line));
}

TEST_CASE("the summary of a job begins with what is wrong") {
  const std::string text = job_summary_text(batch());
  CHECK(
      text.starts_with("### btcheck: 6 entries: 1 met, 1 without a fault, 1 "
                       "missed, 1 broken, 1 undecided, 1 not run; 4 errors, 1 "
                       "note\n\n"));
  // No character of a name means anything there.
  CHECK(has(text,
            "| a&#124;b &#60;i&#62;.ltl | VIOLATED | bad: after 1 tick; "
            "expected to hold<br>Never so. |\n"));
  CHECK(has(text, "| broken.btf | error&#91;BT1001&#93; | "));
  CHECK(has(text, "| MET | good.ltl | 1 | 0 | 0 | "));
  CHECK(has(text, "| NOT RUN | left.btf | "));
  CHECK(!has(job_summary_text(report_of(kSmallTree, "")), "| tree | | what |"));
}

TEST_CASE("JUnit has a suite for each entry, by its name") {
  const std::string text = junit_text(batch());
  CHECK(has(text,
            "<testsuites name=\"btcheck\" tests=\"13\" failures=\"1\" "
            "errors=\"1\" skipped=\"2\""));
  CHECK(has(text,
            "<testsuite name=\"a|b &lt;i&gt;.ltl\" tests=\"1\" "
            "failures=\"1\""));
  CHECK(has(text, "<skipped message=\"not run: interrupted\"/>"));
}

TEST_CASE("JSON names the entry, and why one was not run") {
  const std::string text = json_text(batch());
  CHECK(has(text, "\"entry\": \"good.ltl\",\n   \"not_run\": null,\n"));
  CHECK(has(text, "\"not_run\": \"interrupted\""));
  const std::string lines = json_lines(batch());
  CHECK(lines.starts_with("{\"event\":\"batch\",\"schema\":\"btcheck/1\","));
  CHECK(has(lines,
            "\"entries\":6}\n{\"event\":\"entry\",\"entry\":"
            "\"good.ltl\",\"not_run\":null,\"tree\":"
            "\"trees/t.btf\",\"properties\":[\"rules/p.ltl\"],"
            "\"exit_code\":0,"));
  CHECK(has(lines, "{\"event\":\"verdict\",\"entry\":\"good.ltl\","));
  // The check of a single tree is told as ever.
  CHECK(!has(json_text(report_of(kSmallTree, "")), "\"entry\""));
  CHECK(json_lines(report_of(kSmallTree, ""))
            .starts_with("{\"event\":\"start\","));
}

TEST_CASE("the page has every entry, and links that lead from where it is") {
  Report report = batch();
  report.trees[1].files.at(0).verdicts.at(0).page = "runs/a b/t.bad.html";
  const std::string page = html_report(report, "out/page.html");
  CHECK(has(page, "<title>btcheck: 4 of 6 entries not as expected</title>"));
  CHECK(has(page, "<a href=\"../runs/a%20b/t.bad.html\">see the run</a>"));
  CHECK(has(page, "<a href=\"../trees/t.btf\">trees/t.btf</a>"));
  CHECK(has(page, "a|b &lt;i&gt;.ltl"));
  CHECK(!has(page, "<i>.ltl"));
  CHECK(!has(page, "{{"));
  for (std::size_t i = 1; i <= report.trees.size(); ++i) {
    CHECK(has(page, "id=\"entry-" + std::to_string(i) + "\""));
  }
  CHECK(has(page, "<p>Not run: interrupted.</p>"));
  CHECK(has(html_report(report_of(kSmallTree, ""), "p.html"),
            "<h1>1 entry, as expected</h1>"));
}

TEST_CASE("a page asks for nothing from anywhere") {
  const std::string page = html_report(batch(), "p.html");
  for (const char* outside : {"http:", "https:", "@import", "src=", "url("}) {
    CAPTURE(outside);
    CHECK(!has(page, outside));
  }
  CHECK(has(page, "default-src 'none'"));
}

}  // namespace
}  // namespace btcheck::batch_report_test
