// SPDX-License-Identifier: MIT
//
// A tree without rules: what the mission as a whole can do, a table of what is
// proven of each node, and a run for each answer that nobody wants.
#include "report/text/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "model/btcpp/action_clients.hpp"
#include "model/tree/granted.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/choice.hpp"
#include "text/utf8.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

// In the order of TreeQuestion.
constexpr std::array<QuestionWords, kTreeQuestionCount> kQuestions = {{
    {"can_succeed", "the mission can succeed"},
    {"can_fail", "the mission can fail"},
    {"can_always_end", "from every state it can still end"},
    {"can_always_succeed", "it can always still succeed"},
    {"never_stuck", "it is never stuck"},
    {"in_range", "no script or assignment fails"},
    {"no_zero_time_loop", "every tick returns"},
}};

// "no, can be lost in tick 3: land@23 -> failure".
std::string lost_text(const CheckResult& result, const Network& network,
                      const TreeReport& report) {
  std::string text = "no, can be lost";
  if (!report.run || report.run->is_empty()) return text;
  text += when_text(" ", network.ticks, report.run->ticks());
  const Run run = report.run->told();
  const auto event = event_of(
      *result.tree, network, run.state(run.steps.size() - 1), run.steps.back());
  return event ? text + ": " + event->text : text;
}

bool is_violated(const DefaultReport& report, TreeQuestion question) {
  return std::ranges::any_of(report.tree, [&](const TreeReport& answer) {
    return answer.question == question && answer.verdict == Verdict::Violated;
  });
}

std::string tree_text(const CheckResult& result, const CheckedFile& file) {
  const DefaultReport& report = *file.defaults;
  std::string text = "\nThe mission as a whole\n";
  for (const TreeReport& answer : report.tree) {
    // What can never succeed has no success to lose.
    if (answer.question == TreeQuestion::CanAlwaysSucceed &&
        is_violated(report, TreeQuestion::CanSucceed)) {
      continue;
    }
    text += fmt::format("  {:<36} {}\n", words_of(answer.question).words,
                        answer_text(result, file, answer));
  }
  return text;
}

// A cell of the node table: the first tick, `-` for never, `?` for unknown,
// blank for what this type of node never does.
std::string cell(const Possibility& answer, bool applies, bool has_time) {
  if (answer.verdict == Verdict::Holds) {
    return has_time ? std::to_string(answer.ticks()) : "yes";
  }
  if (!applies) return "";
  return answer.verdict == Verdict::Violated ? "-" : "?";
}

std::size_t depth_of(const BehaviorTree& tree, NodeId node) {
  std::size_t depth = 0;
  for (; !tree.node(node).is_root(); node = tree.node(node).parent) ++depth;
  return depth;
}

constexpr std::size_t kNameWidth = 34;  // of a table of kLineWidth
constexpr std::size_t kMostIndent = 16;

// The text as so many code points: padded, or cut with `~` as the last.
std::string fitted(const std::string& text, std::size_t width) {
  std::string result;
  std::size_t shown = 0;
  for (const char c : text) {
    if (!continues_character(c) && ++shown > width) {
      while (continues_character(result.back())) result.pop_back();
      result.back() = '~';
      return result;
    }
    result += c;
  }
  return result + std::string(width - shown, ' ');
}

std::string name_in_table(const BehaviorTree& tree, NodeId node) {
  return std::string(std::min(depth_of(tree, node), kMostIndent), ' ') +
         typed_name(tree.node(node));
}

// As wide as the longest name, where there is room for it.
std::size_t name_width(const BehaviorTree& tree, const DefaultReport& report,
                       std::size_t width) {
  const std::size_t most = kNameWidth + (width - kLineWidth);
  std::size_t longest = kNameWidth;
  for (const NodeReport& each : report.nodes) {
    const int letters = count_code_points(name_in_table(tree, each.node));
    longest = std::max(longest, static_cast<std::size_t>(letters));
  }
  return std::min(longest, most);
}

std::string node_line(const BehaviorTree& tree, const Network& network,
                      const NodeReport& report, std::size_t width) {
  const Node& node = tree.node(report.node);
  std::string line =
      fmt::format("{:>5} {}", node.span.line,
                  fitted(name_in_table(tree, report.node), width));
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    line += fmt::format(
        " {:>7}", cell(report.answers[q], can_be_asked(network, report.node, q),
                       network.ticks != TickSemantics::None));
  }
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

