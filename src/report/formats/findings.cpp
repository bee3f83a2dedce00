// SPDX-License-Identifier: MIT
//
// The place of a finding is the node in the tree's file that has to do with it,
// since that file is what people change; a property that says nothing about
// nodes stands for itself.
#include "report/formats/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "model/tree/node_types.hpp"
#include "report/formats/rules.hpp"
#include "report/text/default_findings.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostRelated = 20;

// A name that the reader gave the node after its line.
bool is_made_up(const Node& node) {
  return node.name == fmt::format("{}{}", type_name(node.type), node.span.line);
}

std::string stable_name(const Node& node) {
  return is_made_up(node) ? std::string(type_name(node.type)) : node.name;
}

// "land", or "land#2" for the second child of this name.
std::string part_of_path(const BehaviorTree& tree, NodeId id) {
  const Node& node = tree.node(id);
  std::string name = stable_name(node);
  if (node.is_root()) return name;
  std::size_t same = 1;
  for (const NodeId sibling : tree.node(node.parent).children) {
    if (sibling == id) break;
    same += stable_name(tree.node(sibling)) == name;
  }
  return same == 1 ? name : fmt::format("{}#{}", name, same);
}

std::string sentence(std::string text) {
  if (!text.empty() && !text.ends_with('.')) text += '.';
  return text;
}

// Collects the findings of one file.
class Findings {
 public:
  Findings(const CheckResult& result, const CheckedFile& file)
      : tree_(*result.tree), file_(file) {}

  void add_verdict(const PropertyVerdict& verdict,
                   const ReportedProperty& reported);
  void add_answer(const TreeReport& report, const ReportedAnswer& reported);
  void add_default(const DefaultFinding& found);
  void add_faults();
  void add_stop(const ReportedFile& reported);
  void add_error(const std::string& error);

  std::vector<Finding> take() { return std::move(findings_); }

 private:
  Finding& add(std::string_view code, std::string message) {
    Finding finding;
    finding.code = code;
    if (const Rule* rule = rule_of(code)) finding.severity = rule->severity;
    finding.message = std::move(message);
    findings_.push_back(std::move(finding));
    return findings_.back();
  }

  void put_at(Finding& finding, const Culprit& culprit) const {
    if (culprit.node) {
      finding.place = place_of(tree_, *culprit.node);
      finding.node = stable_path(tree_, *culprit.node);
    } else {
      const StateVariable& variable = tree_.variable(*culprit.variable);
      finding.place = {tree_.file, variable.span};
      finding.node = "variable " + variable.name;
    }
  }

  void identify(Finding& finding, std::string_view subject) const {
    finding.identity =
        fmt::format("{}\n{}\n{}", finding.code, subject, finding.node);
  }

  void relate(Finding& finding, NodeId node) const {
    const Place place = place_of(tree_, node);
    const bool is_there = finding.place.file == place.file &&
                          finding.place.span.line == place.span.line &&
                          finding.place.span.column == place.span.column;
    if (is_there || finding.related.size() >= kMostRelated) return;
    finding.related.push_back(
        {place, fmt::format("{} is here", short_name(tree_, node))});
  }

  // Where something is said of the property and no run shows it.
  Place place_of_subject(const PropertyVerdict& verdict,
                         const ReportedProperty& reported,
                         std::string& node) const {
    if (verdict.subjects.nodes.empty()) return reported.place;
    node = stable_path(tree_, verdict.subjects.nodes[0]);
    return place_of(tree_, verdict.subjects.nodes[0]);
  }

  void place_verdict(Finding& finding, const PropertyVerdict& verdict,
                     const ReportedProperty& reported) const;

  const BehaviorTree& tree_;
  const CheckedFile& file_;
  std::vector<Finding> findings_;
};

// "p is violated (after 2 ticks): Its title."
std::string first_line(std::string_view what, const ReportedProperty& of) {
  const std::string& title = of.title.empty() ? of.text : of.title;
  return sentence(fmt::format("{} {}{}: {}", of.name, what,
                              of.note.empty() ? "" : " (" + of.note + ")",
                              title));
}

std::string message_of(std::string_view what, const ReportedProperty& of) {
  std::string message = first_line(what, of);
  if (!of.title.empty()) message += "\n" + of.text;
  if (!of.reason.empty()) message += "\nWhy: " + of.reason;
  return message;
}

// The run up to the state that shows it, where there is one.
Run shown_part(const PropertyVerdict& verdict) {
  Run run = *verdict.run;
  if (!verdict.shown_at) return run;
  run.steps.resize(*verdict.shown_at);
  run.loop = kNoLoop;
  return run;
}

void Findings::place_verdict(Finding& finding, const PropertyVerdict& verdict,
                             const ReportedProperty& reported) const {
  const bool is_violated = verdict.verdict == Verdict::Violated;
  if (is_violated && verdict.run) {
    put_at(finding, culprit_of(tree_, *file_.network, shown_part(verdict),
                               verdict.subjects.nodes));
    finding.run = reported.run;
  } else if (is_violated) {
    finding.place = place_of_subject(verdict, reported, finding.node);
  } else {
    finding.place = reported.place;
  }
  if (finding.place.file != reported.place.file) {
    finding.related.push_back(
        {reported.place, fmt::format("property {}", reported.name)});
  }
  for (const NodeId node : verdict.subjects.nodes) relate(finding, node);
}

