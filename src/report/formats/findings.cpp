// SPDX-License-Identifier: MIT
//
// A finding points at the node in the tree's file that shows it, since that
// file is what people change; where there is no such node, it points at the
// property.
#include "report/formats/reported.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "check/replies.hpp"
#include "model/tree/node_types.hpp"
#include "report/codes/codes.hpp"
#include "report/text/report.hpp"
#include "text/choice.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

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
  const bool has_end = text.ends_with('.') || text.ends_with('?');
  if (!text.empty() && !has_end) text += '.';
  return text;
}

// What moves in the step with which a run shows that a property is broken. Of
// a loop no step does so alone: there it is the last event of a node that the
// property speaks of, else the last event of all.
template <class AnyRun>
Mover culprit_of(const BehaviorTree& tree, const Network& network,
                 const AnyRun& run, std::size_t loop,
                 const std::vector<NodeId>& subjects) {
  std::optional<Mover> last;        // of all steps but those of time
  std::optional<Mover> last_event;  // and of those that are events
  std::optional<Mover> last_of_subject;
  std::size_t i = 0;
  run.walk([&](const Valuation& before, const RunStep& step) {
    last.reset();
    const bool is_in_loop = i++ >= loop;
    if (step.step.edge == kTimeStep) return;
    const Mover mover = mover_of(network, step);
    last = mover;
    if (!event_of(tree, network, before, step)) return;
    last_event = mover;
    const auto* node = std::get_if<NodeId>(&mover);
    if (is_in_loop && node && std::ranges::count(subjects, *node) > 0) {
      last_of_subject = mover;
    }
  });
  const auto& found = loop == kNoLoop ? last : last_of_subject;
  return found ? *found : last_event.value_or(tree.roots[0]);
}

// "p is violated (after 2 ticks): Its title.", then the rule and the reason.
std::string message_of(std::string_view what, const ReportedProperty& of) {
  std::string message = sentence(fmt::format(
      "{} {}{}: {}", of.name, what, of.note.empty() ? "" : " (" + of.note + ")",
      of.title.empty() ? of.text : of.title));
  if (!of.title.empty()) message += "\n" + of.text;
  if (!of.reason.empty()) message += "\nWhy: " + of.reason;
  return message;
}

// Collects the findings of one file.
class Findings {
 public:
  Findings(const CheckResult& result, const CheckedFile& file)
      : result_(result), tree_(*result.tree), file_(file) {}

  void add_verdict(const PropertyVerdict& verdict,
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
    finding.about = Finding::About::Rule;
    if (!verdict.error.empty()) finding.message += "\n" + verdict.error;
    finding.title = reported.name;
    place_verdict(finding, verdict, reported);
    identify(finding, reported.name);
  }

  void add_answer(const TreeReport& report, const ReportedAnswer& reported) {
    if (!is_bad(report)) return;
    Finding& finding =
        add(reported.code, std::string(code_named(reported.code)->summary));
    finding.about = Finding::About::Mission;
    finding.severity = severity_of(report);
    finding.title = reported.question;
    finding.trace = reported.trace;
    finding.told = answer_told(report, finding);
    put_at(finding, report.run ? culprit_of(tree_, *file_.network, *report.run,
                                            report.run->loop(), {})
                               : tree_.roots[0]);
    finding.run = reported.run;
    identify(finding, reported.key);
  }

  void add_default(const TreeFinding& found, const std::string& trace) {
    Finding& finding =
        add(found.code, sentence(found.message) + "\n" +
                            sentence("Why: " + found.why) + "\n" +
                            sentence("Help: " + found.help));
    finding.severity = found.severity;
    finding.title = diagnostic_summary(found.code);
    put_at(finding, found.node);
    std::string others;
    for (const NodeId other : found.others) {
      relate(finding, other);
      others += stable_path(tree_, other) + ' ';
    }
    if (found.run) {
      finding.run = told_run(tree_, *file_.network, *found.run);
    }
    finding.repair = found.repair;
    for (const QuestionReply& each : replies_to(tree_, found)) {
      ReportedReply& answer = finding.answers.emplace_back();
      answer.words = each.words;
      for (const LeafClause& clause : each.clauses) {
        answer.contracts.push_back(contract_of(clause));
      }
      if (each.clauses.empty()) answer.comment = allowing(found);
    }
    finding.told = finding_text(result_, file_, found, Layout());
    finding.trace = trace;
    identify(finding, others);
  }

  // About the tree as a whole.
  Finding& add_to_root(std::string_view code, std::string_view title,
                       std::string message) {
    Finding& finding = add(code, sentence(std::move(message)));
    finding.title = title;
    put_at(finding, tree_.roots[0]);
    identify(finding, "");
    return finding;
  }