std::string table_heading(TickSemantics ticks, Reduction reduction) {
  if (ticks == TickSemantics::None) {
    return "Each node, and whether it can ever be so (-: never)";
  }
  return fmt::format(
      "Each node, and {} it can be so, on {} (-: never)",
      ticks == TickSemantics::Root ? "a tick in which" : "a time at which",
      reduction != Reduction::Full ? "a shortest run" : "some run");
}

std::string table_text(const BehaviorTree& tree, const CheckedFile& file,
                       Layout layout) {
  const std::size_t width = name_width(tree, *file.defaults, layout.width);
  std::string text = fmt::format(
      "\n{}\n{:>5} {:<{}} {:>7} {:>7} {:>7} {:>7} {:>7}{}\n",
      table_heading(file.network->ticks, file.defaults->reduction), "line",
      "node", width, "ticked", "success", "failure", "running", "halted",
      is_engine(tree.profile) ? " skipped" : "");
  NodeId before = tree.roots[0];
  for (const NodeReport& report : file.defaults->nodes) {
    if (tree.file_of(report.node) != tree.file_of(before)) {
      text += fmt::format("      in {}\n", short_file(tree, report.node));
    }
    text += node_line(tree, *file.network, report, width);
    before = report.node;
  }
  return text;
}

// An endless Repeat goes round within a tick when all below it succeeds at
// once. Clients of action servers do not (model/btcpp/action_clients).
bool waits_for_goals(const BehaviorTree& tree) {
  return std::ranges::any_of(tree.nodes, [&](const Node& leaf) {
    if (!btcpp::is_action_client(tree.profile, leaf.id)) return false;
    const Node* at = &leaf;
    while (!at->is_root()) {
      at = &tree.node(at->parent);
      const bool is_loop =
          at->type == NodeType::Repeat && at->repetitions == kEndlessRounds;
      if (is_loop) return true;
    }
    return false;
  });
}

// What can be said of the actions that succeed at once, in a loop that takes no
// time: the first of them is named.
std::string lasting_help(const BehaviorTree& tree, const Network& network,
                         const Run& run) {
  for (const RunStep& step : run.steps) {
    if (step.step.edge == kTimeStep) continue;
    const Automaton& mover = network.owner_of_edge(step.step.edge);
    if (mover.kind != AutomatonKind::Node) continue;
    const Node& leaf = tree.node(mover.node);
    const auto name = contract_name(leaf.id);
    const bool may_last =
        leaf.type == NodeType::Action && leaf.contract.may_run && name;
    if (!may_last) continue;
    return fmt::format(
        "    If it takes time, say so in a file for {}, in ticks:\n"
        "    (defaction {} :duration [1,2])\n",
        word(Choice::Leaves), *name);
  }
  return {};
}

// The runs of questions answered no: those of faults always, that of a success
// that can be lost only where every step is told.
std::string tree_runs(const CheckResult& result, const CheckedFile& file,
                      Layout layout) {
  std::string text;
  for (const TreeReport& report : file.defaults->tree) {
    const bool is_lost = report.question == TreeQuestion::CanAlwaysSucceed &&
                         report.verdict == Verdict::Violated &&
                         layout.detail == Detail::EveryStep;
    if (!report.run || !(is_bad(report) || is_lost)) continue;
    if (is_lost && report.run->is_empty()) continue;
    text += fmt::format("\nNot so: {}\n", words_of(report.question).words);
    text += report.run->is_empty()
                ? "    from the very beginning\n"
                : run_text(*result.tree, *file.network, report.run->told(),
                           TextStyle(layout));
    if (report.question == TreeQuestion::NoZeroTimeLoop) {
      text += lasting_help(*result.tree, *file.network, report.run->told());
    }
  }
  return text;
}

// What to do where the limits were too narrow.
std::string undecided_text(const BehaviorTree& tree,
                           const DefaultReport& report, bool has_table) {
  if (report.stopped == StopReason::None) return {};
  std::string text =
      fmt::format("\nUNDECIDED{}: {}\n", has_table ? " where a ? stands" : "",
                  stop_text(report.stopped, report.progress, report.open));
  if (report.stopped == StopReason::Interrupted ||
      report.stopped == StopReason::OpenEntries) {
    return text;
  }
  text +=
      "  `btcheck space`, on a part of the tree, tells what multiplies its "
      "states.\n";
  if (tree.roots.size() == 1) return text;
  return text +
         "  Trees that share few variables can be checked one at a time: leave "
         "the\n  others out and let what they write move by itself (:moves "
         "free). What\n  never happens then never happens among them.\n";
}

