// SPDX-License-Identifier: MIT
//
// What stands beside a node's name in its file, for drawings of the tree alone.
#pragma once

#include <cstddef>
#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// On one line: `num_attempts=3 _skipIf=docked`, `:args (x -3 y -3 z 5)`, the
// expression of an Eval. Without the node's name and ID; "" where there is no
// more, or the run does not have the text.
std::string written_at(const RecordedRun& run, std::size_t node);

}  // namespace btcheck
