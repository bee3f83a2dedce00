// SPDX-License-Identifier: MIT
//
// The commands: what `main` calls and tests call again.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

// Runs the program: parses the command line, does what it says, prints, and
// returns the exit code. Never throws.
int run_program(int argc, const char* const* argv);

}  // namespace btcheck
