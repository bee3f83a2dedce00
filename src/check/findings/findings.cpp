// SPDX-License-Identifier: MIT
#include "check/findings/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "check/findings/kinds.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// What loses the mission or leaves an actuator running comes first.
int rank_of(const TreeFinding& finding) {
  if (is_question(finding)) return 1000 + finding.rank;
  constexpr std::string_view kFirst[] = {"BT2208", "BT2207", "BT2206",
                                         "BT2210", "BT2209", "BT2215",
                                         "BT2202", "BT2216"};
  const auto* found =
      std::find(std::begin(kFirst), std::end(kFirst), finding.code);
  const int severity = static_cast<int>(finding.severity);
  return severity * 100 + static_cast<int>(found - std::begin(kFirst));
}

bool is_about(const TreeFinding& finding, NodeId node) {
  return finding.node == node || std::ranges::count(finding.others, node) > 0;
}

// Whether the other one tells it already: as what is dead behind a cause, as
// what a node can never do where its rule is said, or as an answer to what
// would be asked of the same nodes.
bool is_told_by(const TreeFinding& finding, const TreeFinding& other) {
  if (is_question(finding)) {
    return !is_question(other) && is_about(finding, other.node) &&
           is_about(other, finding.node);
  }
  if (is_question(other)) return false;
  if (finding.code == "BT2201") {
    return std::ranges::count(other.others, finding.node) > 0;
  }
  return finding.code == "BT2202" && other.code == "BT2208" &&
         finding.node == other.node;
}

// A subtree that stands in several places is one text.
void merge_alike(std::vector<TreeFinding>& findings, const BehaviorTree& tree) {
  std::map<std::tuple<std::string_view, std::uint32_t, int, int>, std::size_t>
      first;
  std::vector<TreeFinding> kept;
  for (TreeFinding& finding : findings) {
    const Node& node = tree.node(finding.node);
    const auto [at, is_new] =
        first.emplace(std::tuple(finding.code, node.included, node.span.line,
                                 node.span.column),
                      kept.size());
    if (is_new) {
      kept.push_back(std::move(finding));
    } else {
      auto& others = kept[at->second].others;
      others.push_back(finding.node);
      others.insert(others.end(), finding.others.begin(), finding.others.end());
    }
  }
  findings = std::move(kept);
}

}  // namespace

TreeFinding asked(TreeFinding finding, std::string_view question,
                  std::optional<bool> said, std::string_view against) {
  const bool is_answered = said == false;
  finding.severity = is_answered ? Severity::Warning : Severity::Note;
  finding.message.append(": ").append(is_answered ? against : question);
  return finding;
}

Suspicion& Look::add(TreeFinding finding) {
  found_.push_back({.finding = std::move(finding)});
  return found_.back();
}

Suspicion& Look::add_inverted(NodeId inverter, NodeId deed) {
  Suspicion& made = add(
      {.code = "BT2207",
       .node = inverter,
       .others = {deed},
       .message = fmt::format("{} succeeds because {} fails, and fails when it "
                              "succeeds",
                              told(inverter), told(deed)),
       .why = "an Inverter turns round what is done below it, too"});
  made.shown_by.push_back({deed, LocationRole::Failure});
  made.then = Consequence{inverter, LocationRole::Success};
  return made;
}

std::vector<std::uint32_t> Look::entries_of(
    NodeId node, std::optional<ScriptTime> when) const {
  std::vector<std::uint32_t> entries;
  for (const EntryUse* use : facts_.uses_of(node)) {
    const bool is_asked = use->reads && use->when == when;
    if (is_asked && std::ranges::count(entries, use->entry) == 0) {
      entries.push_back(use->entry);
    }
  }
  return entries;
}

std::vector<NodeId> Look::writers_of(
    const std::vector<std::uint32_t>& entries) const {
  std::vector<const EntryUse*> writes;
  for (const std::uint32_t entry : entries) {
    ask_budget();
    for (const EntryUse* use : facts_.uses_of_entry(entry)) {
      if (use->writes) writes.push_back(use);
    }
  }
  std::ranges::sort(writes);  // as they stand in the list of all uses
  std::vector<NodeId> writers;
  std::set<NodeId> known;
  for (const EntryUse* use : writes) {
    if (known.insert(use->node).second) writers.push_back(use->node);
  }
  return writers;
}

std::vector<Suspicion> suspicions_of(const NormalTree& normal) {
  const Stage stage("suspicious places were looked for");
  const TreeFacts facts(normal);
  Suspicions found;
  suspect_failure_flow(facts, found);
  suspect_swallowed(facts, found);
  suspect_lost_events(facts, found);
  suspect_guards(facts, found);
  suspect_restarts(facts, found);
  suspect_chases(facts, found);
  suspect_endings(facts, found);
  suspect_unwritten(facts, found);
  suspect_lasting(facts, found);
  suspect_open_questions(facts, found);
  for (Suspicion& each : found) normal.put_back(each);
  return found;
}

void rank(std::vector<TreeFinding>& findings, const BehaviorTree& tree) {
  std::vector<bool> is_told(findings.size());
  for (std::size_t i = 0; i < findings.size(); ++i) {
    for (std::size_t j = 0; j < findings.size() && !is_told[i]; ++j) {
      is_told[i] = i != j && is_told_by(findings[i], findings[j]);
    }
  }
  std::size_t at = 0;
  std::erase_if(findings, [&](const TreeFinding&) { return is_told[at++]; });
  merge_alike(findings, tree);
  std::ranges::stable_sort(findings, {}, [](const TreeFinding& finding) {
    return std::pair(rank_of(finding), finding.node);
  });
}

void fold_many(std::vector<TreeFinding>& findings) {
  constexpr std::size_t kMostOfKind = 3;
  std::map<std::string_view, std::vector<std::size_t>> of_kind;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    of_kind[findings[i].code].push_back(i);
  }
  std::vector<bool> is_folded(findings.size());
  for (const auto& [code, places] : of_kind) {
    if (places.size() <= kMostOfKind || is_question(findings[places[0]])) {
      continue;
    }
    TreeFinding& last = findings[places[kMostOfKind - 1]];
    for (std::size_t i = kMostOfKind; i < places.size(); ++i) {
      is_folded[places[i]] = true;
      last.others.push_back(findings[places[i]].node);
      last.folded.push_back(findings[places[i]].node);
    }
    last.message +=
        fmt::format("; and {} more like it", places.size() - kMostOfKind);
  }
  std::size_t at = 0;
  std::erase_if(findings, [&](const TreeFinding&) { return is_folded[at++]; });
}

bool is_meant_to_run_on(const BehaviorTree& tree) {
  return std::ranges::any_of(tree.roots, [&](NodeId at) {
    if (tree.node(at).loop) return true;
    while (!tree.node(at).children.empty()) {
      const Node& node = tree.node(at);
      const bool passes = node.children.size() == 1 ||
                          info_of(node.type).flow == Flow::OnSuccess;
      if (!passes) return false;
      at = node.children.back();
      if (is_endless(tree.node(at))) return true;
    }
    return false;
  });
}

}  // namespace btcheck
