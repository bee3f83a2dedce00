// SPDX-License-Identifier: MIT
//
// The object and the lines, under the names that docs/reports.md gives.
#include "report/formats/formats.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/checked_report.hpp"
#include "report/text/space_report.hpp"

namespace btcheck::json_report_test {
namespace {

using Json = nlohmann::json;

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(Json::parse(line));
  }
  return lines;
}

std::vector<std::string> kinds_of(const std::vector<Json>& lines) {
  std::vector<std::string> kinds;
  for (const Json& line : lines) {
    kinds.push_back(line.at("event").get<std::string>());
  }
  return kinds;
}

const std::string kRules =
    "## Nobody fails.\n"
    "property fails [safety, req=7]: never a.failure\n"
    "property calm expect holds: never a.halted\n"
    "property asked: c.success leadsto a.ticked within [0,2]\n";

TEST_CASE("one object has the schema, the verdicts and the timing") {
  const Json json = Json::parse(json_text(report_of(kSmallTree, kRules)));
  CHECK(json.at("schema") == "btcheck/1");
  CHECK(json.at("tool") == "btcheck");
  CHECK(json.at("exit_code") == 1);
  CHECK(json.at("timing") ==
        Json{{"started", "2026-11-22T09:30:00Z"}, {"seconds", 0.25}});
  const Json& tree = json.at("trees").at(0);
  CHECK(tree.at("tree") == "trees/t.btf");
  CHECK(tree.at("nodes") == 4);
  CHECK(tree.at("variables") == 0);
  CHECK(tree.at("diagnostics").empty());
  CHECK(tree.at("timing") == Json{{"seconds", 0.25}, {"peak_bytes", 4096}});
  const Json& file = tree.at("files").at(0);
  CHECK(file.at("properties") == "rules/p.ltl");
  CHECK(file.at("profile") == "paper");
  CHECK(file.at("tick") == "root");
  CHECK(file.at("faults") == false);
  REQUIRE(file.at("verdicts").size() == 3);
}

TEST_CASE("a verdict tells what was asked, answered and expected") {
  const Json json = Json::parse(json_text(report_of(kSmallTree, kRules)));
  const Json& verdicts = json["trees"][0]["files"][0]["verdicts"];
  const Json& fails = verdicts[0];
  CHECK(fails.at("name") == "fails");
  CHECK(fails.at("title") == "Nobody fails.");
  CHECK(fails.at("property") == "never a.failure");
  CHECK(fails.at("tags") == Json{"safety", "req=7"});
  CHECK(fails.at("file") == "rules/p.ltl");
  CHECK(fails.at("line") == 2);
  CHECK(fails.at("verdict") == "VIOLATED");
  CHECK(fails.at("expected").is_null());
  CHECK(fails.at("met") == false);
  CHECK(fails.at("note") == "after 1 tick");
  CHECK(fails.at("why") ==
        "a -> failure in tick 1 breaks the rule; with a -> success or a -> "
        "running it need not have been broken.");
  CHECK(fails.at("stopped").is_null());
  CHECK(fails.at("error").is_null());
  CHECK(fails.at("states").get<int>() > 0);
  const Json& run = fails.at("run");
  CHECK(run.at("unit") == "tick");
  CHECK(run.at("time") == 1);
  CHECK(run.at("infinite") == false);
  CHECK(run.at("events").at(0) == Json{{"time", 1},
                                       {"event", "c -> success"},
                                       {"chosen", true},
                                       {"line", 2},
                                       {"column", 3}});
  CHECK(run["events"].back() ==
        Json{{"time", 1}, {"remark", "here it is so: a.failure"}});
  CHECK(verdicts[1].at("verdict") == "HOLDS");
  CHECK(verdicts[1].at("expected") == "HOLDS");
  CHECK(verdicts[1].at("met") == true);
  CHECK(verdicts[1].at("run").is_null());
  CHECK(verdicts[2].at("asked") == 1);
  CHECK(verdicts[2].at("longest_answer") == 0);
  CHECK(verdicts[2].at("for_every").empty());
}

TEST_CASE("what is undecided is neither met nor missed") {
  CheckOptions few;
  few.limits.max_states = 1;
  const Json json = Json::parse(
      json_text(report_of(kSmallTree, "property p: never a.halted\n", few)));
  const Json& verdict = json["trees"][0]["files"][0]["verdicts"][0];
  CHECK(verdict["verdict"] == "UNDECIDED");
  CHECK(verdict["met"].is_null());
  CHECK(verdict["stopped"] == "max-states");
  CHECK(json["exit_code"] == 3);
}

TEST_CASE("the default report has answers and nodes") {
  const Json json = Json::parse(json_text(report_of(kSmallTree, "")));
  const Json& file = json["trees"][0]["files"][0];
  CHECK(file.at("properties").is_null());
  REQUIRE(file.at("answers").size() == 7);
  CHECK(file["answers"][0].at("key") == "can_succeed");
  CHECK(file["answers"][0].at("verdict") == "HOLDS");
  CHECK(file["answers"][0].at("answer") == "yes, e.g. in tick 1");
  REQUIRE(file.at("nodes").size() == 4);
  const Json& leaf = file["nodes"][3];
  CHECK(leaf.at("name") == "a");
  CHECK(leaf.at("type") == "Action");
  CHECK(leaf.at("running") == Json{{"verdict", "HOLDS"}, {"time", 1}});
  CHECK(leaf.at("halted") == Json{{"verdict", "VIOLATED"}});
  CHECK(!file["nodes"][2].contains("running"));
  const Json& findings = json["trees"][0].at("findings");
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].at("code") == "BT2205");
  CHECK(findings[0].at("severity") == "note");
}

