// SPDX-License-Identifier: MIT
//
// `btcheck TREE`, and `btcheck demo`.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

ExitCode run_check(const Options& options);
ExitCode run_demo(const Options& options);

}  // namespace btcheck
