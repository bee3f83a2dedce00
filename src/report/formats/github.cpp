// SPDX-License-Identifier: MIT
//
// An annotation is one line, `::error file=…,line=…::text`, errors first; at
// the end comes a line for the log, which is no command. The page of the job
// begins with what is wrong; all the rest is folded away.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "report/formats/escapes.hpp"
#include "report/formats/formats.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

std::string_view command_of(Severity severity) {
  return severity == Severity::Note ? "notice" : severity_name(severity);
}

// The events of a run, the last ones of a long one.
std::string run_lines(const ToldRun& run) {
  constexpr std::size_t kMostSteps = 20;
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

std::string row(const ReportedTree& tree) {
  const PropertyCounts counts = properties_of(tree);
  return fmt::format("| {} | {} | {} | {} | {} | {} | {:.2f} s |\n",
                     word_of(outcome_of(tree)), markdown_text(title_of(tree)),
                     counts.holds, counts.violated, counts.undecided,
                     grouped(states_of(tree)), tree.seconds);
}

std::string shortfall_rows(const ReportedTree& tree, std::size_t& left) {
  std::string text;
  for (const Shortfall& found : shortfalls_of(tree)) {
    if (left == 0) return text;
    --left;
    std::string what = markdown_text(found.name);
    if (!found.text.empty()) {
      what += fmt::format("{}{}", what.empty() ? "" : ": ",
                          markdown_text(found.text));
    }
    if (!found.title.empty()) what += "<br>" + markdown_text(found.title);
    text += fmt::format("| {} | {} | {} |\n", markdown_text(title_of(tree)),
                        markdown_text(found.word), what);
  }
  return text;
}

// GitHub allows one mebibyte for the summary of a step.
constexpr std::size_t kMostRows = 200;

std::string shortfalls_table(const Report& report) {
  std::size_t left = kMostRows;
  std::string rows;
  for (const ReportedTree& tree : report.trees) {
    rows += shortfall_rows(tree, left);
  }
  if (rows.empty()) return {};
  return "| tree | | what |\n|---|---|---|\n" + rows +
         (left == 0 ? "\nOthers are left out here.\n\n" : "\n");
}

// What else was found: no error, and no limit, which has a row above.
std::string others_table(const Report& report) {
  std::string rows;
  std::vector<Finding> others;
  for (const ReportedTree& tree : report.trees) {
    for (Finding& finding : all_findings(tree)) {
      if (finding.severity == Severity::Error) continue;
      if (finding.code == rule::kUndecided) continue;
      const std::string_view words(finding.message);
      if (others.size() < kMostRows) {
        rows += fmt::format("| {} {} | {} | {} |\n",
                            severity_name(finding.severity), finding.code,
                            markdown_text(place_text(finding.place)),
                            markdown_text(words.substr(0, words.find('\n'))));
      }
      others.push_back(std::move(finding));
    }
  }
  if (rows.empty()) return {};
  return fmt::format(
      "<details><summary>{}</summary>\n\n| | where | what |\n|---|---|---|\n"
      "{}{}\n</details>\n\n",
      levels_text(others), rows,
      others.size() > kMostRows ? "\nOthers are left out here.\n" : "");
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
    const std::string_view word = command_of(severity);
    found.push_back(counted(count, word, fmt::format("{}s", word)));
    left_out += count - std::min(count, kMostAnnotations);
  }
  text += fmt::format("btcheck: {}", fmt::join(found, ", "));
  if (left_out > 0) text += fmt::format(" ({} not annotated)", left_out);
  return text + "\n";
}

std::string job_summary_text(const Report& report) {
  std::string text = fmt::format("### btcheck: {}\n\n", sum_of(report));
  text += shortfalls_table(report) + others_table(report);
  text += fmt::format(
      "<details><summary>every tree</summary>\n\n"
      "| result | tree | hold | violated | undecided | states | time |\n"
      "|---|---|--:|--:|--:|--:|--:|\n");
  for (const ReportedTree& tree : report.trees) text += row(tree);
  return text + "\n</details>\n\n";
}

}  // namespace btcheck
