// SPDX-License-Identifier: MIT
#include "report/whatif/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "report/text/report.hpp"

namespace btcheck {
namespace {

std::string quoted(const BehaviorTree& tree, NodeId node) {
  return fmt::format("`{}`", short_name(tree, node));
}

// "`a`, `b` and 2 more".
std::string some(const BehaviorTree& tree, const std::vector<NodeId>& nodes) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < nodes.size() && i < kMost; ++i) {
    text += (i == 0 ? "" : ", ") + quoted(tree, nodes[i]);
  }
  if (nodes.size() <= kMost) return text;
  return text + fmt::format(" and {} more", nodes.size() - kMost);
}

std::string_view verb_of(Happening what) {
  switch (what) {
    case Happening::Success:
      return "succeeds";
    case Happening::Failure:
      return "fails";
    case Happening::Running:
      return "runs";
    case Happening::Skipped:
      return "is skipped";
    case Happening::Halted:
      return "is halted";
    case Happening::Asked:
    case Happening::Struck:
      return "is asked";
  }
  return "";
}

std::string later(int ticks) {
  return ticks == 0 ? "in the same tick"
                    : fmt::format("{} later",
                                  counted(static_cast<std::uint64_t>(ticks),
                                          "tick", "ticks"));
}

std::string fault_text(const BehaviorTree& tree, const InjectedFault& fault) {
  return fmt::format("{} {}", quoted(tree, fault.leaf),
                     facts_of(fault.fault.kind).told);
}

// Of the mission without faults.
std::string healthy_text(const WhatIf& result) {
  const Effect& healthy = result.healthy;
  std::vector<std::string> ways;
  if (healthy.succeeds) ways.emplace_back("succeeds");
  if (healthy.fails) ways.emplace_back("fails");
  if (healthy.throws) ways.emplace_back("ends by an exception");
  if (healthy.hangs) ways.emplace_back("never ends");
  if (ways.empty()) ways.emplace_back("does not end");
  std::string text = "Without a fault the mission ";
  for (std::size_t i = 0; i < ways.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == ways.size() ? " or " : ", ") + ways[i];
  }
  return text + (ways.size() == 1 ? " on every run" : "");
}

std::string row_text(const BehaviorTree& tree, const WhatIf& result,
                     const FaultRow& row, std::size_t number) {
  std::string text = fmt::format("{:>4}  {}\n", number, faults_text(tree, row));
  const auto add = [&](const std::string& line) {
    if (!line.empty()) text += fmt::format("      {}\n", line);
  };
  std::string what =
      fmt::format("the mission {}", harm_text(tree, result, row));
  if (row.faults.size() == 1 && row.harm != Harm::Silent && row.notice) {
    what += fmt::format("; noticed: {}", notice_text(tree, row));
  }
  add(what);
  add(recovery_text(tree, row));
  return text;
}

}  // namespace

std::string faults_text(const BehaviorTree& tree, const FaultRow& row) {
  std::string text;
  for (const InjectedFault& fault : row.faults) {
    text += (text.empty() ? "" : ", and ") + fault_text(tree, fault);
  }
  return text;
}

std::string harm_text(const BehaviorTree& tree, const WhatIf& result,
                      const FaultRow& row) {
  const Effect& effect = row.effect;
  if (row.harm == Harm::RuleBreaks) {
    std::string names;
    for (const RuleId& id : effect.broken) {
      names += (names.empty() ? "" : ", ") +
               result.rules[id.file].properties[id.rule].name;
    }
    return fmt::format("breaks {}", names);
  }
  if (row.harm == Harm::LeftOn) {
    return effect.left_on.empty() ? fmt::format("ends while {} still runs",
                                                some(tree, effect.left_running))
                                  : fmt::format("ends with what {} has begun",
                                                some(tree, effect.left_on));
  }
  const bool succeeds =
      row.harm == Harm::Survives && effect.succeeds && !effect.fails;
  return succeeds ? "succeeds all the same"
                  : std::string(facts_of(row.harm).told);
}

