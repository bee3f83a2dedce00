// SPDX-License-Identifier: MIT
//
// A result points at the node in the tree's file; the property is a related
// place. The fingerprint is made of names, so that a result stays the same when
// lines have moved.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "report/codes/codes.hpp"
#include "report/formats/escapes.hpp"
#include "report/formats/formats.hpp"
#include "text/json.hpp"
#include "text/version.hpp"

namespace btcheck {
namespace {

// What is done, and why it is right: the paper whose method this is.
constexpr std::string_view kInformation = "https://arxiv.org/abs/2502.11904";

Json message(std::string_view text) { return {{"text", sarif_message(text)}}; }

std::string sentence(std::string_view words) {
  std::string text(words);
  if (text[0] >= 'a' && text[0] <= 'z') text[0] ^= 0x20;
  return text + '.';
}

Json rule_json(const std::string& code, Severity severity) {
  const CodeRow* row = code_named(code);
  const std::string_view level = severity_name(severity);
  Json json = {
      {"id", code},
      {"shortDescription", message(sentence(diagnostic_summary(code)))},
      {"fullDescription", message(row == nullptr ? "" : row->description)},
      {"help", message(row == nullptr ? "" : row->help)},
      {"defaultConfiguration", {{"level", level}}},
      {"properties",
       {{"precision", "very-high"},
        {"problem.severity",
         severity == Severity::Note ? "recommendation" : level},
        {"tags", Json::array().push("behavior-tree")}}}};
  if (row != nullptr && !row->name.empty()) json.add("name", row->name);
  return json;
}

// By code: those of verdicts, and one for each other code that occurs.
using Rules = std::map<std::string, Json>;
Rules rules_for(const std::vector<Finding>& findings) {
  Rules rules;
  const auto add = [&](const std::string& code, Severity severity) {
    if (!rules.contains(code)) rules.emplace(code, rule_json(code, severity));
  };
  for (const CodeRow& row : verdict_codes()) {
    add(std::string(row.code), row.severity);
  }
  for (const Finding& finding : findings) add(finding.code, finding.severity);
  return rules;
}

class ResultWriter {
 public:
  ResultWriter(const Report& report, const Rules& rules)
      : report_(report),
        rules_(rules),
        has_baseline_(std::ranges::any_of(
            report.trees,
            [](const ReportedTree& tree) { return tree.judged.has_baseline; })),
        fingerprints_(report) {}

  Json result(const Finding& finding) {
    Json place = {{"physicalLocation", location(finding.place)}};
    if (!finding.node.empty()) {
      const Json node = {{"fullyQualifiedName", finding.node}};
      place.add("logicalLocations", Json::array().push(node));
    }
    Json result = {
        {"ruleId", finding.code},
        {"ruleIndex", std::distance(rules_.begin(), rules_.find(finding.code))},
        {"level", severity_name(finding.severity)},
        {"message", message(finding.message)},
        {"locations", Json::array().push(place)}};
    if (!finding.related.empty()) {
      result.add("relatedLocations", related(finding.related));
    }
    result.add("partialFingerprints",
               {{"primaryLocationLineHash", fingerprints_.next(finding)}});
    // What the baseline has is in no report.
    if (has_baseline_) result.add("baselineState", "new");
    if (finding.run && !finding.run->steps.empty()) {
      result.add("codeFlows", code_flows(*finding.run));
    }
    if (finding.repair) {
      result.add("fixes", Json::array().push(fix(*finding.repair)));
    }
    return result;
  }

 private:
  Json location(const Place& place) const {
    const SourceSpan& span = place.span;
    const int line = std::max(span.line, 1);
    const int column = std::max(span.column, 1);
    const int length = span.line > 0 ? std::max(span.length, 1) : 0;
    return {{"artifactLocation", {{"uri", uri(place.file)}}},
            {"region",
             {{"startLine", line},
              {"startColumn", column},
              {"endLine", line},
              {"endColumn", column + length}}}};
  }

  Json related(const std::vector<RelatedPlace>& places) const {
    Json array = Json::array();
    std::size_t id = 0;
    for (const RelatedPlace& place : places) {
      array.push({{"id", ++id},
                  {"physicalLocation", location(place.place)},
                  {"message", message(place.text)}});
    }
    return array;
  }

  std::string uri(const std::string& file) const {
    return uri_of(path_from(report_.root, report_.directory, file));
  }

