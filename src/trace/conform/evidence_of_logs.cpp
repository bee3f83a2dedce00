// SPDX-License-Identifier: MIT
#include "trace/conform/evidence_of_logs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "model/btcpp/known_types.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}", count, what);
}

// The engine's own nodes have no contracts.
bool has_contract(const BehaviorTree& tree, const Node& node) {
  if (node.type != NodeType::Action && node.type != NodeType::Condition) {
    return false;
  }
  return !is_engine(tree.profile) ||
         btcpp::builtin_type(btcpp::dialect_of(tree.profile), node.id) ==
             nullptr;
}

}  // namespace

void LogEvidence::add(const BehaviorLog& log, const LoggedNodes& nodes,
                      const LogReading& reading) {
  ++logs_;
  is_guessed_ |= !knows_ticks(log, reading);
  std::map<std::uint16_t, std::int64_t> began;  // by uid: the tick
  const std::vector<std::int64_t> ticks = ticks_of(log, reading);
  std::size_t number = 0;
  std::int64_t tick = 0;
  const auto ran = [&](std::uint16_t uid) {
    const auto found = began.find(uid);
    if (found == began.end()) return std::int64_t{0};
    const std::int64_t length = tick - found->second;
    began.erase(found);
    return length;
  };
  const LogTransition* last = nullptr;
  for (const LogTransition& record : log.transitions) {
    const std::int64_t last_tick = std::exchange(tick, ticks[number++]);
    const LogTransition* before = std::exchange(last, &record);
    Counts& counts = nodes_[index(nodes.node(record.uid))];
    // RUNNING, and at once the answer: a SimpleActionNode calls its function.
    const bool is_at_once = before != nullptr && before->uid == record.uid &&
                            before->after == LogStatus::Running &&
                            last_tick == tick && !is_own(log);
    if (is_at_once && is_completed(record.after)) --counts.running;
    if (record.after == LogStatus::Running) {
      ++counts.running;
      began[record.uid] = tick;
    } else if (is_completed(record.after)) {
      ++(record.after == LogStatus::Success ? counts.success : counts.failure);
      const std::int64_t length = ran(record.uid);
      counts.shortest = std::min(counts.shortest, length);
      counts.longest = std::max(counts.longest, length);
    } else if (record.before == LogStatus::Running) {
      ++counts.halted;
      counts.longest_open = std::max(counts.longest_open, ran(record.uid));
    }
  }
  for (const auto& [uid, since] : began) {
    Counts& counts = nodes_[index(nodes.node(uid))];
    counts.longest_open = std::max(counts.longest_open, tick - since + 1);
  }
}

// n samples spread evenly up to some length stay below it by longest / n, on
// the average; so that is the margin.
std::string LogEvidence::duration_text(const Counts& all) {
  const std::size_t samples = all.success + all.failure;
  if (samples == 0) return "\n  :duration [1,inf])  ; it never answered\n";
  const auto n = static_cast<std::int64_t>(samples);
  const std::int64_t margin = (all.longest + n - 1) / n;
  const std::int64_t least =
      std::max(all.shortest - margin, std::min<std::int64_t>(all.shortest, 1));
  const bool is_open = all.longest_open > all.longest;
  std::string text = fmt::format(
      "\n  :duration [{},{}])  ; {}: {}", least,
      is_open ? "inf" : fmt::format("{}", all.longest + margin),
      samples == 1 ? "1 sample" : counted(samples, "samples"), all.shortest);
  if (all.longest > all.shortest) text += fmt::format(" to {}", all.longest);
  text += fmt::format(" ticks, and a margin of {}", margin);
  if (is_open) {
    text += fmt::format("; {} ticks without an answer", all.longest_open);
  }
  return text + "\n";
}

