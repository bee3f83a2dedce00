// SPDX-License-Identifier: MIT
//
// The face of the program for who writes no rules: the mission as a whole, a
// table of its nodes, and what is worth a look.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/report.hpp"
#include "trace/text.hpp"

namespace btcheck {
namespace {

struct TreeWords {
  TreeQuestion question;
  std::string_view words;
};
constexpr TreeWords kTreeWords[] = {
    {TreeQuestion::CanSucceed, "the mission can succeed"},
    {TreeQuestion::CanFail, "the mission can fail"},
    {TreeQuestion::CanAlwaysEnd, "from every state it can still end"},
    {TreeQuestion::NeverStuck, "it is never stuck"},
    {TreeQuestion::InRange, "every assignment stays in range"},
    {TreeQuestion::NoZeroTimeLoop, "every tick returns"}};

std::string tree_line(const TreeReport& report, bool has_fault) {
  std::string_view words;
  for (const TreeWords& known : kTreeWords) {
    if (known.question == report.question) words = known.words;
  }
  std::string answer = "yes";
  if (report.verdict == Verdict::Violated) answer = "NO";
  if (report.verdict == Verdict::Undecided) answer = "UNDECIDED";
  // A fault ends a run too, but not as its author meant it to end.
  if (has_fault && report.question == TreeQuestion::CanAlwaysEnd &&
      report.verdict == Verdict::Holds) {
    answer = "yes, but for the fault below";
  }
  const bool is_possibility = report.question == TreeQuestion::CanSucceed ||
                              report.question == TreeQuestion::CanFail;
  if (report.run) {
    answer += is_possibility ? fmt::format(", first at tick {}", report.ticks)
                             : std::string(", see below");
  }
  return fmt::format("  {:<36} {}\n", words, answer);
}

// A cell of the node table: the first tick, `-` for never, `?` for unknown,
// blank for what this type of node never does.
std::string cell(const Possibility& answer, bool applies) {
  if (answer.verdict == Verdict::Holds) return std::to_string(answer.ticks);
  if (!applies) return "";
  return answer.verdict == Verdict::Violated ? "-" : "?";
}

bool applies(const Network& network, NodeId node, std::size_t question) {
  constexpr std::array<std::string_view, kNodeQuestionCount> kLocations = {
      "tick_node", "success", "failure", "running", "halted"};
  const Automaton& automaton =
      network.automaton(network.node_automaton[index(node)]);
  return automaton.find_location(kLocations[question]).has_value();
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
    const bool begins_code_point =
        (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    if (begins_code_point && ++shown > width) {
      while ((static_cast<unsigned char>(result.back()) & 0xc0) == 0x80) {
        result.pop_back();
      }
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
        " {:>7}", cell(report.answers[q], applies(network, report.node, q)));
  }
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

bool never(const NodeReport& report, NodeQuestion question) {
  return report.answers[static_cast<std::size_t>(question)].verdict ==
         Verdict::Violated;
}

bool may(const NodeReport& report, NodeQuestion question) {
  return report.answers[static_cast<std::size_t>(question)].verdict ==
         Verdict::Holds;
}

// Nodes that the author surely meant to be of use, and are not.
std::string worth_a_look(const BehaviorTree& tree,
                         const std::vector<NodeReport>& reports) {
  std::string text;
  for (const NodeReport& report : reports) {
    const Node& node = tree.node(report.node);
    const std::string name =
        fmt::format("  {} (line {})", node.name, node.span.line);
    if (never(report, NodeQuestion::Ticked)) {
      const bool parent_too =
          !node.is_root() &&
          never(reports[index(node.parent)], NodeQuestion::Ticked);
      if (!parent_too) text += name + " can never be ticked\n";
      continue;
    }
    if (!may(report, NodeQuestion::Ticked)) continue;
    const bool is_parallel =
        node.type == NodeType::Parallel || node.type == NodeType::ParallelAll;
    if (is_parallel && never(report, NodeQuestion::Success)) {
      text += name + fmt::format(
                         " can never succeed: {} of its {} children "
                         "would have to\n",
                         node.threshold, node.children.size());
    }
    if (node.type == NodeType::Eval && !node.assignment) {
      if (never(report, NodeQuestion::Failure) &&
          may(report, NodeQuestion::Success)) {
        text += name + " is always true when it is ticked\n";
      } else if (never(report, NodeQuestion::Success) &&
                 may(report, NodeQuestion::Failure)) {
        text += name + " is never true when it is ticked\n";
      }
    }
  }
  return text.empty() ? text : "\nWorth a look\n" + text;
}

std::string fault_runs(const CheckResult& result, const CheckedFile& file,
                       Detail detail) {
  std::string text;
  for (const TreeReport& report : file.defaults->tree) {
    if (!is_fault(report) || !report.run) continue;
    for (const TreeWords& known : kTreeWords) {
      if (known.question == report.question) {
        text += fmt::format("\nNot so: {}\n", known.words);
      }
    }
    TextStyle style;
    style.detail = detail;
    text += report.run->steps.empty()
                ? "    from the very beginning\n"
                : run_text(*result.tree, *file.network, *report.run, style);
  }
  return text;
}

}  // namespace

std::string defaults_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail) {
  const DefaultReport& report = *file.defaults;
  const BehaviorTree& tree = *result.tree;
  std::string text = "\nThe mission as a whole\n";
  bool has_fault = false;
  for (const TreeReport& answer : report.tree) {
    has_fault |= answer.question == TreeQuestion::InRange &&
                 answer.verdict == Verdict::Violated;
  }
  for (const TreeReport& answer : report.tree) {
    text += tree_line(answer, has_fault);
  }
  text += fmt::format(
      "\nEach node, and the tick at which it can first be so (-: never)\n"
      "{:>5} {:<{}} {:>7} {:>7} {:>7} {:>7} {:>7}\n",
      "line", "node", kNameWidth, "ticked", "success", "failure", "running",
      "halted");
  for (const NodeReport& node : report.nodes) {
    text += node_line(tree, *file.network, node);
  }
  text += worth_a_look(tree, report.nodes);
  text += fault_runs(result, file, detail);
  if (report.stopped != StopReason::None) {
    text += fmt::format("\nUNDECIDED where a ? stands: {}\n",
                        stop_text(report.stopped, report.progress));
  }
  if (!report.error.empty()) text += "\ninternal error: " + report.error + "\n";
  return text;
}

}  // namespace btcheck
