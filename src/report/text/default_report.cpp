// SPDX-License-Identifier: MIT
//
// The face of the program for who writes no rules: the mission as a whole, a
// table of its nodes, and what is worth a look (default_findings.cpp).
#include <fmt/format.h>

#include <algorithm>

#include "model/tree/node_types.hpp"
#include "report/text/default_findings.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

// "no, can be lost in tick 3: land@23 -> failure".
std::string lost_text(const CheckResult& result, const Network& network,
                      const TreeReport& report) {
  std::string text = "no, can be lost";
  if (!report.run || report.run->is_empty()) return text;
  switch (network.ticks) {
    case TickSemantics::Root:
      text += fmt::format(" in tick {}", report.run->ticks());
      break;
    case TickSemantics::Leaves:
    case TickSemantics::Nodes:
      text += fmt::format(" at time {}", report.run->ticks());
      break;
    case TickSemantics::None:
      break;
  }
  const Run run = report.run->told();
  const auto event = event_of(
      *result.tree, network, run.state(run.steps.size() - 1), run.steps.back());
  return event ? text + ": " + event->text : text;
}

bool is_violated(const DefaultReport& report, TreeQuestion question) {
  return std::any_of(report.tree.begin(), report.tree.end(),
                     [&](const TreeReport& answer) {
                       return answer.question == question &&
                              answer.verdict == Verdict::Violated;
                     });
}

