// SPDX-License-Identifier: MIT
//
// A run in little space, for the page of the trace viewer.
#pragma once

#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// JSON that src/trace/viewer/run.js unpacks. It has no `<` and no line
// separator of JavaScript, so it may stand in a script element as it is.
std::string packed_run(const RecordedRun& run);

}  // namespace btcheck