std::string notice_text(const BehaviorTree& tree, const FaultRow& row) {
  if (!row.notice) return "nobody";
  return fmt::format("{} {}, {}", quoted(tree, row.notice->node),
                     verb_of(row.notice->what), later(row.notice->ticks));
}

std::string recovery_text(const BehaviorTree& tree, const FaultRow& row) {
  if (!row.recovery) return "";
  const Recovery& recovery = *row.recovery;
  std::string text =
      fmt::format("caught by {}", quoted(tree, recovery.caught_by));
  if (!recovery.through.empty()) {
    text +=
        fmt::format(", which goes on with {}", some(tree, recovery.through));
  }
  if (recovery.is_asked_again) {
    text +=
        fmt::format("; {} is asked again", quoted(tree, row.faults[0].leaf));
  }
  return text;
}

std::string event_text(const WhatIf& result, const TopEvent& event) {
  switch (event.kind) {
    case TopEvent::Kind::Fails:
      return "the mission fails";
    case TopEvent::Kind::CannotSucceed:
      return "the mission cannot succeed";
    case TopEvent::Kind::NeverEnds:
      return "the mission never ends";
    case TopEvent::Kind::Throws:
      return "an exception leaves the tree";
    case TopEvent::Kind::Rule:
      return fmt::format(
          "the rule {} is broken",
          result.rules[event.rule.file].properties[event.rule.rule].name);
  }
  return "";
}

std::string score_text(const Score& score) {
  const auto of = [&](Harm harm) { return score.of_harm(harm); };
  const std::size_t well = of(Harm::Survives);
  const std::size_t reported = of(Harm::Fails) + of(Harm::MayFail);
  std::string text =
      fmt::format("of {} {} are survived or reported ({} and {})",
                  counted(score.total() - of(Harm::NotAsked), "single fault",
                          "single faults"),
                  well + reported, well, reported);
  const std::pair<Harm, std::string_view> worse[] = {
      {Harm::Silent, "end silently"},
      {Harm::NeverEnds, "never end"},
      {Harm::RuleBreaks, "break a rule"},
      {Harm::LeftOn, "leave something on"},
      {Harm::Throws, "leave the tree by an exception"},
      {Harm::Undecided, "are not decided"}};
  for (const auto& [harm, words] : worse) {
    if (of(harm) > 0) text += fmt::format("; {} {}", of(harm), words);
  }
  if (of(Harm::NotAsked) > 0) {
    text += fmt::format("; {} more cannot strike while all else works",
                        of(Harm::NotAsked));
  }
  return text;
}

std::string what_if_text(const BehaviorTree& tree, const WhatIf& result,
                         const TableChoices& choices) {
  std::string text = fmt::format("{}\n\n", healthy_text(result));
  std::size_t number = 0;
  for (std::size_t h = 0; h < kHarms; ++h) {
    const auto harm = static_cast<Harm>(h);
    const auto count = static_cast<std::size_t>(
        std::ranges::count(result.rows, harm, &FaultRow::harm));
    if (count == 0) continue;
    text += fmt::format("{} ({})\n", facts_of(harm).word, count);
    const bool is_told = choices.tells_all || harm < Harm::Survives;
    for (const FaultRow& row : result.rows) {
      if (row.harm != harm) continue;
      ++number;
      if (is_told) text += row_text(tree, result, row, number);
    }
    text += '\n';
  }
  if (!result.pairs.empty()) {
    text += fmt::format("pairs ({})\n", result.pairs.size());
    for (const FaultRow& row : result.pairs) {
      text += row_text(tree, result, row, ++number);
    }
    text += '\n';
  }
  for (const CutSets& cut : result.cut_sets) {
    if (cut.sets.empty()) continue;
    text += fmt::format("{}: {}\n", event_text(result, cut.event),
                        counted(cut.sets.size(), "cut set", "cut sets"));
  }
  return text + score_text(result.score()) + '\n';
}

}  // namespace btcheck
