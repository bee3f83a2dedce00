// SPDX-License-Identifier: MIT
//
// One line for each annotation, `::error file=…,line=…::text`, errors first,
// and at the end a line for the log, which is no command.
#include "report/formats/github_annotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "report/formats/escapes.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostSteps = 20;

std::string_view command_of(Severity severity) {
  switch (severity) {
    case Severity::Error:
      return "error";
    case Severity::Warning:
      return "warning";
    case Severity::Note:
      return "notice";
  }
  return "notice";
}

// The events of a run, the last ones of a long one.
std::string run_lines(const ToldRun& run) {
  const std::size_t first =
      run.steps.size() - std::min(run.steps.size(), kMostSteps);
  std::string text;
  if (first > 0) text += fmt::format("\n({} steps before)", first);
  for (std::size_t i = first; i < run.steps.size(); ++i) {
    const ToldStep& step = run.steps[i];
    const bool is_event = step.kind == ToldStep::Kind::Event;
    text += fmt::format("\n{}{}{}", is_event ? "  " : "-- ", step.text,
                        step.is_chosen ? " (chosen)" : "");
  }
  return text;
}

std::string annotation(const Report& report, const Finding& finding) {
  const SourceSpan& span = finding.place.span;
  std::string line =
      fmt::format("::{} file={}", command_of(finding.severity),
                  github_property(path_from(report.root, report.directory,
                                            finding.place.file)));
  if (span.line > 0) {
    line += fmt::format(",line={0},endLine={0},col={1},endColumn={2}",
                        span.line, span.column, span.column + span.length);
  }
  std::string message = finding.message;
  if (finding.run) message += run_lines(*finding.run);
  return line + fmt::format(",title={}::{}\n",
                            github_property(fmt::format(
                                "{} [{}]", finding.title, finding.code)),
                            github_message(message));
}

std::string counted(std::size_t count, std::string_view word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

}  // namespace

std::string github_text(const Report& report) {
  std::string text;
  std::vector<std::string> found;
  std::size_t left_out = 0;
  for (const Severity severity :
       {Severity::Error, Severity::Warning, Severity::Note}) {
    std::size_t count = 0;
    for (const ReportedTree& tree : report.trees) {
      for (const Finding& finding : all_findings(tree)) {
        if (finding.severity != severity) continue;
        if (count++ < kMostAnnotations) text += annotation(report, finding);
      }
    }
    found.push_back(counted(count, command_of(severity)));
    left_out += count - std::min(count, kMostAnnotations);
  }
  text += fmt::format("btcheck: {}", fmt::join(found, ", "));
  if (left_out > 0) text += fmt::format(" ({} not annotated)", left_out);
  return text + "\n";
}

}  // namespace btcheck
