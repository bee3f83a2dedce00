// SPDX-License-Identifier: MIT
//
// `btcheck space TREE`.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

ExitCode run_space(const Options& options);

}  // namespace btcheck
