// SPDX-License-Identifier: MIT
//
// None of this is a fault: a tree may well be meant that way. But it is what
// the author of a tree that misbehaves would like to have been told.
#include "cli/default_findings.hpp"

#include <fmt/format.h>

#include <vector>

#include "trace/story.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostLines = 8;

std::string name_and_line(const BehaviorTree& tree, NodeId node) {
  return fmt::format("{} (line {})", tree.node(node).name,
                     tree.node(node).span.line);
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

// A finding and the run that shows it.
struct Finding {
  std::string line;
  const Run* run = nullptr;
};

// Under a heading the first few lines, or all of them and their runs.
std::string findings_under(std::string_view heading,
                           const std::vector<Finding>& findings,
                           const BehaviorTree& tree, const Network& network,
                           Detail detail) {
  if (findings.empty()) return "";
  std::string text = fmt::format("\n{}\n", heading);
  const bool tells_all = detail == Detail::EveryStep;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (!tells_all && i >= kMostLines) {
      return text +
             fmt::format("  and {} more (-v)\n", findings.size() - kMostLines);
    }
    text += "  " + findings[i].line + '\n';
    if (tells_all && findings[i].run != nullptr) {
      text += run_text(tree, network, *findings[i].run, {});
    }
  }
  return text;
}

const Run* run_of(const std::optional<Run>& run) {
  return run ? &*run : nullptr;
}

std::string stale_text(const BehaviorTree& tree, const CheckedFile& file,
                       Detail detail) {
  std::vector<Finding> findings;
  for (const StaleGuardReport& stale : file.defaults->stale_guards) {
    std::vector<std::string> guards;
    for (const NodeId guard : stale.guards) {
      guards.push_back(name_and_line(tree, guard));
    }
    findings.push_back(
        {fmt::format("{} {} not ticked again while {} runs{}",
                     enumerated(guards), guards.size() == 1 ? "is" : "are",
                     short_name(tree, stale.action),
                     when_text("; ", file.network->ticks, stale.ticks)),
         run_of(stale.run)});
  }
  return findings_under("Guards that go stale", findings, tree, *file.network,
                        detail);
}

std::string left_running_text(const BehaviorTree& tree, const CheckedFile& file,
                              Detail detail) {
  std::vector<Finding> findings;
  for (const LeftRunningReport& left : file.defaults->left_running) {
    findings.push_back(
        {fmt::format(
             "{} is left running when {} has {}{}",
             name_and_line(tree, left.leaf), name_and_line(tree, left.above),
             left.decision == NodeStatus::Success ? "succeeded" : "failed",
             when_text("; ", file.network->ticks, left.ticks)),
         run_of(left.run)});
  }
  return findings_under("Left running", findings, tree, *file.network, detail);
}

}  // namespace

std::string findings_text(const BehaviorTree& tree, const CheckedFile& file,
                          Detail detail) {
  return worth_a_look(tree, file.defaults->nodes) +
         stale_text(tree, file, detail) + left_running_text(tree, file, detail);
}

}  // namespace btcheck
