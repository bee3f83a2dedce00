// SPDX-License-Identifier: MIT
//
// `btcheck answer FOLDER|TREE…`: asks what the findings want to know, and keeps
// the answers for the whole project.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

// Questions are printed, a line is read for each from standard input. An answer
// is written at once; at the end of the input the rest is left open.
ExitCode run_answer(const Options& options);

}  // namespace btcheck
