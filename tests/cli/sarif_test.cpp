// SPDX-License-Identifier: MIT
//
// What GitHub requires of SARIF, checked on reports of every kind. The whole
// schema is checked by tests/formats/sarif_schema.mjs.
#include "report/formats/formats.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli/checked_report.hpp"
#include "cli/options/interface.hpp"

namespace btcheck::sarif_test {
namespace {

using Json = nlohmann::json;

void require_text(const Json& message) {
  REQUIRE(message.at("text").is_string());
  CHECK(!message.at("text").get<std::string>().empty());
}

void check_location(const Json& location) {
  const Json& physical = location.at("physicalLocation");
  const auto uri = physical.at("artifactLocation").at("uri").get<std::string>();
  CHECK(!uri.empty());
  CHECK(uri.find(' ') == std::string::npos);
  const Json& region = physical.at("region");
  CHECK(region.at("startLine").get<int>() >= 1);
  CHECK(region.at("startColumn").get<int>() >= 1);
  CHECK(region.at("endLine").get<int>() == region.at("startLine").get<int>());
  CHECK(region.at("endColumn").get<int>() >=
        region.at("startColumn").get<int>());
}

void check_rules(const Json& rules) {
  std::set<std::string> ids;
  for (const Json& rule : rules) {
    CHECK(ids.insert(rule.at("id").get<std::string>()).second);
    require_text(rule.at("shortDescription"));
    require_text(rule.at("fullDescription"));
    CHECK(rule.at("fullDescription").at("text").get<std::string>().size() <=
          1024);
    require_text(rule.at("help"));
    CHECK(std::set<std::string>{"error", "warning", "note"}.contains(
        rule.at("defaultConfiguration").at("level").get<std::string>()));
  }
}

void check_flow(const Json& flows) {
  REQUIRE(flows.size() == 1);
  REQUIRE(flows[0].at("threadFlows").size() == 1);
  const Json& steps = flows[0]["threadFlows"][0].at("locations");
  CHECK(!steps.empty());
  CHECK(steps.size() <= kMostFlowSteps);
  int order = 0;
  for (const Json& step : steps) {
    CHECK(step.at("executionOrder").get<int>() == ++order);
    check_location(step.at("location"));
    require_text(step.at("location").at("message"));
  }
}

void check_result(const Json& result, const Json& rules,
                  std::set<std::string>& prints) {
  const auto index = result.at("ruleIndex").get<std::size_t>();
  REQUIRE(index < rules.size());
  CHECK(rules[index].at("id") == result.at("ruleId"));
  CHECK(std::set<std::string>{"error", "warning", "note"}.contains(
      result.at("level").get<std::string>()));
  require_text(result.at("message"));
  REQUIRE(result.at("locations").size() == 1);
  check_location(result["locations"][0]);
  std::set<int> ids;
  for (const Json& related : result.value("relatedLocations", Json::array())) {
    CHECK(ids.insert(related.at("id").get<int>()).second);
    check_location(related);
    require_text(related.at("message"));
  }
  CHECK(prints
            .insert(result.at("partialFingerprints")
                        .at("primaryLocationLineHash")
                        .get<std::string>())
            .second);
  if (result.contains("codeFlows")) check_flow(result["codeFlows"]);
}

// The run of a report that has everything GitHub asks for.
Json checked_run(const Report& report) {
  const Json document = Json::parse(sarif_text(report));
  CHECK(document.at("$schema") ==
        "https://json.schemastore.org/sarif-2.1.0.json");
  CHECK(document.at("version") == "2.1.0");
  REQUIRE(document.at("runs").size() == 1);
  const Json& run = document["runs"][0];
  const Json& driver = run.at("tool").at("driver");
  CHECK(driver.at("name") == "btcheck");
  CHECK(driver.at("version").get<std::string>() == kVersion);
  CHECK(driver.at("semanticVersion").get<std::string>() == kVersion);
  CHECK(driver.at("informationUri").get<std::string>().starts_with("https://"));
  CHECK(run.at("columnKind") == "unicodeCodePoints");
  check_rules(driver.at("rules"));
  std::set<std::string> prints;
  for (const Json& result : run.at("results")) {
    check_result(result, driver["rules"], prints);
  }
  return run;
}

Json only_result(const Report& report) {
  const Json run = checked_run(report);
  REQUIRE(run["results"].size() == 1);
  return run["results"][0];
}

std::vector<std::string> flow_texts(const Json& result) {
  std::vector<std::string> texts;
  for (const Json& step :
       result.at("codeFlows")[0].at("threadFlows")[0].at("locations")) {
    texts.push_back(step["location"]["message"]["text"].get<std::string>());
  }
  return texts;
}

TEST_CASE("a check without findings has the rules and no result") {
  const Json run =
      checked_run(report_of(kSmallTree, "property p: never a.halted\n"));
  CHECK(run["results"].empty());
  CHECK(run["tool"]["driver"]["rules"].size() >= 10);
  CHECK(run["automationDetails"]["id"] == "btcheck/trees/t/");
  CHECK(run["invocations"][0]["executionSuccessful"] == true);
  CHECK(run["invocations"][0]["exitCode"] == 0);
}

TEST_CASE("a violation is a result on the node, with its run") {
  const Json result = only_result(
      report_of(kSmallTree,
                "property late: a.running leadsto root.ended within [0,1]\n"));
  CHECK(result["ruleId"] == "BT2001");
  CHECK(result["level"] == "error");
  const Json& place = result["locations"][0]["physicalLocation"];
  CHECK(place["artifactLocation"]["uri"] == "trees/t.btf");
  CHECK(place["region"] == Json{{"startLine", 2},
                                {"startColumn", 21},
                                {"endLine", 2},
                                {"endColumn", 27}});
  CHECK(result["locations"][0]["logicalLocations"][0]["fullyQualifiedName"] ==
        "t/s/a");
  CHECK(result["relatedLocations"][0]["physicalLocation"]["artifactLocation"]
              ["uri"] == "rules/p.ltl");
  CHECK(flow_texts(result) ==
        std::vector<std::string>{
            "tick 1 begins", "tick 1: c -> success (chosen)",
            "tick 1: a -> running (chosen)", "-- asked here, not answered",
            "tick 2 begins", "tick 2: a -> running (chosen)",
            "-- the time for an answer is over"});
}

TEST_CASE("the loop of a run is marked") {
  const auto texts = flow_texts(
      only_result(report_of("(BehaviorTree :name t :loop 1 (Action :ID x :SF))",
                            "property p: always eventually x.failure\n")));
  CHECK(std::count(texts.begin(), texts.end(), "-- the loop begins") == 1);
  CHECK(texts.back() == "-- this repeats for ever");
}

TEST_CASE("of a long run the middle is left out") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  Finding& finding = report.trees[0].findings.at(0);
  const ToldStep step = finding.run->steps[1];
  finding.run->steps.assign(5000, step);
  finding.run->steps.front().text = "the first";
  finding.run->steps.back().text = "the last";
  const auto texts = flow_texts(only_result(report));
  REQUIRE(texts.size() == 1000);
  CHECK(texts.front().find("the first") != std::string::npos);
  CHECK(texts.back().find("the last") != std::string::npos);
  CHECK(texts[500] == "-- 4001 steps are left out here");
  finding.run->steps.resize(1000);
  CHECK(flow_texts(only_result(report)).size() == 1000);
}

TEST_CASE("every kind of report has what GitHub requires") {
  CheckOptions few;
  few.limits.max_states = 1;
  const std::string faulty =
      "(defsv k :max 1)(BehaviorTree :name t (Sequence"
      " (Action :ID a :SF) (Eval (:= k (+ k 2)))))";
  for (const Report& report :
       {report_of(kSmallTree, ""), report_of(faulty, ""),
        report_of(kSmallTree, "", few),
        report_of(kSmallTree, "property p: never a.halted\n", few),
        report_of(kSmallTree, "property p: a.halted leadsto c.ticked\n"),
        report_of(faulty, "property p: possible a.halted\n"),
        report_of("(BehaviorTree :name t (Actoin :ID a))", ""),
        report_of("", ""), report_of("(((", "")}) {
    CHECK(!checked_run(report)["results"].empty());
  }
}

TEST_CASE("errors in the inputs are results with rules of their own") {
  const Json run = checked_run(
      report_of(kSmallTree,
                "property p: never b.running\nproperty q: never d.running\n"));
  CHECK(run["invocations"][0]["executionSuccessful"] == false);
  CHECK(run["invocations"][0]["exitCode"] == 2);
  REQUIRE(run["results"].size() == 2);
  const Json& result = run["results"][1];
  CHECK(result["ruleId"] == "BT1101");
  CHECK(result["locations"][0]["physicalLocation"]["region"]["startLine"] == 2);
}

TEST_CASE("a repair that was checked is a fix") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  CHECK(!only_result(report).contains("fixes"));
  report.trees[0].findings[0].repair = a_repair();
  const Json fix = only_result(report)["fixes"].at(0);
  CHECK(fix["description"]["text"].get<std::string>().starts_with("Checked"));
  const Json change = fix["artifactChanges"].at(0);
  CHECK(change["artifactLocation"]["uri"] == "trees/t.btf");
  const Json region = change["replacements"].at(0)["deletedRegion"];
  CHECK(region == Json{{"startLine", 1},
                       {"startColumn", 1},
                       {"endLine", 2},
                       {"endColumn", 1}});
  CHECK(change["replacements"].at(0)["insertedContent"]["text"] ==
        "(BehaviorTree :name t (Fallback :name s\n");
}

TEST_CASE("hostile names make valid JSON and no links") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  ReportedTree& tree = report.trees[0];
  tree.findings[0].message = "[](x) {0} \x01 \xff";
  tree.findings[0].place.file = "a b\xff#.btf";
  const Json result = only_result(report);
  CHECK(result["message"]["text"] == "[] (x) {{0}} ? ?");
  CHECK(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] ==
        "a%20b%FF%23.btf");
}

TEST_CASE("several trees are one run, none of which replaces another's") {
  Report report = report_of(kSmallTree, "property p: never a.failure\n");
  report.trees.push_back(report.trees[0]);
  const Json run = checked_run(report);
  CHECK(run["automationDetails"]["id"] == "btcheck/");
  CHECK(run["results"].size() == 2);
}

}  // namespace
}  // namespace btcheck::sarif_test