void Findings::add_verdict(const PropertyVerdict& verdict,
                           const ReportedProperty& reported) {
  std::string_view code;
  std::string_view what;
  if (!verdict.error.empty()) {
    code = rule::kInternal;
    what = "could not be decided";
  } else if (verdict.verdict == Verdict::Undecided) {
    code = rule::kUndecided;
    what = "is undecided";
  } else if (!verdict.met_expectation()) {
    const bool holds = verdict.verdict == Verdict::Holds;
    code = holds ? rule::kHolds : rule::kViolated;
    what = holds ? "holds" : "is violated";
  } else if (verdict.is_vacuous()) {
    code = rule::kVacuous;
    what = "holds";
  } else {
    return;
  }
  Finding& finding = add(code, message_of(what, reported));
  if (!verdict.error.empty()) finding.message += "\n" + verdict.error;
  finding.title = reported.name;
  place_verdict(finding, verdict, reported);
  identify(finding, reported.name);
}

void Findings::add_answer(const TreeReport& report,
                          const ReportedAnswer& reported) {
  if (report.verdict != Verdict::Violated) return;
  std::string_view code;
  switch (report.question) {
    case TreeQuestion::CanSucceed:
      code = rule::kCannotSucceed;
      break;
    case TreeQuestion::CanAlwaysEnd:
      code = rule::kCannotEnd;
      break;
    case TreeQuestion::NeverStuck:
      code = rule::kStuck;
      break;
    case TreeQuestion::InRange:
      code = rule::kFault;
      break;
    case TreeQuestion::NoZeroTimeLoop:
      code = rule::kZeroTimeLoop;
      break;
    case TreeQuestion::CanFail:
    case TreeQuestion::CanAlwaysSucceed:
      return;
  }
  Finding& finding = add(code, std::string(rule_of(code)->summary));
  finding.title = reported.question;
  Culprit culprit{tree_.roots[0], std::nullopt};
  if (report.run) {
    culprit = culprit_of(tree_, *file_.network, report.run->told(), {});
  }
  put_at(finding, culprit);
  finding.run = reported.run;
  identify(finding, reported.key);
}

std::string_view code_of(FindingKind kind) {
  switch (kind) {
    case FindingKind::NeverTicked:
      return rule::kNeverTicked;
    case FindingKind::NeverSucceeds:
      return rule::kNeverSucceeds;
    case FindingKind::AlwaysTrue:
      return rule::kAlwaysTrue;
    case FindingKind::NeverTrue:
      return rule::kNeverTrue;
    case FindingKind::StaleGuards:
      return rule::kStaleGuards;
    case FindingKind::LeftRunning:
      return rule::kLeftRunning;
  }
  return "";
}

void Findings::add_default(const DefaultFinding& found) {
  const std::string_view code = code_of(found.kind);
  Finding& finding = add(code, sentence(found.text));
  finding.title = sentence(std::string(rule_of(code)->summary));
  finding.title.pop_back();
  put_at(finding, {found.node, std::nullopt});
  std::string others;
  for (const NodeId other : found.others) {
    relate(finding, other);
    others += stable_path(tree_, other) + ' ';
  }
  if (found.run != nullptr) {
    finding.run = told_run(tree_, *file_.network, found.run->told(), {});
  }
  identify(finding, others);
}

void Findings::add_faults() {
  Finding& finding =
      add(rule::kFault,
          "Some runs end in a fault: an assignment out of range, a division by "
          "zero, or an\nexception. What would have followed is not judged. "
          "Without --prop, btcheck shows one.");
  finding.severity = Severity::Warning;
  finding.title = "some runs end in a fault";
  put_at(finding, {tree_.roots[0], std::nullopt});
  identify(finding, "");
}

void Findings::add_stop(const ReportedFile& reported) {
  Finding& finding =
      add(rule::kUndecided,
          sentence("The default report is not complete: " +
                   stop_text(reported.stopped, reported.progress)));
  finding.title = "not complete";
  put_at(finding, {tree_.roots[0], std::nullopt});
  identify(finding, "");
}

void Findings::add_error(const std::string& error) {
  Finding& finding = add(rule::kInternal, sentence("Internal error: " + error));
  finding.title = "internal error";
  put_at(finding, {tree_.roots[0], std::nullopt});
  identify(finding, "");
}

}  // namespace

std::string stable_path(const BehaviorTree& tree, NodeId node) {
  std::string path = part_of_path(tree, node);
  while (!tree.node(node).is_root()) {
    node = tree.node(node).parent;
    path = part_of_path(tree, node) + "/" + path;
  }
  return path;
}

std::vector<Finding> findings_of(const CheckResult& result,
                                 const CheckedFile& file,
                                 const ReportedFile& reported) {
  Findings findings(result, file);
  for (std::size_t i = 0; i < file.verdicts.size(); ++i) {
    findings.add_verdict(file.verdicts[i], reported.verdicts[i]);
  }
  if (file.has_faults) findings.add_faults();
  if (!file.defaults) return findings.take();
  for (std::size_t i = 0; i < file.defaults->tree.size(); ++i) {
    findings.add_answer(file.defaults->tree[i], reported.answers[i]);
  }
  for (const DefaultFinding& found : default_findings(*result.tree, file)) {
    findings.add_default(found);
  }
  if (reported.stopped != StopReason::None) findings.add_stop(reported);
  if (!reported.error.empty()) findings.add_error(reported.error);
  return findings.take();
}

Finding finding_of(const Diagnostic& diagnostic) {
  Finding finding;
  finding.code = diagnostic.code;
  finding.severity = diagnostic.severity;
  finding.title = diagnostic_summary(diagnostic.code);
  finding.message = diagnostic.message;
  if (!diagnostic.label.empty()) finding.message += ": " + diagnostic.label;
  finding.message = sentence(finding.message);
  if (!diagnostic.help.empty()) {
    finding.message += sentence("\nHelp: " + diagnostic.help);
  }
  finding.place = {diagnostic.file, diagnostic.span};
  finding.identity = fmt::format("{}\n{}", diagnostic.code, diagnostic.message);
  return finding;
}

}  // namespace btcheck
