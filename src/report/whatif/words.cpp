// SPDX-License-Identifier: MIT
#include "report/whatif/words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/tree/node_types.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostNames = 3;

std::string later(int ticks) {
  return ticks == 0 ? "in the same tick"
                    : fmt::format("{} later",
                                  counted(static_cast<std::uint64_t>(ticks),
                                          "tick", "ticks"));
}

std::string fault_text(const BehaviorTree& tree, const InjectedFault& fault) {
  return fmt::format("{} {}", name_in_text(tree, fault.leaf),
                     facts_of(fault.fault.kind).told);
}

std::string_view first_word(std::string_view text) {
  return text.substr(0, text.find(' '));
}

// "a", "a or b", "a, b, or c".
std::string alternatives(const std::vector<std::string_view>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_last = i + 1 == words.size();
    if (i > 0) text += words.size() == 2 ? " " : ", ";
    if (i > 0 && is_last) text += "or ";
    text += words[i];
  }
  return text;
}

std::string lost_text(const BehaviorTree& tree, const FaultRow& row) {
  const std::string leaf = name_in_text(tree, row.faults[0].leaf);
  switch (row.faults[0].fault.kind) {
    case FaultKind::WritesNothing:
      return fmt::format("what {} should write was not written", leaf);
    case FaultKind::WritesOther:
      return fmt::format("what {} writes was wrong", leaf);
    case FaultKind::Succeeds:
    case FaultKind::Inverted:
    case FaultKind::FlipsOnce:
      return fmt::format("what {} said was wrong", leaf);
    default:
      return fmt::format("what {} is for was not done", leaf);
  }
}

}  // namespace

std::string name_in_text(const BehaviorTree& tree, NodeId node) {
  return fmt::format("`{}`", short_name(tree, node));
}

std::string names_in_text(const BehaviorTree& tree,
                          const std::vector<NodeId>& nodes, std::size_t most) {
  // One more takes no more room than to count it.
  const std::size_t told =
      nodes.size() <= most + 1 ? nodes.size() : std::min(most, nodes.size());
  std::string text;
  for (std::size_t i = 0; i < told; ++i) {
    const bool is_last = i + 1 == nodes.size();
    text += i == 0 ? "" : is_last ? " and " : ", ";
    text += name_in_text(tree, nodes[i]);
  }
  if (told == nodes.size()) return text;
  return text + fmt::format(" and {} more", nodes.size() - told);
}

std::string kinds_text(std::span<const FaultKind> kinds) {
  std::vector<std::string_view> words;
  std::string_view verb;
  for (const FaultKind kind : kinds) {
    std::string_view told = facts_of(kind).told;
    const std::string_view first = first_word(told);
    // "fails once", behind "fails whenever it is asked".
    if (first == verb && told.size() > first.size()) {
      told.remove_prefix(first.size() + 1);
    }
    verb = first;
    words.push_back(told);
  }
  return alternatives(words);
}

std::string kind_words(std::span<const FaultKind> kinds) {
  std::string text;
  for (const FaultKind kind : kinds) {
    text += text.empty() ? "" : ", ";
    text += facts_of(kind).word;
  }
  return text;
}

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
  switch (row.harm) {
    case Harm::Silent:
      return fmt::format("succeeds, {}, and nobody notices",
                         lost_text(tree, row));
    case Harm::RuleBreaks:
      return fmt::format("breaks {}",
                         fmt::join(broken_rules(result, effect), ", "));
    case Harm::LeftOn:
      return effect.left_on.empty()
                 ? fmt::format(
                       "ends while {} still runs",
                       names_in_text(tree, effect.left_running, kMostNames))
                 : fmt::format("ends, and what {} has begun is not ended",
                               names_in_text(tree, effect.left_on, kMostNames));
    case Harm::NotAsked:
      return "goes on without asking it";
    case Harm::Survives:
      if (effect.succeeds && !effect.fails) return "succeeds all the same";
      break;
    default:
      break;
  }
  return std::string(facts_of(row.harm).told);
}

std::string notice_text(const BehaviorTree& tree, const FaultRow& row) {
  if (!row.notice) return "nobody";
  return fmt::format("{} {}, {}", name_in_text(tree, row.notice->node),
                     does(row.notice->what), later(row.notice->ticks));
}

