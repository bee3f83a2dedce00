// SPDX-License-Identifier: MIT
//
// `btcheck leaves FOLDER|TREE…`: a file to fill in, for the leaves of which
// nothing is known.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

// Met where all trees are read; what can be read is told in any case.
ExitCode run_leaves(const Options& options);

}  // namespace btcheck
