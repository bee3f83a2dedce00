// SPDX-License-Identifier: MIT
//
// The page that GitHub shows of a job: Markdown.
#pragma once

#include <string>

#include "report/formats/reported.hpp"

namespace btcheck {

// What somebody should look at, then a folded table of all trees.
std::string job_summary_text(const Report& report);

}  // namespace btcheck