// The lines of a file that the tree was read from.
std::string line_in(const CheckResult& result, const std::string& file,
                    int number) {
  for (const InputFile& source : result.sources) {
    if (source.name != file) continue;
    return SourceText(source.name, source.text).line(number);
  }
  return {};
}

// "3 findings, 2 questions".
std::string counted_findings(const CheckedFile& file, bool is_whole) {
  const auto asked = static_cast<std::size_t>(
      std::ranges::count_if(file.findings, is_question));
  const std::size_t found = file.findings.size() - asked;
  std::string text = found > 0  ? counted(found, "finding", "findings")
                     : is_whole ? "no findings"
                                : "nothing found so far";
  if (asked > 0) text += ", " + counted(asked, "question", "questions");
  return text;
}

// "3 findings; 39 nodes, 132,433 states, all runs".
std::string summary_text(const CheckResult& result, const CheckedFile& file) {
  const DefaultReport& report = *file.defaults;
  const bool is_whole = report.stopped == StopReason::None;
  return fmt::format("\n{}{}; {}, {}, {}\n", counted_findings(file, is_whole),
                     judged_text(count_of(result.judged)),
                     counted(result.tree->nodes.size(), "node", "nodes"),
                     grouped(report.progress.states) +
                         (report.progress.states == 1 ? " state" : " states"),
                     is_whole ? "all runs" : "within the limits");
}

// "; error[BT2105]": a level that the user has given it.
std::string level_text(const TreeReport& answer) {
  TreeReport usual;
  usual.question = answer.question;
  if (severity_of(answer) == severity_of(usual)) return {};
  return fmt::format("; {}[{}]", severity_name(severity_of(answer)),
                     code_of(answer.question));
}

// Those of the answers that are not as a mission's should be.
std::string unusual_text(const CheckResult& result, const CheckedFile& file) {
  std::string text;
  for (const TreeReport& answer : file.defaults->tree) {
    if (!is_bad(answer)) continue;
    text += fmt::format("  {:<36} {}{}\n", words_of(answer.question).words,
                        answer_text(result, file, answer), level_text(answer));
  }
  return text.empty() ? text : "\nThe mission as a whole\n" + text;
}

}  // namespace

const QuestionWords& words_of(TreeQuestion question) {
  return kQuestions[static_cast<std::size_t>(question)];
}

std::string answer_text(const CheckResult& result, const CheckedFile& file,
                        const TreeReport& answer) {
  if (answer.verdict == Verdict::Undecided) return "UNDECIDED";
  using enum TreeQuestion;
  const bool holds = answer.verdict == Verdict::Holds;
  if (answer.question == CanSucceed || answer.question == CanFail) {
    if (!holds) return "NO";
    return "yes" + when_text(", e.g. ", file.network->ticks, answer.ticks());
  }
  if (!holds && answer.question == CanAlwaysSucceed) {
    return lost_text(result, *file.network, answer);
  }
  if (!holds) return answer.run ? "NO, see below" : "NO";
  // A fault ends a run too, but not as its author meant it to end.
  const bool has_fault =
      answer.question == CanAlwaysEnd && is_violated(*file.defaults, InRange);
  if (has_fault) return "yes, but for the fault below";
  const bool is_assumed =
      answer.question == NoZeroTimeLoop && waits_for_goals(*result.tree);
  if (is_assumed) return "yes, as reaching a goal takes time";
  const auto needed = granted(*result.tree);
  const bool is_needed = answer.question == InRange && !needed.empty();
  return is_needed ? fmt::format("yes, if {}", fmt::join(needed, " and "))
                   : "yes";
}

bool can_be_asked(const Network& network, NodeId node, std::size_t question) {
  const Automaton& automaton =
      network.automaton(network.node_automaton[index(node)]);
  return automaton.find_location(kNodeQuestionRoles[question]).has_value();
}

std::string when_text(std::string_view before, TickSemantics ticks, int time) {
  if (ticks == TickSemantics::None) return {};
  return fmt::format("{}{} {}", before,
                     ticks == TickSemantics::Root ? "in tick" : "at time",
                     time);
}