std::string tree_text(const CheckResult& result, const CheckedFile& file) {
  const DefaultReport& report = *file.defaults;
  std::string text = "\nThe mission as a whole\n";
  for (const TreeReport& answer : report.tree) {
    // Who cannot succeed at all cannot lose that, either.
    if (answer.question == TreeQuestion::CanAlwaysSucceed &&
        is_violated(report, TreeQuestion::CanSucceed)) {
      continue;
    }
    text += fmt::format("  {:<36} {}\n", words_of(answer.question),
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

constexpr std::size_t kNameWidth = 34;
constexpr std::size_t kMostIndent = 16;

// The text with its end cut off, and `~` there, where it has more code points
// than fit; padded where it has fewer.
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

std::string node_line(const BehaviorTree& tree, const Network& network,
                      const NodeReport& report) {
  const Node& node = tree.node(report.node);
  std::string name(std::min(depth_of(tree, report.node), kMostIndent), ' ');
  const std::string type(type_name(node.type));
  name += node.name.rfind(type, 0) == 0 ? node.name
                                        : fmt::format("{} {}", type, node.name);
  std::string line =
      fmt::format("{:>5} {}", node.span.line, fitted(name, kNameWidth));
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    line += fmt::format(
        " {:>7}", cell(report.answers[q], can_be_asked(network, report.node, q),
                       network.ticks != TickSemantics::None));
  }
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

std::string table_heading(TickSemantics ticks, Reduction reduction) {
  const std::string_view run =
      reduction == Reduction::None ? "a shortest run" : "some run";
  switch (ticks) {
    case TickSemantics::Root:
      return fmt::format(
          "Each node, and a tick in which it can be so, on {} (-: never)", run);
    case TickSemantics::Leaves:
    case TickSemantics::Nodes:
      return fmt::format(
          "Each node, and a time at which it can be so, on {} (-: never)", run);
    case TickSemantics::None:
      break;
  }
  return "Each node, and whether it can ever be so (-: never)";
}

std::string table_text(const BehaviorTree& tree, const CheckedFile& file) {
  std::string text = fmt::format(
      "\n{}\n{:>5} {:<{}} {:>7} {:>7} {:>7} {:>7} {:>7}\n",
      table_heading(file.network->ticks, file.defaults->reduction), "line",
      "node", kNameWidth, "ticked", "success", "failure", "running", "halted");
  NodeId before = tree.roots[0];
  for (const NodeReport& report : file.defaults->nodes) {
    if (tree.file_of(report.node) != tree.file_of(before)) {
      text += fmt::format("      in {}\n", short_file(tree, report.node));
    }
    text += node_line(tree, *file.network, report);
    before = report.node;
  }
  return text;
}

// The runs of questions answered no: of faults always, of a success that can
// be lost where every step is told.
std::string tree_runs(const CheckResult& result, const CheckedFile& file,
                      Detail detail) {
  std::string text;
  for (const TreeReport& report : file.defaults->tree) {
    const bool is_lost = report.question == TreeQuestion::CanAlwaysSucceed &&
                         report.verdict == Verdict::Violated &&
                         detail == Detail::EveryStep;
    if (!report.run || !(is_fault(report) || is_lost)) continue;
    if (is_lost && report.run->is_empty()) continue;
    text += fmt::format("\nNot so: {}\n", words_of(report.question));
    TextStyle style;
    style.detail = detail;
    text += report.run->is_empty() ? "    from the very beginning\n"
                                   : run_text(*result.tree, *file.network,
                                              report.run->told(), style);
  }
  return text;
}

}  // namespace

std::string_view words_of(TreeQuestion question) {
  switch (question) {
    case TreeQuestion::CanSucceed:
      return "the mission can succeed";
    case TreeQuestion::CanFail:
      return "the mission can fail";
    case TreeQuestion::CanAlwaysEnd:
      return "from every state it can still end";
    case TreeQuestion::CanAlwaysSucceed:
      return "it can always still succeed";
    case TreeQuestion::NeverStuck:
      return "it is never stuck";
    case TreeQuestion::InRange:
      return "no script or assignment fails";
    case TreeQuestion::NoZeroTimeLoop:
      return "every tick returns";
  }
  return "";
}

std::string answer_text(const CheckResult& result, const CheckedFile& file,
                        const TreeReport& answer) {
  if (answer.verdict == Verdict::Undecided) return "UNDECIDED";
  const bool holds = answer.verdict == Verdict::Holds;
  switch (answer.question) {
    case TreeQuestion::CanSucceed:
    case TreeQuestion::CanFail:
      return holds
                 ? "yes" + when_text(", ", file.network->ticks, answer.ticks())
                 : "NO";
    case TreeQuestion::CanAlwaysSucceed:
      return holds ? "yes" : lost_text(result, *file.network, answer);
    case TreeQuestion::CanAlwaysEnd:
      // A fault ends a run too, but not as its author meant it to end.
      if (holds && is_violated(*file.defaults, TreeQuestion::InRange)) {
        return "yes, but for the fault below";
      }
      break;
    default:
      break;
  }
  if (holds) return "yes";
  return answer.run ? "NO, see below" : "NO";
}

bool can_be_asked(const Network& network, NodeId node, std::size_t question) {
  const Automaton& automaton =
      network.automaton(network.node_automaton[index(node)]);
  return automaton.find_location(kNodeQuestionRoles[question]).has_value();
}

std::string when_text(std::string_view before, TickSemantics ticks, int time) {
  switch (ticks) {
    case TickSemantics::Root:
      return fmt::format("{}e.g. in tick {}", before, time);
    case TickSemantics::Leaves:
    case TickSemantics::Nodes:
      return fmt::format("{}e.g. at time {}", before, time);
    case TickSemantics::None:
      break;
  }
  return "";
}

// What to do where the limits were too narrow.
std::string undecided_text(const BehaviorTree& tree,
                           const DefaultReport& report) {
  if (report.stopped == StopReason::None) return {};
  std::string text = fmt::format(
      "\nUNDECIDED where a ? stands: {}\n",
      with_open(stop_text(report.stopped, report.progress), report.open));
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

std::string defaults_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail) {
  const DefaultReport& report = *file.defaults;
  std::string text = tree_text(result, file);
  text += table_text(*result.tree, file);
  text += findings_text(*result.tree, file, detail);
  text += tree_runs(result, file, detail);
  text += undecided_text(*result.tree, report);
  if (!report.error.empty()) text += "\ninternal error: " + report.error + "\n";
  return text;
}

}  // namespace btcheck
