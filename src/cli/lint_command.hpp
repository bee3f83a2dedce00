// SPDX-License-Identifier: MIT
//
// `btcheck lint`: what is wrong with trees and rules as they stand.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

// Met when nothing is found, Missed after a warning, BadInput after an error.
// Errors are shown on stderr, what is found on stdout.
ExitCode run_lint(const Options& options);

}  // namespace btcheck
