// SPDX-License-Identifier: MIT
//
// What of a check's results somebody should look at, and where.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/formats/reported.hpp"

namespace btcheck {

// Codes of findings that no single question of the default report asks for.
namespace rule {
inline constexpr std::string_view kViolated = "BT2001";
inline constexpr std::string_view kHolds = "BT2002";
inline constexpr std::string_view kUndecided = "BT2003";
inline constexpr std::string_view kVacuous = "BT2004";
inline constexpr std::string_view kFault = "BT2101";
inline constexpr std::string_view kInternal = "BT9002";
}  // namespace rule

// Of one property file, or of the default report. `reported` says the same as
// `file`; the runs are taken from there.
std::vector<Finding> findings_of(const CheckResult& result,
                                 const CheckedFile& file,
                                 const ReportedFile& reported);

Finding finding_of(const Diagnostic& diagnostic);

// What a diagnostic of that code is about, in a few words without a full stop;
// for an unknown code, words that fit every one.
std::string_view diagnostic_summary(std::string_view code);

// Names from the root down to the node, the same when lines have moved: a node
// without a name of its own goes by its type, and among siblings of the same
// name by its number. "t/Sequence/land#2"
std::string stable_path(const BehaviorTree& tree, NodeId node);

}  // namespace btcheck
