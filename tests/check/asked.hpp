// SPDX-License-Identifier: MIT
//
// Verdicts on the nodes of one XML tree, in a few letters.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/check.hpp"
#include "check/checked.hpp"

namespace btcheck {

struct Asked {
  std::string tree;
  std::string leaves = "";
  Profile profile = Profile::Btcpp4;
  bool loops = true;  // it is ticked for ever
  std::string models = "";
};

// With no rules: the default report.
inline CheckResult checked(const Asked& asked,
                           const std::vector<InputFile>& rules) {
  TreeInput input("t.xml", "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\">" +
                               asked.tree + "</BehaviorTree>" + asked.models +
                               "</root>");
  input.reading.profile = asked.profile;
  input.reading.loops = asked.loops;
  if (!asked.leaves.empty()) {
    input.reading.leaves = {{"t.leaves", asked.leaves}};
  }
  CheckResult result = check(input, rules, {});
  for (const Diagnostic& found : result.diagnostics) {
    if (found.severity == Severity::Error) FAIL(render(found));
  }
  REQUIRE(result.files.size() == 1);
  return result;
}

// "H", "V" or "U" for each rule.
inline std::string verdicts(const Asked& asked, const std::string& rules) {
  const CheckResult result = checked(asked, {{"p.ltl", rules}});
  std::string told;
  for (const PropertyVerdict& verdict : result.files[0].verdicts) {
    CHECK(verdict.error == "");
    told += verdict.verdict == Verdict::Holds      ? 'H'
            : verdict.verdict == Verdict::Violated ? 'V'
                                                   : 'U';
  }
  return told;
}

}  // namespace btcheck
