// SPDX-License-Identifier: MIT
#include "api/told.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace btcheck::v1 {
namespace {

Level level_of(Severity severity) {
  if (severity == Severity::Error) return Level::Error;
  return severity == Severity::Warning ? Level::Warning : Level::Note;
}

Verdict verdict_of(btcheck::Verdict verdict) {
  if (verdict == btcheck::Verdict::Holds) return Verdict::Holds;
  return verdict == btcheck::Verdict::Violated ? Verdict::Violated
                                               : Verdict::Undecided;
}

std::vector<Change> changes_of(const std::optional<CheckedRepair>& repair) {
  std::vector<Change> changes;
  if (!repair) return changes;
  for (const ChangedFile& file : repair->files) {
    for (const ChangedLines& lines : file.changes) {
      changes.push_back({file.file, static_cast<std::size_t>(lines.first),
                         lines.before.size(), lines.after});
    }
  }
  return changes;
}

std::optional<Run> run_where_told(const std::optional<ToldRun>& told,
                                  const std::string& name) {
  if (!told) return std::nullopt;
  Run run = run_of(*told);
  run.name = name;
  return run;
}

}  // namespace

Position position_of(const Place& place) {
  const auto number = [](auto value) {
    return static_cast<std::size_t>(value);
  };
  return {place.file, number(place.span.line), number(place.span.column),
          number(place.span.length)};
}

Run run_of(const ToldRun& told) {
  Run run;
  for (const ToldStep& step : told.steps) {
    run.steps.push_back(
        {step.text, step.time, step.is_chosen, position_of(step.place)});
  }
  run.loop = told.loop;
  return run;
}

Finding finding_of(const btcheck::Finding& of) {
  constexpr std::string_view kHelp = "\nHelp: ";
  Finding finding;
  finding.code = of.code;
  finding.level = level_of(of.severity);
  const std::size_t help = of.message.find(kHelp);
  finding.message = of.message.substr(0, help);
  if (help != std::string::npos) {
    finding.help = of.message.substr(help + kHelp.size());
  }
  finding.where = position_of(of.place);
  finding.node = of.node;
  finding.run = run_where_told(
      of.run, of.about == btcheck::Finding::About::Rule ? of.title : of.trace);
  finding.repair = changes_of(of.repair);
  return finding;
}

Rule rule_of(const ReportedProperty& of) {
  Rule rule;
  rule.name = of.name;
  rule.text = of.text;
  rule.where = position_of(of.place);
  rule.verdict = verdict_of(of.verdict);
  rule.is_met = of.is_met;
  rule.is_vacuous = of.is_vacuous;
  rule.note = of.note;
  rule.reason = of.reason;
  rule.run = run_where_told(of.run, of.name);
  return rule;
}

Node node_of(const ReportedNode& of) {
  Node node{of.key, of.type, position_of(of.place), {}, {}, {}, {}, {}, {}};
  const auto answer = [&](NodeQuestion question) {
    const auto& given = of.answers[static_cast<std::size_t>(question)];
    return given ? std::optional(verdict_of(given->verdict)) : std::nullopt;
  };
  node.is_ticked = answer(NodeQuestion::Ticked);
  node.succeeds = answer(NodeQuestion::Success);
  node.fails = answer(NodeQuestion::Failure);
  node.runs = answer(NodeQuestion::Running);
  node.is_halted = answer(NodeQuestion::Halted);
  node.is_skipped = answer(NodeQuestion::Skipped);
  return node;
}

Answer answer_of(const ReportedAnswer& of) {
  return {of.key,      of.question,
          of.answer,   verdict_of(of.verdict),
          of.is_fault, run_where_told(of.run, of.key)};
}

bool is_of_rule(const Finding& finding) {
  return finding.code == rule::kViolated || finding.code == rule::kHolds ||
         finding.code == rule::kUndecided;
}

std::string_view verdict_word(Verdict verdict) {
  constexpr std::array<std::string_view, 3> kWords = {"HOLDS", "VIOLATED",
                                                      "UNDECIDED"};
  return kWords[static_cast<std::size_t>(verdict)];
}

}  // namespace btcheck::v1
