// SPDX-License-Identifier: MIT
//
// What is told of two trees: beside each other, as Markdown, JSON and a page.
#include "report/diff/told.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "compared.hpp"

namespace btcheck::diff_told_test {
namespace {

using Document = nlohmann::json;

const std::string kPlain = xml_of("<Sequence><p/><a/></Sequence>");
const std::string kReactive =
    xml_of("<ReactiveSequence><p/><a/></ReactiveSequence>");

DiffReport report_of(const Diff& diff) { return {diff, {"a.xml", "b.xml"}}; }

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

std::size_t count_of(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != text.npos;
       at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("two trees are called by what tells them apart") {
  const Diff diff;
  const auto labels = [&](std::string one, std::string other) {
    const DiffReport report{diff, {std::move(one), std::move(other)}};
    return std::pair(report.label(0), report.label(1));
  };
  using Labels = std::pair<std::string, std::string>;
  CHECK(labels("old/t.xml", "new/t.xml") == Labels("old", "new"));
  CHECK(labels("t.xml", "t.xml") == Labels("t.xml", "t.xml"));
  DiffReport twice{diff, {"a/t.xml (nav2-kilted)", "a/t.xml (nav2-main)"}};
  twice.profiles = {"nav2-kilted", "nav2-main"};
  CHECK(std::pair(twice.label(0), twice.label(1)) ==
        Labels("nav2-kilted", "nav2-main"));
  CHECK(labels("a (1).xml", "a (2).xml") == Labels("a (1).xml", "a (2).xml"));
}

TEST_CASE("a run that one has alone stands side by side") {
  const Diff diff = compared(kPlain, kReactive);
  const DiffReport report = report_of(diff);
  CHECK(report.verdict() == "different");
  CHECK(report.code() == ExitCode::Missed);
  const std::string text = diff_text(report, 80);
  CHECK(text.starts_with(
      "a.xml beside b.xml\ndifferent: a run of a.xml that b.xml has not ("));
  CHECK(text.substr(text.find("tick")) ==
        "tick  a.xml                               | b.xml\n"
        "   1  `p` succeeds                        | `p` succeeds\n"
        "      `a` runs                            | `a` runs\n"
        "      the tree runs                       | the tree runs\n"
        "   2  `a` is ticked                       ! `p` is ticked\n");
  for (const std::string_view line : {"tick", "   1", "   2"}) {
    const auto at = text.find(std::string("\n") + std::string(line));
    CHECK(text.find('\n', at + 1) - at <= 81);
  }
}

TEST_CASE("a narrow terminal breaks cells, not lines") {
  const Diff diff = compared(kPlain, kReactive);
  const std::string text = diff_text(report_of(diff), 40);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    CHECK(end - at <= 40);
    at = end + 1;
  }
}

TEST_CASE("equivalent trees are told in a line") {
  const Diff diff = compared(kPlain, kPlain);
  DiffReport report = report_of(diff);
  CHECK(report.verdict() == "equivalent");
  CHECK(report.code() == ExitCode::Met);
  CHECK(rows_of(report).empty());
  CHECK(has(diff_text(report, 80), "equivalent in every world ("));
  report.changes.emplace();
  CHECK(has(diff_text(report, 80), "no verdict and no finding differs"));
}

TEST_CASE("limits are told, and are no verdict") {
  DiffOptions options;
  options.limits.max_states = 2;
  const Diff diff = compared(kPlain, kReactive, options);
  const DiffReport report = report_of(diff);
  CHECK(report.code() == ExitCode::Undecided);
  CHECK(has(diff_text(report, 80), "UNDECIDED: a limit (max-states)"));
  CHECK(Document::parse(diff_json(report))["stopped"] == "max-states");
}

TEST_CASE("what a leaf is told otherwise is told") {
  const Diff diff = compared(xml_of("<d name=\"go\" goal=\"1\"/>"),
                             xml_of("<d name=\"go\" goal=\"2\"/>"));
  const DiffReport report = report_of(diff);
  const std::string text = diff_text(report, 80);
  CHECK(has(text, "a leaf is told something else"));
  CHECK(has(text, "`go` of b.xml: `goal` 2 instead of 1"));
}

TEST_CASE("a leaf that only one tree has is named") {
  const Diff diff = compared(xml_of("<Sequence><a/><b/></Sequence>"),
                             xml_of("<Sequence><a/></Sequence>"));
  CHECK(has(diff_text(report_of(diff), 80), "`b` is in a.xml only\n"));
}

TEST_CASE("Markdown is a table, and no name breaks out of it") {
  const Diff diff = compared(
      xml_of("<Sequence><a name=\"x|y\"/><p name=\"&lt;b&gt;\"/></Sequence>"),
      xml_of("<Fallback><a name=\"x|y\"/><p name=\"&lt;b&gt;\"/></Fallback>"));
  const std::string text = diff_markdown(report_of(diff));
  CHECK(has(text, "### a.xml beside b.xml: different\n"));
  CHECK(has(text, "\n| tick | a.xml | b.xml |\n|---:|---|---|\n"));
  CHECK(has(text, "x\\|y"));
  CHECK(!has(text, "<b>"));
  CHECK(has(text, "**"));
}

TEST_CASE("JSON has the run by the numbers of what is watched") {
  const Diff diff = compared(kPlain, kReactive);
  const Document document = Document::parse(diff_json(report_of(diff)));
  CHECK(document["schema"] == "btcheck-diff/1");
  CHECK(document["verdict"] == "different");
  CHECK(document["caller"] == "any");
  CHECK(document["observe"] == Document{"leaves"});
  REQUIRE(document["watched"].size() == 3);
  CHECK(document["watched"][1]["nodes"] == Document{"p", "p"});
  const Document& found = document["difference"];
  CHECK(found["kind"] == "run");
  CHECK(found["of"] == 0);
  CHECK(found["run"].size() == 8);
  CHECK(found["run"].back() == Document{{"watched", 2}, {"what", "asked"}});
  CHECK(found["instead"].size() == 1);
  CHECK(document["rows"].back()["differs"] == true);
  CHECK(document["changes"].is_null());
}

TEST_CASE("the page has both trees, each pair in one colour") {
  const Diff diff = compared(xml_of("<Sequence><p/><a/></Sequence>"),
                             xml_of("<ReactiveSequence><p/><a/><b/>"
                                    "</ReactiveSequence>"));
  const std::string page = diff_page(report_of(diff));
  // The roots, p and a: twice each; b, and both control nodes, alone.
  CHECK(count_of(page, " alone\">") == 3);
  CHECK(count_of(page, "data-pair=\"0\"") == 2);
  CHECK(count_of(page, "<iframe") == 2);
  CHECK(!has(page, "{{"));
  // Roots are the same, whatever they are called.
  const Diff renamed = compared("(BehaviorTree :name one (Action :ID a))\n",
                                "(BehaviorTree :name other (Action :ID a))\n");
  CHECK(!has(diff_page(report_of(renamed)), "only here"));
}

TEST_CASE("verdicts and findings that are otherwise are told") {
  const auto checked = [](const std::string& text) {
    return check(TreeInput("t.xml", FileText(text)), {}, {});
  };
  // Nothing can make this Fallback fail.
  const CheckResult one = checked(xml_of("<Sequence><a/><b/></Sequence>"));
  const CheckResult other =
      checked(xml_of("<Sequence><Fallback><AlwaysSuccess/><a/></Fallback><b/>"
                     "</Sequence>"));
  REQUIRE(one.tree != nullptr);
  REQUIRE(other.tree != nullptr);
  CHECK(changes_between(one, one).empty());
  const auto changes = changes_between(one, other);
  REQUIRE(!changes.empty());
  CHECK(changes[0].kind == DiffChange::Kind::New);
  const auto back = changes_between(other, one);
  REQUIRE(back.size() == changes.size());
  CHECK(back[0].kind == DiffChange::Kind::Gone);
  CHECK(back[0].code == changes[0].code);
  // And rules.
  const auto ruled = [](const std::string& text) {
    return check(TreeInput("t.xml", FileText(text)),
                 {{"t.ltl", FileText("property asked: never b.ticked\n")}}, {});
  };
  const auto verdicts = changes_between(
      ruled(xml_of("<Sequence><AlwaysFailure/><b/></Sequence>")),
      ruled(xml_of("<Sequence><a/><b/></Sequence>")));
  REQUIRE(!verdicts.empty());
  CHECK(verdicts[0].kind == DiffChange::Kind::Verdict);
  CHECK(change_text(verdicts[0]) == "rule `asked`: HOLDS before, VIOLATED now");
}

}  // namespace btcheck::diff_told_test
