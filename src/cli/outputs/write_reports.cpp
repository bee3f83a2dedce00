// SPDX-License-Identifier: MIT
//
// Files are written as a whole or not at all. Lines on standard output have
// begun before the check has: there the rest follows.
#include "cli/outputs/write_reports.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <utility>

#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "report/formats/formats.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// In a format for programs.
std::string formatted(const ReportTarget& target, const Report& report) {
  switch (target.format) {
    case ReportFormat::Text:
      break;
    case ReportFormat::Json:
      return json_text(report);
    case ReportFormat::JsonLines:
      return target.file.empty() ? json_result_lines(report)
                                 : json_lines(report);
    case ReportFormat::Sarif:
      return sarif_text(report);
    case ReportFormat::JUnit:
      return junit_text(report);
    case ReportFormat::GitHub:
      return harmless(github_text(report));
    case ReportFormat::GitLab:
      return gitlab_text(report);
  }
  return {};
}

bool all_text(const std::vector<ReportTarget>& targets) {
  return std::all_of(targets.begin(), targets.end(), [](const auto& target) {
    return target.format == ReportFormat::Text;
  });
}

// The folder of a file that is to be written.
std::filesystem::path folder_of(const std::string& file) {
  const std::filesystem::path folder =
      std::filesystem::path(file).parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

}  // namespace

Layout layout_of(const Options& options) {
  const bool is_kept =
      std::ranges::any_of(options.reports, [](const ReportTarget& target) {
        return target.format == ReportFormat::Text && !target.file.empty();
      });
  return {options.is_verbose ? Detail::EveryStep : Detail::Events,
          is_kept ? kLineWidth : terminal_width()};
}

std::string text_report(const CheckResult& result, Layout layout) {
  std::string text;
  for (const CheckedFile& file : result.files) {
    text += heading_text(result, file);
    text += file.defaults ? defaults_text(result, file, layout)
                          : verdicts_text(result, file, layout) +
                                beside_rules_text(result, file, layout);
  }
  return text;
}

Report new_report(double seconds) {
  Report report;
  std::error_code fault;
  report.directory = std::filesystem::current_path(fault).string();
  report.root = report.directory;
  // A job may run in a folder of the repository; GitHub and GitLab count from
  // its root.
  for (const char* name : {"GITHUB_WORKSPACE", "CI_PROJECT_DIR"}) {
    const char* root = std::getenv(name);
    if (root != nullptr && *root == '/') report.root = root;
  }
  const auto begin = std::time(nullptr) - static_cast<std::time_t>(seconds);
  report.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(begin));
  return report;
}

std::string obstacle_to(const std::string& file) {
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault)) {
    return fmt::format("cannot write `{}`: it is a directory", file);
  }
  const std::filesystem::path folder = folder_of(file);
  if (std::filesystem::is_directory(folder, fault)) return {};
  return fmt::format("cannot write `{}`: there is no directory `{}`", file,
                     folder.string());
}

std::string obstacle_to(const Options& options) {
  std::vector<std::string> files = {options.new_baseline};
  for (const ReportTarget& target : options.reports) {
    files.push_back(target.file);
  }
  for (const std::string& file : files) {
    std::string obstacle = file.empty() ? "" : obstacle_to(file);
    if (!obstacle.empty()) return obstacle;
  }
  return {};
}

std::string write_report(const Options& options,
                         const std::vector<ReportTarget>& targets,
                         const Report& report, const std::string& text) {
  std::string complaint;
  for (const ReportTarget& target : targets) {
    const std::string told =
        target.format == ReportFormat::Text ? text : formatted(target, report);
    if (target.file.empty()) {
      const bool is_text = target.format == ReportFormat::Text;
      print_exactly(is_text ? painted(options, told, STDOUT_FILENO) : told);
    } else if (complaint.empty()) {
      complaint = write_file(target.file, told);
    }
    if (target.format == ReportFormat::GitHub && complaint.empty()) {
      complaint = add_job_summary(report);
    }
  }
  return complaint;
}

std::string write_reports(const Options& options, const CheckResult& result,
                          Layout layout, const CheckCost& cost) {
  const std::vector<ReportTarget>& targets = options.reports;
  Report report;
  if (!all_text(targets)) {
    report = new_report(cost.seconds);
    ReportedTree tree = reported(result, cost.tree, cost.code);
    tree.seconds = cost.seconds;
    tree.peak_bytes = cost.peak_bytes;
    report.trees.push_back(std::move(tree));
  }
  const bool has_text = std::any_of(
      targets.begin(), targets.end(),
      [](const auto& target) { return target.format == ReportFormat::Text; });
  return write_report(options, targets, report,
                      has_text ? harmless(text_report(result, layout)) : "");
}

void print_start(const std::vector<ReportTarget>& targets,
                 const std::string& tree,
                 const std::vector<std::string>& properties) {
  if (!prints_lines(targets)) return;
  print_exactly(json_start_line(tree, properties));
  flush_output();
}

void print_progress(const SearchProgress& progress, double seconds) {
  print_exactly(json_progress_line(progress, seconds));
  flush_output();
}

bool prints_lines(const std::vector<ReportTarget>& targets) {
  return std::any_of(targets.begin(), targets.end(), [](const auto& target) {
    return target.format == ReportFormat::JsonLines && target.file.empty();
  });
}

}  // namespace btcheck