TEST_CASE("an input that cannot be read is told by its diagnostics") {
  const Json json = Json::parse(
      json_text(report_of("(BehaviorTree :name t (Actoin :ID a))", "")));
  CHECK(json["exit_code"] == 2);
  const Json& tree = json["trees"][0];
  CHECK(tree["files"].empty());
  REQUIRE(tree["diagnostics"].size() == 1);
  const Json& diagnostic = tree["diagnostics"][0];
  CHECK(diagnostic.at("severity") == "error");
  CHECK(diagnostic.at("code") == "BT1004");
  CHECK(diagnostic.at("file") == "trees/t.btf");
  CHECK(diagnostic.at("line") == 1);
  CHECK(diagnostic.at("column") == 24);
  CHECK(diagnostic.at("length") == 6);
}

TEST_CASE("lines begin with start and finish with end") {
  const std::vector<Json> lines =
      lines_of(json_lines(report_of(kSmallTree, kRules)));
  const std::vector<std::string> expected = {"start",   "verdict", "verdict",
                                             "verdict", "finding", "end"};
  CHECK(kinds_of(lines) == expected);
  CHECK(lines[0].at("schema") == "btcheck/1");
  CHECK(lines[0].at("tree") == "trees/t.btf");
  CHECK(lines[0].at("properties") == Json{"rules/p.ltl"});
  CHECK(lines[1].at("tree") == "trees/t.btf");
  CHECK(lines[1].at("properties") == "rules/p.ltl");
  CHECK(lines[1].at("name") == "fails");
  CHECK(lines[5].at("exit_code") == 1);
}

TEST_CASE("the lines say what the object says") {
  const Report report = report_of(kSmallTree, "");
  const Json json = Json::parse(json_text(report));
  const Json& file = json["trees"][0]["files"][0];
  std::vector<Json> answers;
  std::vector<Json> nodes;
  for (const Json& line : lines_of(json_lines(report))) {
    if (line["event"] == "answer") answers.push_back(line);
    if (line["event"] == "node") nodes.push_back(line);
  }
  REQUIRE(answers.size() == file["answers"].size());
  REQUIRE(nodes.size() == file["nodes"].size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    for (const auto& [key, value] : file["answers"][i].items()) {
      CHECK(answers[i].at(key) == value);
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const auto& [key, value] : file["nodes"][i].items()) {
      CHECK(nodes[i].at(key) == value);
    }
  }
}

TEST_CASE("a line tells how a search goes on") {
  SearchProgress progress;
  progress.states = 100;
  progress.expanded = 60;
  progress.transitions = 250;
  progress.depth = 7;
  const Json line = Json::parse(json_progress_line(progress, 1.5));
  CHECK(line.at("event") == "progress");
  CHECK(line.at("states") == 100);
  CHECK(line.at("frontier") == 40);
  CHECK(line.at("depth") == 7);
  CHECK(line.at("timing").at("seconds") == 1.5);
}

TEST_CASE("the same check gives the same text but for its timing") {
  const auto without_timing = [](Report report) {
    report.started.clear();
    report.trees[0].seconds = 0;
    return json_text(report);
  };
  CHECK(without_timing(report_of(kSmallTree, kRules)) ==
        without_timing(report_of(kSmallTree, kRules)));
}

TEST_CASE("names that are no UTF-8 do not break the figures of a space") {
  const std::string file = "\xff.btf";
  const Network network;
  const SpaceOptions options;
  const std::string text = space_json({}, {file, network, options});
  CHECK(Json::parse(text)["tree"] == "\ufffd.btf");
}

TEST_CASE("a quotient that is not known has no figures") {
  const Network network;
  const SpaceOptions options;
  SpaceQuotient quotient;
  SpaceContext context{"t.btf", network, options};
  CHECK(!Json::parse(space_json({}, context)).contains("quotient"));
  context.modulo = Equivalence::Branching;
  context.quotient = &quotient;
  quotient.stopped = StopReason::Memory;
  Json told = Json::parse(space_json({}, context));
  CHECK(told["reduce"] == "bisimulation");
  CHECK(told["quotient"]["states"].is_null());
  CHECK(told["quotient"]["stopped"] == "memory");
  quotient.stopped = StopReason::None;
  quotient.graph.add_state({});
  quotient.labels = {"i", "time"};
  told = Json::parse(space_json({}, context))["quotient"];
  CHECK(told["equivalence"] == "branching-with-divergence");
  CHECK(told["observe"] == "all");
  CHECK(told["states"] == 1);
  CHECK(told["transitions"] == 0);
  CHECK(told["labels"] == 1);
  CHECK(told["stopped"].is_null());
}

TEST_CASE("a repair is told by the lines that it changes") {
  Report report = report_of(kSmallTree, kRules);
  REQUIRE(!report.trees[0].findings.empty());
  const auto repair_told = [&] {
    const Json document = Json::parse(json_text(report));
    return document["trees"][0]["findings"][0]["repair"];
  };
  CHECK(repair_told().is_null());
  report.trees[0].findings[0].repair = a_repair();
  CHECK(repair_told()["of"] == "BT2210");
  const Json change = repair_told()["changes"].at(0);
  CHECK(change["file"] == "trees/t.btf");
  CHECK(change["line"] == 1);
  CHECK(change["end_line"] == 2);
  CHECK(change["replacement"] == "(BehaviorTree :name t (Fallback :name s\n");
}

TEST_CASE("names that are no UTF-8 do not break the object") {
  Report report = report_of(kSmallTree, kRules);
  report.trees[0].file = "t\xff.btf";
  CHECK(Json::accept(json_text(report)));
  CHECK(Json::accept(json_start_line("t\xff.btf", {"\xc3"})));
}

}  // namespace
}  // namespace btcheck::json_report_test
