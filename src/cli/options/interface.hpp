// SPDX-License-Identifier: MIT
//
// What scripts and other programs rely on: the version, the exit codes and the
// formats of reports.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace btcheck {

inline constexpr std::string_view kVersion = "0.1.0";

// `--help` and the man page tell what each means.
enum class ExitCode : std::uint8_t {
  Met = 0,        // every property met its expectation
  Missed = 1,     // some property missed its expectation
  BadInput = 2,   // usage, input or model error: nothing was checked
  Undecided = 3,  // a limit, timeout or interrupt, and nothing violated
  Internal = 4    // our mistake
};

// In the order of --format in option_table.cpp.
enum class ReportFormat : std::uint8_t {
  Text,
  Json,
  JsonLines,
  Sarif,
  JUnit,
  GitHub
};

struct ReportTarget {
  ReportFormat format = ReportFormat::Text;
  std::string file;  // "" for standard output
};

}  // namespace btcheck
