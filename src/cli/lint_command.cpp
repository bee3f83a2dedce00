// SPDX-License-Identifier: MIT
//
// Each tree is read with all the rules that are named; a tree that cannot be
// read does not keep the others from being looked at.
#include "cli/lint_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "cli/inputs/complaints.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/outputs/write_reports.hpp"
#include "report/formats/reported.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

ExitCode code_for(const std::vector<Diagnostic>& diagnostics) {
  if (has_error(diagnostics)) return ExitCode::BadInput;
  const bool has_warning = std::any_of(
      diagnostics.begin(), diagnostics.end(),
      [](const auto& found) { return found.severity == Severity::Warning; });
  return has_warning ? ExitCode::Missed : ExitCode::Met;
}

ReportedTree linted(const Options& options, const std::string& input) {
  Options one = options;
  one.input = input;
  CheckResult result;
  std::string file = input;
  std::vector<Diagnostic> unreadable;
  if (const auto inputs = read_inputs(one, unreadable)) {
    result = lint_inputs(inputs->tree, inputs->properties);
    file = inputs->tree.name;
    std::vector<Diagnostic> errors;
    std::copy_if(result.diagnostics.begin(), result.diagnostics.end(),
                 std::back_inserter(errors), [](const auto& found) {
                   return found.severity == Severity::Error;
                 });
    show(options, errors);
  } else {
    result.diagnostics = std::move(unreadable);
  }
  return reported(result, file, code_for(result.diagnostics));
}

// What was found without the errors, which have been shown; and how much.
std::string findings_text(const Options& options,
                          const std::vector<ReportedTree>& trees) {
  std::string text;
  std::size_t count = 0;
  for (const ReportedTree& tree : trees) {
    std::vector<Diagnostic> findings;
    for (const Diagnostic& found : tree.diagnostics) {
      if (found.severity != Severity::Error) findings.push_back(found);
    }
    count += findings.size();
    text += shown(options, findings, STDOUT_FILENO);
  }
  if (options.is_quiet) return text;
  return text + fmt::format("{} tree{}, {} finding{}\n", trees.size(),
                            trees.size() == 1 ? "" : "s", count,
                            count == 1 ? "" : "s");
}

}  // namespace

ExitCode run_lint(const Options& options) {
  const std::string obstacle = obstacle_to(options.reports);
  if (!obstacle.empty()) {
    complain("BT0004", obstacle);
    return ExitCode::BadInput;
  }
  std::vector<ReportedTree> trees;
  ExitCode code = ExitCode::Met;
  for (const std::string& input : options.inputs) {
    trees.push_back(linted(options, input));
    code = worst_of(code, trees.back().code);
  }
  const std::string text = findings_text(options, trees);
  Report report = new_report(0);
  report.trees = std::move(trees);
  const std::string complaint = write_report(options.reports, report, text);
  if (complaint.empty()) return code;
  complain("BT0004", complaint);
  return worst_of(code, ExitCode::BadInput);
}

}  // namespace btcheck
