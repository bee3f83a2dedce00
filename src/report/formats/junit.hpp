// SPDX-License-Identifier: MIT
//
// Verdicts for whatever runs tests: JUnit XML.
#pragma once

#include <string>

#include "report/formats/reported.hpp"

namespace btcheck {

// A suite for each tree, a case for each property, or for each question of the
// default report about the tree as a whole. Failed: not as expected; skipped:
// undecided; an error: ours, or an input that cannot be checked.
//
// One search answers many properties, so what it took is shared out evenly.
std::string junit_text(const Report& report);

}  // namespace btcheck
