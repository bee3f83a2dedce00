// SPDX-License-Identifier: MIT
//
// What a command leaves of a baseline.
#pragma once

#include <vector>

#include "check/findings/judgement.hpp"
#include "cli/options/options.hpp"

namespace btcheck {

// Says how many findings of --baseline occur no more, and writes the file of
// --write-baseline: what the trees have now, and what the old one has of files
// that were not looked at. Complains where it cannot be written.
ExitCode keep_baseline(const Options& options,
                       const std::vector<const Judged*>& trees);

}  // namespace btcheck
