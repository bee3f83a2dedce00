// SPDX-License-Identifier: MIT
//
// What the commands that read logs and kept runs share.
#pragma once

#include "check/check.hpp"
#include "cli/options/options.hpp"

namespace btcheck {

// Asks the rules of --prop of a log or an ITF file: Missed where one is broken
// and was not expected to be.
ExitCode watch_recorded(const Options& options, const InputFile& file);

}  // namespace btcheck
