// SPDX-License-Identifier: MIT
//
// `btcheck trace LOG --view`.
#pragma once

#include "cli/inputs/files.hpp"
#include "cli/options/options.hpp"

namespace btcheck {

// Shows a log while it is written, until it is interrupted.
ExitCode view_log(const Options& options, const InputFile& file);

}  // namespace btcheck
