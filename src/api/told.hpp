// SPDX-License-Identifier: MIT
//
// What the program tells, copied out for those who call.
#pragma once

#include <optional>
#include <string_view>

#include "btcheck/check.hpp"
#include "report/formats/reported.hpp"

namespace btcheck::v1 {

Position position_of(const Place& place);
Run run_of(const ToldRun& told);
Finding finding_of(const btcheck::Finding& of);
Rule rule_of(const ReportedProperty& of);
Node node_of(const ReportedNode& of);
Answer answer_of(const ReportedAnswer& of);

// What has come of a rule: a verdict says it as well.
bool is_of_rule(const Finding& finding);
// "HOLDS"
std::string_view verdict_word(Verdict verdict);

}  // namespace btcheck::v1