  Json fix(const CheckedRepair& repair) const {
    Json files = Json::array();
    for (const ChangedFile& file : repair.files) {
      Json changes = Json::array();
      for (const ChangedLines& each : file.changes) {
        changes.push({{"deletedRegion",
                       {{"startLine", each.first},
                        {"startColumn", 1},
                        {"endLine", line_behind(each)},
                        {"endColumn", 1}}},
                      {"insertedContent", {{"text", text_put_in(each)}}}});
      }
      files.push({{"artifactLocation", {{"uri", uri(file.file)}}},
                  {"replacements", changes}});
    }
    return {{"description",
             message("Checked again: the finding is gone, no other appears, "
                     "and no rule that held breaks.")},
            {"artifactChanges", files}};
  }

  static std::string step_text(const ToldRun& run, const ToldStep& step) {
    if (step.kind == ToldStep::Kind::Time) return step.text;
    if (step.kind == ToldStep::Kind::Remark) return "-- " + step.text;
    const std::string when =
        step.time == 0 ? "start" : fmt::format("{} {}", run.unit, step.time);
    return fmt::format("{}: {}{}", when, step.text,
                       step.is_chosen ? " (chosen)" : "");
  }

  Json flow_step(const ToldRun& run, const ToldStep& step,
                 std::size_t number) const {
    const bool is_event = step.kind == ToldStep::Kind::Event;
    return {{"location",
             {{"physicalLocation", location(step.place)},
              {"message", message(step_text(run, step))}}},
            {"executionOrder", number},
            {"nestingLevel", is_event ? 1 : 0}};
  }

  // Of a long run the beginning and the end, which shows what is wrong.
  Json code_flows(const ToldRun& run) const {
    std::vector<ToldStep> steps = run.steps;
    if (steps.size() > kMostFlowSteps) {
      constexpr std::size_t kHead = kMostFlowSteps / 2;
      constexpr std::size_t kTail = kMostFlowSteps - kHead - 1;
      ToldStep gap = steps[kHead];
      gap.kind = ToldStep::Kind::Remark;
      gap.text = fmt::format("{} steps are left out here",
                             steps.size() - kHead - kTail);
      steps.erase(steps.begin() + kHead, steps.end() - kTail);
      steps.insert(steps.begin() + kHead, std::move(gap));
    }
    Json locations = Json::array();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      locations.push(flow_step(run, steps[i], i + 1));
    }
    const Json thread = {{"locations", locations}};
    return Json::array().push({{"threadFlows", Json::array().push(thread)}});
  }

  const Report& report_;
  const Rules& rules_;
  bool has_baseline_;
  Fingerprints fingerprints_;
};

// "btcheck/drone3/": two trees' results do not replace each other.
std::string automation_id(const Report& report) {
  if (report.trees.size() != 1) return "btcheck/";
  const std::string path =
      path_from(report.root, report.directory, report.trees[0].file);
  return fmt::format("btcheck/{}/", plain_text(without_ending(path)));
}

}  // namespace

std::string sarif_text(const Report& report) {
  std::vector<Finding> findings;
  for (const ReportedTree& tree : report.trees) {
    std::ranges::move(all_findings(tree), std::back_inserter(findings));
  }
  const Rules rules = rules_for(findings);
  Json descriptors = Json::array();
  for (const auto& [code, rule] : rules) descriptors.push(rule);
  ResultWriter writer(report, rules);
  Json results = Json::array();
  for (const Finding& finding : findings) {
    results.push(writer.result(finding));
  }
  const ExitCode code = report.code();
  const bool is_done = code != ExitCode::BadInput && code != ExitCode::Internal;
  const Json invocation = {{"executionSuccessful", is_done},
                           {"exitCode", static_cast<int>(code)}};
  const Json run = {{"tool",
                     {{"driver",
                       {{"name", "btcheck"},
                        {"version", kVersion},
                        {"semanticVersion", kVersion},
                        {"informationUri", kInformation},
                        {"rules", descriptors}}}}},
                    {"automationDetails", {{"id", automation_id(report)}}},
                    {"invocations", Json::array().push(invocation)},
                    {"columnKind", "unicodeCodePoints"},
                    {"results", results}};
  const Json document = {
      {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
      {"version", "2.1.0"},
      {"runs", Json::array().push(run)}};
  return document.indented(1) + "\n";
}

}  // namespace btcheck
