// SPDX-License-Identifier: MIT
//
// What of a check's results somebody should look at, and where.
#pragma once

#include <string>
#include <vector>

#include "report/formats/reported.hpp"

namespace btcheck {

// Of one property file, or of the default report. `reported` says the same as
// `file`, and its runs are taken from there.
std::vector<Finding> findings_of(const CheckResult& result,
                                 const CheckedFile& file,
                                 const ReportedFile& reported);

Finding finding_of(const Diagnostic& diagnostic);

// Names from the root down to the node. What no author wrote stays out: where
// `path_name` has a name made of a line number, this has the node's type and,
// among siblings of the same name, which of them it is.
std::string stable_path(const BehaviorTree& tree, NodeId node);

}  // namespace btcheck
