// SPDX-License-Identifier: MIT
//
// What the program tells, copied out for those who call.
#pragma once

#include <optional>

#include "btcheck/check.hpp"
#include "report/formats/reported.hpp"

namespace btcheck::v1 {

Position position_of(const Place& place);
Run run_of(const ToldRun& told);
Finding finding_of(const btcheck::Finding& of);
Rule rule_of(const ReportedProperty& of);
Node node_of(const ReportedNode& of);
Answer answer_of(const ReportedAnswer& of);

}  // namespace btcheck::v1