std::string LogEvidence::leaves_text() const {
  std::map<std::string, std::pair<const Node*, Counts>> types;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = tree_.nodes[n];
    if (!has_contract(tree_, node)) continue;
    auto& [first, all] = types[node.id.empty() ? node.name : node.id];
    const Counts& own = nodes_[n];
    first = &node;
    all.success += own.success;
    all.failure += own.failure;
    all.running += own.running;
    all.halted += own.halted;
    all.shortest = std::min(all.shortest, own.shortest);
    all.longest = std::max(all.longest, own.longest);
    all.longest_open = std::max(all.longest_open, own.longest_open);
  }
  std::string text = fmt::format(
      "; What {} of {} show{}. Read it before you rely on it: what has not\n"
      "; been seen may happen all the same.\n",
      logs_ == 1 ? "one log" : counted(logs_, "logs"), one_line(tree_.file),
      logs_ == 1 ? "s" : "");
  if (is_guessed_) {
    text += fmt::format(
        "; Where ticks begin is not logged: here, a pause of {} ms parts two\n"
        "; of them, and durations are as good as that.\n",
        kTickPause / 1000);
  }
  for (const auto& [name, entry] : types) {
    const auto& [node, all] = entry;
    std::vector<std::string> returns;
    if (all.success > 0) returns.emplace_back("success");
    if (all.failure > 0) returns.emplace_back("failure");
    if (all.running > 0) returns.emplace_back("running");
    if (returns.empty()) {
      text += fmt::format("; {}: never asked\n", one_line(name));
      continue;
    }
    const bool is_action = node->type == NodeType::Action;
    text += fmt::format(
        "({} {}  ; success {}, failure {}, began to run {}, halted {}\n"
        "  :returns ({})",
        is_action ? "defaction" : "defcondition",
        contract_name(name).value_or(quoted(one_line(name))), all.success,
        all.failure, all.running, all.halted, fmt::join(returns, " "));
    text += is_action && all.running > 0 ? duration_text(all) : ")\n";
  }
  return text;
}

bool LogEvidence::is_shown(NodeId node, NodeQuestion question) const {
  const Counts& counts = nodes_[index(node)];
  switch (question) {
    case NodeQuestion::Success:
      return counts.success > 0;
    case NodeQuestion::Failure:
      return counts.failure > 0;
    case NodeQuestion::Running:
      return counts.running > 0;
    case NodeQuestion::Halted:
      return counts.halted > 0;
    case NodeQuestion::Ticked:
    case NodeQuestion::Skipped:
      return counts.success + counts.failure + counts.running > 0;
  }
  return false;
}

// A log has nothing of the tree itself and of what is skipped; that an inner
// node runs is the same as that it is ticked.
template <class Visit>
void LogEvidence::each_possible(const DefaultReport& report,
                                Visit visit) const {
  for (const NodeReport& node : report.nodes) {
    if (tree_.node(node.node).is_root()) continue;
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      const auto question = static_cast<NodeQuestion>(q);
      const bool is_inner = !tree_.node(node.node).children.empty();
      const bool is_in_logs = question != NodeQuestion::Skipped &&
                              question != NodeQuestion::Ticked &&
                              !(is_inner && question == NodeQuestion::Running);
      if (!is_in_logs || node.answers[q].verdict != Verdict::Holds) continue;
      visit(node.node, question);
    }
  }
}

std::vector<std::string> LogEvidence::unseen(
    const DefaultReport& report) const {
  std::vector<std::string> lines;
  each_possible(report, [&](NodeId node, NodeQuestion question) {
    if (is_shown(node, question)) return;
    lines.push_back(
        fmt::format("{}: {}", short_name(tree_, node),
                    kNodeQuestionNames[static_cast<std::size_t>(question)]));
  });
  return lines;
}

LogEvidence::Coverage LogEvidence::coverage(const DefaultReport& report) const {
  Coverage coverage;
  each_possible(report, [&](NodeId node, NodeQuestion question) {
    ++coverage.possible;
    coverage.seen += is_shown(node, question);
  });
  return coverage;
}

}  // namespace btcheck