Diagnostic diagnostic_of(const CheckResult& result,
                         const TreeFinding& finding) {
  const Node& node = result.tree->node(finding.node);
  Diagnostic made;
  made.severity = finding.severity;
  made.code = finding.code;
  made.message = finding.message;
  made.file = result.tree->file_of(finding.node);
  made.span = node.span;
  made.source_line = line_in(result, made.file, node.span.line);
  made.label = finding.why;
  made.help = finding.help;
  made.repair = finding.repair;
  return made;
}

std::string finding_text(const CheckResult& result, const CheckedFile& file,
                         const TreeFinding& finding, Layout layout) {
  const std::size_t most =
      layout.detail == Detail::EveryStep ? SIZE_MAX - 1 : kFewDiffLines;
  std::string text =
      "\n" + render(diagnostic_of(result, finding), most, layout.width);
  if (!finding.run || finding.run->is_empty()) return text;
  const Run run = finding.run->told();
  if (layout.detail == Detail::EveryStep) {
    return text + run_text(*result.tree, *file.network, run,
                           TextStyle({Detail::Events, layout.width}));
  }
  std::vector<NodeId> shown = finding.others;
  shown.push_back(finding.node);
  return text + brief_text(recorded_steps(*result.tree, *file.network, run),
                           shown, layout.width);
}

// A line for each of the first, with what else is asked; with every step all of
// them, the first of each kind as findings are told.
std::string questions_text(const CheckResult& result, const CheckedFile& file,
                           Layout layout) {
  constexpr std::size_t kMost = kShownQuestions;
  const bool tells_all = layout.detail == Detail::EveryStep;
  std::string text;
  std::string lines;
  std::size_t count = 0;
  std::map<std::string_view, std::size_t> of_kind;
  for (const TreeFinding& finding : file.findings) {
    if (!is_question(finding)) continue;
    if (tells_all && ++of_kind[finding.code] <= kMost) {
      text += finding_text(result, file, finding, layout);
    } else if (tells_all || ++count <= kMost) {
      const std::string begin = fmt::format(
          "  {}  {}  ", finding.code, line_of(*result.tree, finding.node));
      lines +=
          begin + wrapped(finding.message, begin.size(), layout.width) + "\n";
    }
  }
  if (count > kMost) lines += fmt::format("  and {} more: -v\n", count - kMost);
  if (lines.empty()) return text;
  return text +
         fmt::format("\nQuestions that `btcheck answer` asks you{}\n",
                     tells_all ? ", too" : " (-v shows the run)") +
         lines;
}

std::string findings_text(const CheckResult& result, const CheckedFile& file,
                          Layout layout) {
  std::string text;
  for (const TreeFinding& finding : file.findings) {
    if (!is_question(finding)) {
      text += finding_text(result, file, finding, layout);
    }
  }
  return text + questions_text(result, file, layout);
}

std::string beside_rules_text(const CheckResult& result,
                              const CheckedFile& file, Layout layout) {
  if (layout.detail == Detail::EveryStep)
    return findings_text(result, file, layout);
  std::string text;
  for (const TreeFinding& finding : file.findings) {
    if (is_question(finding)) continue;
    text += fmt::format("{}[{}] {}: {}\n", severity_name(finding.severity),
                        finding.code, line_of(*result.tree, finding.node),
                        finding.message);
  }
  if (!text.empty()) {
    text = "\nBeside the rules (btcheck TREE says more)\n" + text;
  }
  const std::string judged = judged_text(count_of(result.judged));
  if (judged.empty()) return text;
  return text + fmt::format("\nnot told: {}\n", judged.substr(2));
}

std::string defaults_text(const CheckResult& result, const CheckedFile& file,
                          Layout layout) {
  const DefaultReport& report = *file.defaults;
  const bool tells_all = layout.detail == Detail::EveryStep;
  std::string text = findings_text(result, file, layout);
  text += tells_all ? tree_text(result, file) : unusual_text(result, file);
  if (tells_all) text += table_text(*result.tree, file, layout);
  text += tree_runs(result, file, layout);
  text += undecided_text(*result.tree, report, tells_all);
  text += summary_text(result, file);
  if (!report.error.empty()) text += "\ninternal error: " + report.error + "\n";
  return text;
}

}  // namespace btcheck
