// SPDX-License-Identifier: MIT
//
// `btcheck --watch PATH…`: checks, waits until a file is saved, and checks
// again. Each round is a batch of which nothing is searched again that is known
// by its content.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

// Until an interrupt; the code is that of the last results of all entries.
ExitCode run_watch(const Options& options);

}  // namespace btcheck
