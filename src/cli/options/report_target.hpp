// SPDX-License-Identifier: MIT
//
// Which formats results are told in, and where each goes.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace btcheck {

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

// What `--format WORD` and `--format WORD=FILE` ask for. Text goes to standard
// output unless another format does.
struct TargetComplaint {
  std::string message;
  std::string help;
};
std::variant<std::vector<ReportTarget>, TargetComplaint> report_targets(
    const std::vector<std::string>& words);

}  // namespace btcheck
