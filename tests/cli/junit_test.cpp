// SPDX-License-Identifier: MIT
//
// JUnit reports, read back and held against what their readers need.
#include "report/formats/formats.hpp"

#include <doctest/doctest.h>

#include <regex>
#include <set>
#include <string>

#include "cli/checked_report.hpp"
#include "cli/xml_reader.hpp"

namespace btcheck::junit_test {
namespace {

int number(const XmlElement& element, const std::string& name) {
  REQUIRE(element.attributes.contains(name));
  return std::stoi(element.attributes.at(name));
}

void check_time(const XmlElement& element) {
  REQUIRE(element.attributes.contains("time"));
  CHECK(std::regex_match(element.attributes.at("time"),
                         std::regex("[0-9]+\\.[0-9]{3}")));
}

// In testmoapp/junitxml's order.
void check_order(const XmlElement& element,
                 const std::vector<std::string>& order) {
  std::size_t at = 0;
  for (const XmlElement& child : element.children) {
    while (at < order.size() && order[at] != child.name) ++at;
    CAPTURE(child.name);
    CHECK(at < order.size());
  }
}

struct Sums {
  int tests = 0;
  int failures = 0;
  int errors = 0;
  int skipped = 0;
};

void check_sums(const XmlElement& element, const Sums& sums) {
  CHECK(number(element, "tests") == sums.tests);
  CHECK(number(element, "failures") == sums.failures);
  CHECK(number(element, "errors") == sums.errors);
  CHECK(number(element, "skipped") == sums.skipped);
  check_time(element);
}

void check_case(const XmlElement& made, Sums& sums) {
  CHECK(made.name == "testcase");
  for (const char* name : {"name", "classname", "file"}) {
    REQUIRE(made.attributes.contains(name));
    CHECK(!made.attributes.at(name).empty());
  }
  check_time(made);
  if (made.attributes.contains("line")) CHECK(number(made, "line") >= 1);
  check_order(made, {"properties", "skipped", "error", "failure", "system-out",
                     "system-err"});
  int outcomes = 0;
  for (const char* name : {"failure", "error", "skipped"}) {
    const XmlElement* outcome = made.child(name);
    if (outcome == nullptr) continue;
    ++outcomes;
    CHECK(!outcome->attributes.at("message").empty());
    if (outcome->name != "skipped") {
      CHECK(!outcome->attributes.at("type").empty());
    }
    sums.failures += outcome->name == "failure";
    sums.errors += outcome->name == "error";
    sums.skipped += outcome->name == "skipped";
  }
  CHECK(outcomes <= 1);
  ++sums.tests;
}

// The suites of a report that has every field readers need.
XmlElement checked(const Report& report) {
  const XmlElement root = read_xml(junit_text(report));
  CHECK(root.name == "testsuites");
  Sums total;
  REQUIRE(root.children.size() == report.trees.size());
  for (const XmlElement& suite : root.children) {
    CHECK(suite.name == "testsuite");
    for (const char* name : {"name", "file"}) {
      REQUIRE(suite.attributes.contains(name));
      CHECK(!suite.attributes.at(name).empty());
    }
    CHECK(std::regex_match(
        suite.attributes.at("timestamp"),
        std::regex("[0-9]{4}(-[0-9]{2}){2}T[0-9]{2}(:[0-9]{2}){2}Z")));
    check_order(suite, {"properties", "testcase", "system-out", "system-err"});
    Sums sums;
    for (const XmlElement& child : suite.children) {
      if (child.name == "testcase") check_case(child, sums);
    }
    CHECK(sums.tests > 0);
    check_sums(suite, sums);
    total.tests += sums.tests;
    total.failures += sums.failures;
    total.errors += sums.errors;
    total.skipped += sums.skipped;
  }
  check_sums(root, total);
  return root;
}

std::vector<XmlElement> cases_of(const XmlElement& root) {
  std::vector<XmlElement> cases;
  for (const XmlElement& child : root.children.at(0).children) {
    if (child.name == "testcase") cases.push_back(child);
  }
  return cases;
}

std::map<std::string, std::string> properties_of(const XmlElement& element) {
  std::map<std::string, std::string> read;
  const XmlElement* properties = element.child("properties");
  REQUIRE(properties != nullptr);
  for (const XmlElement& property : properties->children) {
    CHECK(property.name == "property");
    read[property.attributes.at("name")] = property.attributes.at("value");
  }
  return read;
}

TEST_CASE("each property is a test case") {
  const XmlElement root =
      checked(report_of(kSmallTree,
                        "## Nobody fails & nobody < anybody.\n"
                        "property fails [safety, req=7]: never a.failure\n"
                        "property calm: never a.halted\n"
                        "property known expect violated: never a.running\n"
                        "property mended expect violated: never a.halted\n"));
  const auto cases = cases_of(root);
  REQUIRE(cases.size() == 4);
  CHECK(cases[0].attributes.at("name") == "fails");
  CHECK(cases[0].attributes.at("classname") == "trees/t");
  CHECK(cases[0].attributes.at("file") == "rules/p.ltl");
  CHECK(cases[0].attributes.at("line") == "2");
  CHECK(properties_of(cases[0]) ==
        std::map<std::string, std::string>{{"tag", "safety"}, {"req", "7"}});
  const XmlElement* failure = cases[0].child("failure");
  REQUIRE(failure != nullptr);
  CHECK(failure->attributes.at("message") == "VIOLATED (after 1 tick)");
  CHECK(failure->attributes.at("type") == "BT2001 PropertyViolated");
  CHECK(failure->text.find("c -> success") != std::string::npos);
  CHECK(failure->text.find("why: a -> failure in tick 1") != std::string::npos);
  CHECK(cases[1].child("failure") == nullptr);
  CHECK(cases[1].child("system-out")->text == "HOLDS  never a.halted\n");
  CHECK(cases[2].child("failure") == nullptr);
  CHECK(cases[2].child("system-out")->text ==
        "VIOLATED (after 1 tick; as expected)  never a.running\n");
  REQUIRE(cases[3].child("failure") != nullptr);
  CHECK(cases[3].child("failure")->attributes.at("type") ==
        "BT2002 PropertyHolds");
}

TEST_CASE("the suite tells what was checked, and how") {
  const XmlElement root =
      checked(report_of(kSmallTree, "property p: never a.halted\n"));
  const XmlElement& suite = root.children[0];
  CHECK(suite.attributes.at("name") == "trees/t.btf");
  CHECK(suite.attributes.at("time") == "0.250");
  const auto properties = properties_of(suite);
  CHECK(properties.at("profile") == "paper");
  CHECK(properties.at("tick") == "root");
  CHECK(properties.at("nodes") == "4");
  CHECK(std::stoi(properties.at("states")) > 0);
  CHECK(properties.at("peak_bytes") == "4096");
}

TEST_CASE("what is undecided is skipped") {
  CheckOptions few;
  few.limits.max_states = 1;
  const auto cases = cases_of(
      checked(report_of(kSmallTree, "property p: never a.halted\n", few)));
  REQUIRE(cases[0].child("skipped") != nullptr);
  CHECK(cases[0].child("skipped")->attributes.at("message").starts_with(
      "UNDECIDED (after 1 states: the limit of --max-states"));
}

TEST_CASE("our mistakes are errors") {
  CheckResult result = check({"t.btf", kSmallTree},
                             {{"p.ltl", "property p: never a.failure\n"}}, {});
  result.files[0].verdicts[0].error = "step 3 is not possible";
  const auto cases = cases_of(checked(report_on(result, "t.btf")));
  REQUIRE(cases[0].child("error") != nullptr);
  CHECK(cases[0].child("error")->text ==
        "internal error: step 3 is not possible");
}

TEST_CASE("inputs that cannot be checked are one error") {
  const auto cases =
      cases_of(checked(report_of(kSmallTree,
                                 "property p: never b.running\n"
                                 "property q: never d.running\n")));
  REQUIRE(cases.size() == 1);
  const XmlElement* error = cases[0].child("error");
  REQUIRE(error != nullptr);
  CHECK(error->attributes.at("type") == "BT1101");
  CHECK(error->attributes.at("message") == "unknown node `b`");
  CHECK(error->text.find("unknown node `d`") != std::string::npos);
  CHECK(cases[0].attributes.at("file") == "rules/p.ltl");
}

TEST_CASE("the default report asks seven questions") {
  const XmlElement root =
      checked(report_of("(defsv k :max 1)(BehaviorTree :name t (Sequence"
                        " (Action :ID a :SF) (Eval (:= k (+ k 2)))))",
                        ""));
  const auto cases = cases_of(root);
  REQUIRE(cases.size() == 7);
  CHECK(cases[5].attributes.at("name") == "no script or assignment fails");
  const XmlElement* failure = cases[5].child("failure");
  REQUIRE(failure != nullptr);
  CHECK(failure->attributes.at("type") == "BT2101 Fault");
  CHECK(failure->text.find("a -> success  (chosen)\n") != std::string::npos);
  CHECK(number(root, "failures") == 1);
}

TEST_CASE("what is worth a look is a case, and breaks no test") {
  const XmlElement root = checked(report_of(kSmallTree, ""));
  CHECK(number(root, "failures") == 0);
  const auto cases = cases_of(root);
  REQUIRE(cases.size() == 8);
  CHECK(cases[7].attributes.at("name") ==
        "BT2205 `c` is not asked again while `a` runs.");
  CHECK(cases[7].attributes.at("line") == "2");
  REQUIRE(cases[7].child("system-out") != nullptr);
  CHECK(cases[7]
            .child("system-out")
            ->text.starts_with("note[BT2205]: `c` is not asked again"));
}

TEST_CASE("what is denied has failed") {
  CheckOptions denied;
  denied.judgement.denied = {"BT2205"};
  const XmlElement root = checked(report_of(kSmallTree, "", denied));
  CHECK(number(root, "failures") == 1);
  const auto cases = cases_of(root);
  const XmlElement* failure = cases.at(7).child("failure");
  REQUIRE(failure != nullptr);
  CHECK(failure->attributes.at("type") == "BT2205");
  CHECK(failure->attributes.at("message") ==
        "error: `c` is not asked again while `a` runs.");
}

TEST_CASE("outputs that cannot be written are an error beside the others") {
  Report report = report_of(kSmallTree, "property p: never a.halted\n");
  Diagnostic failed;
  failed.code = "BT0004";
  failed.message = "cannot write `x`";
  report.trees[0].diagnostics.push_back(failed);
  report.trees[0].code = ExitCode::BadInput;
  const auto cases = cases_of(checked(report));
  REQUIRE(cases.size() == 2);
  REQUIRE(cases[1].child("error") != nullptr);
  CHECK(cases[1].child("error")->attributes.at("type") == "BT0004");
}

TEST_CASE("hostile texts make well-formed XML") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  ReportedProperty& property = report.trees[0].files[0].verdicts[0];
  property.name = "\x01\"<&>'\n\x7f\xff]]>";
  property.told = "]]> \x0b <failure> &amp;";
  report.trees[0].file = "a\tb\x1b.btf";
  const auto cases = cases_of(checked(report));
  CHECK(cases[0].attributes.at("name") == "?\"<&>'\n??]]>");
  CHECK(cases[0].attributes.at("classname") == "a\tb?");
  CHECK(cases[0].child("failure")->text == "]]> ? <failure> &amp;");
}

TEST_CASE("each tree is a suite") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  report.trees.push_back(report_of(kSmallTree, "").trees[0]);
  CHECK(number(checked(report), "tests") == 9);
}

}  // namespace
}  // namespace btcheck::junit_test
