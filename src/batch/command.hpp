// SPDX-License-Identifier: MIT
//
// `btcheck batch DIR|MANIFEST…`.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

ExitCode run_batch(const Options& options);

// The options of each of several entries checked at a time.
Options shared_out(Options options);

// Whether all that is asked for can be written: found out before anything is
// checked, not after. Complains when it cannot.
bool can_write(const Options& options);

}  // namespace btcheck