  std::vector<Finding> take() { return std::move(findings_); }

 private:
  Finding& add(std::string_view code, std::string message) {
    Finding finding;
    finding.code = code;
    finding.severity = code_named(code)->severity;
    finding.message = std::move(message);
    findings_.push_back(std::move(finding));
    return findings_.back();
  }

  void put_at(Finding& finding, const Mover& mover) const {
    finding.place = place_of(tree_, mover);
    const auto* node = std::get_if<NodeId>(&mover);
    finding.node =
        node ? stable_path(tree_, *node)
             : "variable " +
                   tree_.variable(std::get<StateVariableId>(mover)).name;
  }

  void identify(Finding& finding, std::string_view subject) const {
    finding.identity =
        fmt::format("{}\n{}\n{}", finding.code, subject, finding.node);
  }

  void relate(Finding& finding, NodeId node) const {
    constexpr std::size_t kMostRelated = 20;
    const Place place = place_of(tree_, node);
    const bool is_there = finding.place.file == place.file &&
                          finding.place.span.line == place.span.line &&
                          finding.place.span.column == place.span.column;
    if (is_there || finding.related.size() >= kMostRelated) return;
    finding.related.push_back(
        {place, fmt::format("{} is here", short_name(tree_, node))});
  }

  void place_verdict(Finding& finding, const PropertyVerdict& verdict,
                     const ReportedProperty& reported) const {
    const bool is_violated = verdict.verdict == Verdict::Violated;
    if (is_violated && verdict.run) {
      put_at(finding, culprit_of(tree_, *file_.network, *verdict.run,
                                 verdict.run->loop, verdict.subjects.nodes));
      finding.run = reported.run;
    } else if (is_violated && !verdict.subjects.nodes.empty()) {
      put_at(finding, verdict.subjects.nodes[0]);
    } else {
      finding.place = reported.place;
    }
    if (finding.place.file != reported.place.file) {
      finding.related.push_back(
          {reported.place, fmt::format("property {}", reported.name)});
    }
    for (const NodeId node : verdict.subjects.nodes) relate(finding, node);
  }

  // The message, and the run.
  std::string answer_told(const TreeReport& report,
                          const Finding& finding) const {
    std::string told =
        fmt::format("\n{}[{}]: {}\n", severity_name(finding.severity),
                    finding.code, finding.message);
    if (!report.run || report.run->is_empty()) return told;
    return told + run_text(tree_, *file_.network, report.run->told(),
                           TextStyle(Layout()));
  }

  const CheckResult& result_;
  const BehaviorTree& tree_;
  const CheckedFile& file_;
  std::vector<Finding> findings_;
};

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
  if (file.fault_level) {
    findings
        .add_to_root(
            rule::kFault, "some runs end in a fault",
            "Some runs end in a fault: an assignment out of range, a division "
            "by zero, or an\nexception. What would have followed is not "
            "judged. Without rules, btcheck shows one.")
        .severity = *file.fault_level;
  }
  if (file.defaults) {
    for (std::size_t i = 0; i < file.defaults->tree.size(); ++i) {
      findings.add_answer(file.defaults->tree[i], reported.answers[i]);
    }
  }
  const auto traces = trace_names(*result.tree, file.findings);
  for (std::size_t i = 0; i < file.findings.size(); ++i) {
    findings.add_default(file.findings[i], traces[i]);
  }
  if (!file.defaults) return findings.take();
  if (reported.stopped != StopReason::None) {
    findings
        .add_to_root(rule::kUndecided, "not complete",
                     "The default report is not complete: " +
                         stop_text(reported.stopped, reported.progress,
                                   file.defaults->open))
        .about = Finding::About::Mission;
  }
  if (!reported.error.empty()) {
    findings
        .add_to_root(rule::kInternal, "internal error",
                     "Internal error: " + reported.error)
        .about = Finding::About::Mission;
  }
  return findings.take();
}

std::string_view diagnostic_summary(std::string_view code) {
  const CodeRow* row = code_named(code);
  if (row == nullptr) return "something is wrong with an input";
  std::string_view words = row->summary;
  if (words.ends_with('.')) words.remove_suffix(1);
  return words;
}

Finding finding_of(const Diagnostic& diagnostic) {
  Finding finding;
  finding.about = Finding::About::Input;
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
  finding.repair = diagnostic.repair;
  finding.identity = fmt::format("{}\n{}", diagnostic.code, diagnostic.message);
  return finding;
}

}  // namespace btcheck
