// SPDX-License-Identifier: MIT
//
// `btcheck batch DIR|MANIFEST…`.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

ExitCode run_batch(const Options& options);

}  // namespace btcheck
