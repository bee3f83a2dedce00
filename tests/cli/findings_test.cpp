// SPDX-License-Identifier: MIT
//
// Where a finding stands, and what stays the same when the file is edited.
#include "report/formats/reported.hpp"

#include <doctest/doctest.h>

#include <string>

#include "cli/checked_report.hpp"
#include "model/tree/tree.hpp"
#include "report/codes/codes.hpp"

namespace btcheck::findings_test {
namespace {

TEST_CASE("a violation stands on the node whose step breaks the property") {
  const Report report = report_of(kSmallTree, "property p: never a.failure\n");
  const Finding finding = finding_with(report, "BT2001");
  CHECK(finding.severity == Severity::Error);
  CHECK(finding.title == "p");
  CHECK(finding.place.file == "trees/t.btf");
  CHECK(finding.place.span.line == 2);
  CHECK(finding.place.span.column == 21);
  CHECK(finding.node == "t/s/a");
  CHECK(finding.message ==
        "p is violated (after 1 tick): never a.failure.\n"
        "Why: a -> failure in tick 1 breaks the rule; with a -> success or "
        "a -> running it need not have been broken.");
  REQUIRE(finding.related.size() == 1);
  CHECK(finding.related[0].place.file == "rules/p.ltl");
  CHECK(finding.related[0].place.span.line == 1);
  CHECK(finding.related[0].text == "property p");
}

TEST_CASE("a late answer stands on the last event before it") {
  const Report report = report_of(
      kSmallTree, "property p: a.running leadsto root.ended within [0,1]\n");
  const Finding finding = finding_with(report, "BT2001");
  CHECK(finding.node == "t/s/a");
  REQUIRE(finding.run);
  CHECK(finding.run->steps.back().text == "the time for an answer is over");
}

TEST_CASE("a loop stands on an event of a node that the property names") {
  const Report report = report_of(
      "(BehaviorTree :name t :loop 1 (Sequence :name s (Action :ID x :SF)\n"
      "(Action :ID y :SF)))",
      "property p: always eventually x.failure\n");
  const Finding finding = finding_with(report, "BT2001");
  CHECK(finding.node == "t/s/x");
  REQUIRE(finding.run);
  CHECK(finding.run->loop.has_value());
}

TEST_CASE("a variable that moves by itself can be what breaks it") {
  const Report report = report_of(
      "(defsv meteo :states (Calm Storm) :init Calm :transitions :all)\n" +
          kSmallTree,
      "property p: never meteo == Storm\n");
  const Finding finding = finding_with(report, "BT2001");
  CHECK(finding.node == "variable meteo");
  CHECK(finding.place.span.line == 1);
  CHECK(finding.place.span.column == 8);
}

TEST_CASE("what no run shows stands on the node that is spoken of") {
  const Finding never = finding_with(
      report_of(kSmallTree, "property p: possible a.halted\n"), "BT2001");
  CHECK(never.node == "t/s/a");
  CHECK(!never.run);
  const Finding vacuous = finding_with(
      report_of(kSmallTree, "property p: a.halted leadsto c.ticked\n"),
      "BT2004");
  CHECK(vacuous.severity == Severity::Warning);
  CHECK(vacuous.place.file == "rules/p.ltl");
  const Finding unexpected = finding_with(
      report_of(kSmallTree, "property p expect violated: never a.halted\n"),
      "BT2002");
  CHECK(unexpected.severity == Severity::Error);
  CHECK(unexpected.place.file == "rules/p.ltl");
  CHECK(unexpected.message ==
        "p holds (expected a violation): never a.halted.");
}

TEST_CASE("what is as expected is no finding") {
  const Report report =
      report_of(kSmallTree,
                "property p: never a.halted\n"
                "property q expect violated: never a.failure\n");
  CHECK(report.trees[0].findings.empty());
  CHECK(report.code() == ExitCode::Met);
}

TEST_CASE("a limit is a finding of its own kind") {
  CheckOptions options;
  options.limits.max_states = 1;
  const Finding property = finding_with(
      report_of(kSmallTree, "property p: never a.halted\n", options), "BT2003");
  CHECK(property.severity == Severity::Warning);
  CHECK(property.message.find("--max-states") != std::string::npos);
  const Finding all =
      finding_with(report_of(kSmallTree, "", options), "BT2003");
  CHECK(all.place.span.line == 1);
}

TEST_CASE("the default report finds faults, and what is worth a look") {
  const std::string tree =
      "(defsv k :max 1)(BehaviorTree :name t (Fallback\n"
      "(Eval :name sure (< k 2))\n (Action :ID late)\n"
      "(Sequence (Action :ID later))))";
  const Report report = report_of(tree, "");
  const Finding sure = finding_with(report, "BT2203");
  CHECK(sure.node == "t/Fallback/sure");
  CHECK(sure.message.starts_with(
      "`sure` is always true when it is ticked.\nWhy: "));
  // One finding for one cause.
  const Finding dead = finding_with(report, "BT2201");
  CHECK(dead.node == "t/Fallback/late");
  CHECK(dead.message.starts_with("`late` and `Sequence4` are never ticked."));
  const Finding fault = finding_with(
      report_of("(defsv k :max 1)(BehaviorTree :name t (Sequence"
                " (Action :ID a :SF) (Eval :name up (:= k (+ k 2)))))",
                ""),
      "BT2101");
  CHECK(fault.severity == Severity::Error);
  CHECK(fault.node == "t/Sequence/up");
  REQUIRE(fault.run);
}

TEST_CASE("a fault beside rules is a warning") {
  const Finding fault = finding_with(
      report_of("(defsv k :max 1)(BehaviorTree :name t (Sequence"
                " (Action :ID a :SF) (Eval :name up (:= k (+ k 2)))))",
                "property p: never a.halted\n"),
      "BT2101");
  CHECK(fault.severity == Severity::Warning);
}

TEST_CASE("a stale guard is told at the guard, and points at the actions") {
  const Finding stale = finding_with(report_of(kSmallTree, ""), "BT2205");
  CHECK(stale.severity == Severity::Note);
  CHECK(stale.node == "t/s/c");
  REQUIRE(stale.related.size() == 1);
  CHECK(stale.related[0].text == "a is here");
  REQUIRE(stale.run);
}

TEST_CASE("what is wrong with an input stands where it is written") {
  const Report report = report_of(kSmallTree, "property p: never b.running\n");
  const Finding finding = finding_with(report, "BT1101");
  CHECK(finding.place.file == "rules/p.ltl");
  CHECK(finding.place.span.line == 1);
  CHECK(finding.title == "no node, variable or symbol of this name");
  CHECK(
      finding.message.starts_with("unknown node `b`: no node has this name."));
  CHECK(report.code() == ExitCode::BadInput);
  CHECK(report.trees[0].files.empty());
}

// The same tree with everything further down.
TEST_CASE("findings are recognised when lines have moved") {
  const std::string tree =
      "(BehaviorTree :name t (Fallback (Sequence (Condition :ID c)\n"
      "(Action :ID a)) (Sequence (Condition :ID d) (Action :ID b))))";
  const std::string rules =
      "property p: never root.failure\nproperty q: possible c.halted\n";
  for (const std::string& properties : {rules, std::string()}) {
    const Report before = report_of(tree, properties);
    std::string moved = properties;
    if (!moved.empty()) moved.insert(0, "# a comment\n\n");
    const Report after = report_of("; more lines\n\n\n" + tree, moved);
    const auto& old_ones = before.trees[0].findings;
    const auto& new_ones = after.trees[0].findings;
    REQUIRE(old_ones.size() == new_ones.size());
    REQUIRE(old_ones.size() >= 2);
    for (std::size_t i = 0; i < old_ones.size(); ++i) {
      CHECK(old_ones[i].identity == new_ones[i].identity);
      CHECK(old_ones[i].place.span.line != new_ones[i].place.span.line);
      for (std::size_t j = 0; j < i; ++j) {
        CHECK(old_ones[i].identity != old_ones[j].identity);
      }
    }
  }
}

TEST_CASE("a fingerprint is the same from wherever the program is run") {
  Report above = report_of(kSmallTree, "property p: never a.failure\n");
  Report beside = above;
  beside.directory = "/home/robot/trees";
  Finding& finding = beside.trees[0].findings.at(0);
  const std::string print =
      fingerprint_of(above, above.trees[0].findings.at(0));
  finding.place.file = "./t.btf";
  CHECK(fingerprint_of(beside, finding) == print);
  finding.place.file = "/home/robot/trees/t.btf";
  CHECK(fingerprint_of(beside, finding) == print);
  finding.place.file = "u.btf";
  CHECK(fingerprint_of(beside, finding) != print);
}

TEST_CASE("a path names no line, and tells siblings apart") {
  const auto tree = read_btf(
      "t.btf",
      "(BehaviorTree :name t (Sequence\n(Fallback (Action :ID a) (Action :ID "
      "a))"
      "\n(Fallback :name own (Action :ID a))\n(Fallback (Action :ID b))))");
  REQUIRE(tree.value);
  const auto path = [&](std::uint32_t node) {
    return stable_path(*tree.value, NodeId{node});
  };
  CHECK(path(0) == "t");
  CHECK(path(1) == "t/Sequence");
  CHECK(path(2) == "t/Sequence/Fallback");
  CHECK(path(3) == "t/Sequence/Fallback/a");
  CHECK(path(4) == "t/Sequence/Fallback/a#2");
  CHECK(path(6) == "t/Sequence/own/a");
  CHECK(path(8) == "t/Sequence/Fallback#2/b");
}

TEST_CASE("every kind has its rule, in the order of the codes") {
  std::string last;
  for (const CodeRow& rule : verdict_codes()) {
    CHECK(last < rule.code);
    last = rule.code;
    CHECK(code_named(rule.code) == &rule);
    CHECK(rule.summary.ends_with('.'));
    CHECK(rule.description.ends_with('.'));
    CHECK(rule.help.ends_with('.'));
    CHECK(rule.description.size() <= 1024);
    CHECK(!rule.name.empty());
  }
  CHECK(code_named("BT1101")->name.empty());
  CHECK(diagnostic_summary("BT1101") ==
        "no node, variable or symbol of this name");
  CHECK(diagnostic_summary("BT1999") == "something is wrong with an input");
}

}  // namespace
}  // namespace btcheck::findings_test
