// SPDX-License-Identifier: MIT
//
// The program: `main` calls it, and it calls one function for each command.
// Verdicts go to stdout; diagnostics, progress and statistics to stderr. An
// error in any input ends a command before anything is searched.
#pragma once

#include "cli/options/options.hpp"

namespace btcheck {

// Runs the program: parses the command line, does what it says, prints, and
// returns the exit code. Never throws.
int run_program(int argc, const char* const* argv);

// Where the command has a file of its own.
ExitCode run_check(const Options& options);
ExitCode run_several(const Options& options);
ExitCode run_demo(const Options& options);
// Met when nothing is found, Missed after a warning, BadInput after an error.
// Errors are shown on stderr, findings on stdout.
ExitCode run_lint(const Options& options);
ExitCode run_trace(const Options& options);
ExitCode run_simulate(const Options& options);
ExitCode run_run(const Options& options);
ExitCode run_init(const Options& options);
ExitCode run_conform(const Options& options);
ExitCode run_explain(const Options& options);
ExitCode run_monitor(const Options& options);
ExitCode run_fmt(const Options& options);
ExitCode run_whatif(const Options& options);
ExitCode run_tests(const Options& options);
ExitCode run_diff(const Options& options);

}  // namespace btcheck
