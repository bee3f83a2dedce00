// SPDX-License-Identifier: MIT
//
// Reports of small trees, made as the program makes them.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/check.hpp"
#include "report/formats/reported.hpp"
#include "report/text/report.hpp"

namespace btcheck {

inline const std::string kSmallTree =
    "(BehaviorTree :name t (Sequence :name s\n"
    " (Condition :ID c) (Action :ID a)))";

inline Report report_on(const CheckResult& result, const std::string& file) {
  Report report;
  report.directory = "/home/robot";
  report.root = "/home/robot";
  report.started = "2026-11-22T09:30:00Z";
  report.trees.push_back(reported(result, file, exit_code_of(result)));
  report.trees.back().seconds = 0.25;
  report.trees.back().peak_bytes = 4096;
  return report;
}

// Of a tree with a file of properties, "" for the default report.
inline Report report_of(const std::string& tree, const std::string& properties,
                        const CheckOptions& options = {}) {
  std::vector<InputFile> files;
  if (!properties.empty()) files.push_back({"rules/p.ltl", properties});
  return report_on(check({"trees/t.btf", tree}, files, options), "trees/t.btf");
}

// What a check would have found to put the actions into a Fallback.
inline CheckedRepair a_repair() {
  std::string repaired = kSmallTree;
  repaired.replace(repaired.find("Sequence"), 8, "Fallback");
  return {{changed_lines("trees/t.btf", kSmallTree, repaired)}, "BT2210"};
}

// The one finding of a report with this code.
inline Finding finding_with(const Report& report, const std::string& code) {
  std::vector<Finding> found;
  for (const Finding& finding : all_findings(report.trees.at(0))) {
    if (finding.code == code) found.push_back(finding);
  }
  CAPTURE(code);
  REQUIRE(found.size() == 1);
  return found[0];
}

}  // namespace btcheck
