// SPDX-License-Identifier: MIT
//
// Results are told here once; what a format makes of them is its own affair.
#include "report/formats/reported.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "model/tree/node_types.hpp"
#include "report/formats/escapes.hpp"
#include "report/formats/findings.hpp"
#include "report/text/default_findings.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

ReportedProperty reported_property(const CheckResult& result,
                                   const CheckedFile& file,
                                   const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  ReportedProperty reported;
  reported.name = property.name;
  reported.title = property.title;
  reported.text = property.text;
  reported.tags = property.tags;
  reported.place = {file.properties->file, property.span};
  reported.verdict = verdict.verdict;
  reported.expectation = property.expectation;
  reported.is_met = verdict.met_expectation();
  reported.is_vacuous = verdict.is_vacuous();
  reported.note = note_of(file, verdict);
  reported.error = verdict.error;
  reported.stopped = verdict.stopped;
  reported.progress = verdict.progress;
  reported.triggers = verdict.triggers;
  reported.longest_answer = verdict.longest_answer;
  if (!verdict.run || !verdict.error.empty()) return reported;
  const RunRemarks remarks = remarks_on(result, file, verdict);
  reported.reason = remarks.reason;
  reported.run = told_run(*result.tree, *file.network, *verdict.run, remarks);
  reported.told = told_text(result, file, verdict, Detail::Events);
  return reported;
}

constexpr std::array<std::string_view, kTreeQuestionCount> kAnswerKeys = {
    "can_succeed", "can_fail", "can_always_end",   "can_always_succeed",
    "never_stuck", "in_range", "no_zero_time_loop"};

ReportedAnswer reported_answer(const CheckResult& result,
                               const CheckedFile& file,
                               const TreeReport& answer) {
  ReportedAnswer reported;
  reported.key = kAnswerKeys[static_cast<std::size_t>(answer.question)];
  reported.question = words_of(answer.question);
  reported.answer = answer_text(result, file, answer);
  reported.verdict = answer.verdict;
  reported.is_fault = is_fault(answer);
  if (answer.run) {
    reported.run =
        told_run(*result.tree, *file.network, answer.run->told(), {});
  }
  return reported;
}

ReportedNode reported_node(const BehaviorTree& tree, const Network& network,
                           const NodeReport& report) {
  const Node& node = tree.node(report.node);
  ReportedNode reported;
  reported.key = unique_name(tree, report.node);
  reported.name = node.name;
  reported.type = type_name(node.type);
  reported.place = place_of(tree, report.node);
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    const Possibility& answer = report.answers[q];
    if (!can_be_asked(network, report.node, q)) continue;
    reported.answers[q] = {answer.verdict, answer.ticks()};
  }
  return reported;
}

ReportedFile reported_file(const CheckResult& result, const CheckedFile& file) {
  ReportedFile reported;
  if (file.properties) reported.properties = file.properties->file;
  reported.profile = profile_name(file.network->profile);
  reported.ticks = tick_name(file.network->ticks);
  reported.assumptions = file.assumptions;
  reported.has_faults = file.has_faults;
  for (const PropertyVerdict& verdict : file.verdicts) {
    reported.verdicts.push_back(reported_property(result, file, verdict));
  }
  if (!file.defaults) return reported;
  for (const TreeReport& answer : file.defaults->tree) {
    reported.answers.push_back(reported_answer(result, file, answer));
  }
  for (const NodeReport& node : file.defaults->nodes) {
    reported.nodes.push_back(reported_node(*result.tree, *file.network, node));
  }
  reported.stopped = file.defaults->stopped;
  reported.progress = file.defaults->progress;
  reported.error = file.defaults->error;
  return reported;
}

}  // namespace

ExitCode Report::code() const {
  ExitCode worst = ExitCode::Met;
  for (const ReportedTree& tree : trees) worst = worst_of(worst, tree.code);
  return worst;
}

double Report::seconds() const {
  double sum = 0;
  for (const ReportedTree& tree : trees) sum += tree.seconds;
  return sum;
}

const std::string& title_of(const ReportedTree& tree) {
  return tree.entry.empty() ? tree.file : tree.entry;
}

std::uint64_t states_of(const ReportedTree& tree) {
  std::uint64_t states = 0;
  for (const ReportedFile& file : tree.files) {
    states = std::max(states, file.progress.states);
    for (const ReportedProperty& property : file.verdicts) {
      states = std::max(states, property.progress.states);
    }
  }
  return states;
}

ReportedTree reported(const CheckResult& result, const std::string& file,
                      ExitCode code) {
  ReportedTree tree;
  tree.file = file;
  tree.root.file = file;
  tree.diagnostics = result.diagnostics;
  tree.code = code;
  if (!result.tree) return tree;
  tree.nodes = result.tree->nodes.size();
  tree.variables = result.tree->variables.size();
  tree.root = place_of(*result.tree, result.tree->roots[0]);
  for (const CheckedFile& checked : result.files) {
    tree.files.push_back(reported_file(result, checked));
    auto found = findings_of(result, checked, tree.files.back());
    tree.findings.insert(tree.findings.end(),
                         std::make_move_iterator(found.begin()),
                         std::make_move_iterator(found.end()));
  }
  return tree;
}

std::string fingerprint_of(const Report& report, const Finding& finding) {
  return fingerprint(
      path_from(report.root, report.directory, finding.place.file) + '\n' +
      finding.identity);
}

std::vector<Finding> all_findings(const ReportedTree& tree) {
  std::vector<Finding> findings;
  for (const Diagnostic& diagnostic : tree.diagnostics) {
    findings.push_back(finding_of(diagnostic));
    // What names no file is about the tree as a whole.
    if (diagnostic.file.empty()) findings.back().place.file = tree.file;
  }
  findings.insert(findings.end(), tree.findings.begin(), tree.findings.end());
  return findings;
}

}  // namespace btcheck
