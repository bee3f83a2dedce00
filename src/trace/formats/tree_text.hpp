// SPDX-License-Identifier: MIT
//
// A tree with what its nodes are doing, for a terminal.
#pragma once

#include <cstddef>
#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// Whether a subtree that has not been ticked yet is one line.
enum class Folding : unsigned char { None, Unvisited };

// A line for each node at one state of a run, ending in newlines. What a node
// did in an earlier tick stands in parentheses:
//
//     inspect                     running
//       Sequence3                 running
//         look                    (success)
//         ReactiveFallback7 and 4 below it
std::string tree_text(const RecordedRun& run, std::size_t state,
                      Folding folding);

}  // namespace btcheck
