// SPDX-License-Identifier: MIT
//
// Results as the text a person reads.
#pragma once

#include <string>

#include "check/check.hpp"
#include "cli/options.hpp"
#include "trace/text.hpp"

namespace btcheck {

// What was checked, and how: one line.
std::string heading_text(const CheckResult& result, const CheckedFile& file);

// A verdict for each property, with the runs that have to be seen: those of
// verdicts that nobody expected, and all of them where every step is told. A
// line of sums at the end.
std::string verdicts_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail);

// The default report: the mission as a whole, the table of its nodes, and what
// is worth a look.
std::string defaults_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail);

// What ended a search early, and what may help.
std::string stop_text(StopReason reason, const SearchProgress& progress);

// The exit code that one file's results ask for.
ExitCode exit_code_of(const CheckedFile& file);
// The one that counts: 4 before 2, 1, 3, 0.
ExitCode worst_of(ExitCode one, ExitCode other);

// "328,443".
std::string grouped(std::uint64_t number);

}  // namespace btcheck
