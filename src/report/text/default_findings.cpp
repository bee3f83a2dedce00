// SPDX-License-Identifier: MIT
//
// None of this is a fault: a tree may well be meant that way. But it is what
// the author of a tree that misbehaves would like to have been told.
#include "report/text/default_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "model/tree/node_types.hpp"
#include "trace/why/why.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostLines = 8;

bool never(const NodeReport& report, NodeQuestion question) {
  return report.answers[static_cast<std::size_t>(question)].verdict ==
         Verdict::Violated;
}

bool may(const NodeReport& report, NodeQuestion question) {
  return report.answers[static_cast<std::size_t>(question)].verdict ==
         Verdict::Holds;
}

// What a node that the author surely meant to be of use is not.
std::optional<DefaultFinding> useless(const BehaviorTree& tree,
                                      const std::vector<NodeReport>& reports,
                                      const NodeReport& report) {
  const Node& node = tree.node(report.node);
  const auto found = [&](FindingKind kind, std::string_view what) {
    return DefaultFinding{
        kind,
        report.node,
        {},
        name_and_line(tree, report.node) + ' ' + std::string(what),
        nullptr};
  };
  if (never(report, NodeQuestion::Ticked)) {
    const bool parent_too =
        !node.is_root() &&
        never(reports[index(node.parent)], NodeQuestion::Ticked);
    if (parent_too) return std::nullopt;
    return found(FindingKind::NeverTicked, "can never be ticked");
  }
  if (!may(report, NodeQuestion::Ticked)) return std::nullopt;
  const bool is_parallel =
      node.type == NodeType::Parallel || node.type == NodeType::ParallelAll;
  if (is_parallel && never(report, NodeQuestion::Success)) {
    return found(FindingKind::NeverSucceeds,
                 fmt::format("can never succeed: {} of its {} children would "
                             "have to",
                             node.threshold, node.children.size()));
  }
  if (node.type != NodeType::Eval || node.assignment) return std::nullopt;
  if (never(report, NodeQuestion::Failure) &&
      may(report, NodeQuestion::Success)) {
    return found(FindingKind::AlwaysTrue, "is always true when it is ticked");
  }
  if (never(report, NodeQuestion::Success) &&
      may(report, NodeQuestion::Failure)) {
    return found(FindingKind::NeverTrue, "is never true when it is ticked");
  }
  return std::nullopt;
}

DefaultFinding stale_finding(const BehaviorTree& tree, const CheckedFile& file,
                             const StaleGuardReport& stale) {
  std::vector<std::string> guards;
  for (const NodeId guard : stale.guards) {
    guards.push_back(name_and_line(tree, guard));
  }
  return {FindingKind::StaleGuards, stale.action, stale.guards,
          fmt::format("{} {} not ticked again while {} runs{}",
                      enumerated(guards), guards.size() == 1 ? "is" : "are",
                      short_name(tree, stale.action),
                      when_text("; ", file.network->ticks, stale.run->ticks())),
          &*stale.run};
}

DefaultFinding left_finding(const BehaviorTree& tree, const CheckedFile& file,
                            const LeftRunningReport& left) {
  return {FindingKind::LeftRunning,
          left.leaf,
          {left.above},
          fmt::format(
              "{} is left running when {} has {}{}",
              name_and_line(tree, left.leaf), name_and_line(tree, left.above),
              left.decision == NodeStatus::Success ? "succeeded" : "failed",
              when_text("; ", file.network->ticks, left.run->ticks())),
          &*left.run};
}

// What stands in the report under its heading: the first few lines, or all of
// them and their runs.
std::string findings_under(std::string_view heading,
                           const std::vector<DefaultFinding>& findings,
                           const BehaviorTree& tree, const Network& network,
                           Detail detail) {
  if (findings.empty()) return "";
  std::string text = fmt::format("\n{}\n", heading);
  const bool tells_all = detail == Detail::EveryStep ||
                         findings[0].kind < FindingKind::StaleGuards;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (!tells_all && i >= kMostLines) {
      return text +
             fmt::format("  and {} more (-v)\n", findings.size() - kMostLines);
    }
    text += "  " + findings[i].text + '\n';
    if (tells_all && findings[i].run != nullptr) {
      text += run_text(tree, network, findings[i].run->told(), {});
    }
  }
  return text;
}

std::string_view heading_of(FindingKind kind) {
  switch (kind) {
    case FindingKind::StaleGuards:
      return "Guards that go stale";
    case FindingKind::LeftRunning:
      return "Left running";
    default:
      return "Worth a look";
  }
}

}  // namespace

std::vector<DefaultFinding> default_findings(const BehaviorTree& tree,
                                             const CheckedFile& file) {
  std::vector<DefaultFinding> findings;
  for (const NodeReport& report : file.defaults->nodes) {
    auto found = useless(tree, file.defaults->nodes, report);
    if (found) findings.push_back(std::move(*found));
  }
  for (const StaleGuardReport& stale : file.defaults->stale_guards) {
    findings.push_back(stale_finding(tree, file, stale));
  }
  for (const LeftRunningReport& left : file.defaults->left_running) {
    findings.push_back(left_finding(tree, file, left));
  }
  return findings;
}

std::string findings_text(const BehaviorTree& tree, const CheckedFile& file,
                          Detail detail) {
  const std::vector<DefaultFinding> all = default_findings(tree, file);
  std::string text;
  for (auto at = all.begin(); at != all.end();) {
    const std::string_view heading = heading_of(at->kind);
    const auto next = std::find_if(at, all.end(), [&](const auto& finding) {
      return heading_of(finding.kind) != heading;
    });
    text += findings_under(heading, {at, next}, tree, *file.network, detail);
    at = next;
  }
  return text;
}

}  // namespace btcheck
