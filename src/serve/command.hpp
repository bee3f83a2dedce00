// SPDX-License-Identifier: MIT
//
// `btcheck serve --stdio` and `btcheck mcp`: a process that stays.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

// Met where the other side has ended it; BadInput where what it sent could not
// be understood.
ExitCode run_serve(const Options& options);
ExitCode run_mcp(const Options& options);

}  // namespace btcheck
