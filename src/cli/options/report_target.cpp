// SPDX-License-Identifier: MIT
//
// Standard output belongs to one format, and so does each file.
#include "cli/options/report_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace btcheck {
namespace {

struct FormatWord {
  std::string_view word;
  ReportFormat format;
};
constexpr std::array<FormatWord, 6> kFormats = {
    {{"text", ReportFormat::Text},
     {"json", ReportFormat::Json},
     {"jsonl", ReportFormat::JsonLines},
     {"sarif", ReportFormat::Sarif},
     {"junit", ReportFormat::JUnit},
     {"github", ReportFormat::GitHub}}};

std::optional<ReportTarget> target_of(const std::string& word) {
  const std::size_t sign = word.find('=');
  const std::string_view name = std::string_view(word).substr(0, sign);
  for (const FormatWord& known : kFormats) {
    if (known.word != name) continue;
    if (sign == word.npos) return ReportTarget{known.format, {}};
    if (sign + 1 == word.size()) return std::nullopt;
    return ReportTarget{known.format, word.substr(sign + 1)};
  }
  return std::nullopt;
}

}  // namespace

std::variant<std::vector<ReportTarget>, TargetComplaint> report_targets(
    const std::vector<std::string>& words) {
  std::vector<ReportTarget> targets;
  for (const std::string& word : words) {
    const auto target = target_of(word);
    if (!target) {
      return TargetComplaint{
          fmt::format("--format {}: no such format", word),
          "write text, json, jsonl, sarif, junit or github, or FORMAT=FILE"};
    }
    const bool is_taken = std::any_of(
        targets.begin(), targets.end(),
        [&](const auto& other) { return other.file == target->file; });
    if (is_taken) {
      return TargetComplaint{
          target->file.empty()
              ? "two formats on standard output"
              : fmt::format("two formats in the file `{}`", target->file),
          fmt::format("give one of them a file: --format {}=FILE",
                      word.substr(0, word.find('=')))};
    }
    targets.push_back(*target);
  }
  const bool has_output =
      std::any_of(targets.begin(), targets.end(),
                  [](const auto& target) { return target.file.empty(); });
  if (!has_output) targets.insert(targets.begin(), ReportTarget{});
  return targets;
}

}  // namespace btcheck