std::string_view does(Happening what) {
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

std::string_view answer_word(Happening what) {
  switch (what) {
    case Happening::Success:
      return "success";
    case Happening::Failure:
      return "failure";
    case Happening::Running:
      return "running";
    case Happening::Skipped:
      return "skipped";
    case Happening::Halted:
      return "halted";
    case Happening::Asked:
      return "asked";
    case Happening::Struck:
      return "struck";
  }
  return "";
}

std::string recovery_text(const BehaviorTree& tree, const FaultRow& row) {
  if (!row.recovery) return "";
  const Recovery& recovery = *row.recovery;
  std::string text =
      fmt::format("caught by {}", name_in_text(tree, recovery.caught_by));
  if (!recovery.through.empty()) {
    text += fmt::format(", which goes on with {}",
                        names_in_text(tree, recovery.through, kMostNames));
  }
  if (recovery.is_asked_again) {
    text += fmt::format("; {} is asked again",
                        name_in_text(tree, row.faults[0].leaf));
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

std::string_view heading_of(Harm harm) {
  switch (harm) {
    case Harm::Silent:
      return "the mission succeeds without it, and nobody notices";
    case Harm::NeverEnds:
      return "the mission may go on without an end";
    case Harm::RuleBreaks:
      return "a rule is broken";
    case Harm::LeftOn:
      return "the mission ends and leaves something running, or on";
    case Harm::Throws:
      return "an exception leaves the tree";
    case Harm::Fails:
      return "the mission cannot succeed any more, and fails";
    case Harm::MayFail:
      return "the mission can fail, and need not";
    case Harm::Survives:
      return "the mission ends as it does without the fault";
    case Harm::NotAsked:
      return "never asked while all else works";
    case Harm::Undecided:
      return "UNDECIDED: a limit was reached";
  }
  return "";
}

std::vector<std::string_view> outcomes_of(const Effect& effect) {
  std::vector<std::string_view> words;
  if (effect.succeeds) words.emplace_back("success");
  if (effect.fails) words.emplace_back("failure");
  if (effect.throws) words.emplace_back("exception");
  if (effect.hangs) words.emplace_back("no-end");
  return words;
}

std::vector<std::string> broken_rules(const WhatIf& result,
                                      const Effect& effect) {
  std::vector<std::string> names;
  for (const RuleId& id : effect.broken) {
    names.push_back(result.rules[id.file].properties[id.rule].name);
  }
  return names;
}

std::string healthy_text(const WhatIf& result) {
  const Effect& healthy = result.healthy;
  std::vector<std::string_view> ways;
  if (healthy.succeeds) ways.emplace_back("succeeds");
  if (healthy.fails) ways.emplace_back("fails");
  if (healthy.throws) ways.emplace_back("ends by an exception");
  if (healthy.hangs) ways.emplace_back("never ends");
  const std::string text = ways.empty() ? "does not end" : alternatives(ways);
  const std::string_view others =
      result.choices.others == Others::Work
          ? "All other leaves do what they are for: actions succeed, before a "
            "Timeout above them is over; conditions answer either way."
          : "All other leaves do whatever their contracts allow.";
  return fmt::format("Without a fault the mission {}{}. {}", text,
                     ways.size() == 1 ? " on every run" : "", others);
}

std::string score_text(const Score& score) {
  const auto of = [&](Harm harm) { return score.of_harm(harm); };
  const std::size_t well = of(Harm::Survives);
  const std::size_t reported = of(Harm::Fails) + of(Harm::MayFail);
  const std::size_t asked = score.total() - of(Harm::NotAsked);
  if (asked == 0) {
    return score.total() == 0
               ? "no fault is possible"
               : fmt::format("none of {} can strike while all else works",
                             counted(score.total(), "fault", "faults"));
  }
  std::string text = fmt::format(
      "of {} {} {} survived or reported ({} and {})",
      counted(asked, "single fault", "single faults"), well + reported,
      well + reported == 1 ? "is" : "are", well, reported);
  struct Worse {
    Harm harm;
    std::string_view one;
    std::string_view many;
  };
  constexpr Worse kWorse[] = {
      {Harm::Silent, "ends silently", "end silently"},
      {Harm::NeverEnds, "never ends", "never end"},
      {Harm::RuleBreaks, "breaks a rule", "break a rule"},
      {Harm::LeftOn, "leaves something on", "leave something on"},
      {Harm::Throws, "leaves the tree by an exception",
       "leave the tree by an exception"},
      {Harm::Undecided, "is not decided", "are not decided"}};
  for (const auto& [harm, one, many] : kWorse) {
    if (of(harm) > 0) {
      text += fmt::format("; {} {}", of(harm), of(harm) == 1 ? one : many);
    }
  }
  if (of(Harm::NotAsked) > 0) {
    text += fmt::format("; {} more cannot strike while all else works",
                        of(Harm::NotAsked));
  }
  return text;
}

std::vector<NodeId> scored_parts(const BehaviorTree& tree) {
  std::vector<NodeId> parts;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (tree.nodes[n].type == NodeType::SubTree) parts.push_back(NodeId{n});
  }
  if (!parts.empty()) return parts;
  for (NodeId at : tree.roots) {
    while (tree.node(at).children.size() == 1) at = tree.node(at).children[0];
    const auto& children = tree.node(at).children;
    parts.insert(parts.end(), children.begin(), children.end());
  }
  return parts;
}

ExitCode exit_code_of(const WhatIf& result) {
  if (!result.error.empty()) return ExitCode::Internal;
  const bool has_bad = std::ranges::any_of(
      result.rows, [](const FaultRow& row) { return is_bad(row.harm); });
  if (has_bad) return ExitCode::Missed;
  const bool is_open = std::ranges::any_of(
      result.rows, [](const auto& row) { return row.harm == Harm::Undecided; });
  const bool is_whole = result.stopped == StopReason::None && !is_open;
  return is_whole ? ExitCode::Met : ExitCode::Undecided;
}

}  // namespace btcheck
