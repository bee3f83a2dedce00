// SPDX-License-Identifier: MIT
//
// Findings for code scanning: SARIF 2.1.0, with the runs as code flows.
#pragma once

#include <string>

#include "report/formats/reported.hpp"

namespace btcheck {

// The most steps of a run that a code flow has: what GitHub shows. Of a longer
// run the middle is left out.
inline constexpr std::size_t kMostFlowSteps = 1000;

std::string sarif_text(const Report& report);

}  // namespace btcheck
