// SPDX-License-Identifier: MIT
//
// The worst first. Rows that say the same are one entry, with all their
// numbers; of what is survived each leaf has a line.
#include "report/whatif/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "report/text/report.hpp"
#include "report/whatif/groups.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kIndent = 9;  // behind the numbers of rows
constexpr std::size_t kMostPairs = 20;
constexpr std::size_t kMostParts = 12;

class Table {
 public:
  Table(const BehaviorTree& tree, const WhatIf& result,
        const TableChoices& choices)
      : tree_(tree), result_(result), choices_(choices) {}

  std::string take() {
    add(fmt::format("{}: what the mission does when something breaks",
                    tree_.file));
    // Nothing can be told of faults where healthy runs are not known.
    if (result_.healthy.stopped != StopReason::None) {
      tell_limit();
      return std::move(text_);
    }
    add(healthy_text(result_));
    tell_assumptions();
    for (std::size_t h = 0; h < kHarms; ++h) tell_rows(static_cast<Harm>(h));
    tell_pairs();
    tell_cut_sets();
    tell_scores();
    return std::move(text_);
  }

 private:
  // A paragraph.
  void add(const std::string& text, std::size_t indent = 0) {
    text_ += fmt::format("{:{}}{}\n", "", indent,
                         wrapped(text, indent, choices_.width));
  }

  const std::vector<FaultRow>& rows() const { return result_.rows; }

  void tell_assumptions() {
    const auto& possible = result_.possible;
    const std::size_t most = choices_.tells_all ? possible.guessed.size() : 6;
    if (!possible.guessed.empty()) {
      add(fmt::format("Taken for conditions, by their names: {}.",
                      names_in_text(tree_, possible.guessed, most)));
    }
    std::size_t rules = 0;
    for (const PropertyFile& file : result_.rules) {
      rules += file.properties.size();
    }
    if (rules > 0) {
      add(fmt::format("{} without a fault, and {} asked with each.",
                      counted(rules, "rule holds", "rules hold"),
                      rules == 1 ? "is" : "are"));
    }
    if (!result_.broken_rules.empty()) {
      add(fmt::format("Not asked, as {} without a fault: {}.",
                      result_.broken_rules.size() == 1 ? "it does not hold"
                                                       : "they do not hold",
                      fmt::join(result_.broken_rules, ", ")));
    }
    tell_left_out();
  }

  void tell_left_out() {
    const auto& left_out = result_.possible.left_out;
    if (left_out.empty()) return;
    if (!choices_.tells_all) {
      std::vector<NodeId> leaves;
      for (const OmittedFaults& each : left_out) {
        for (const NodeId leaf : each.leaves) {
          if (std::ranges::find(leaves, leaf) == leaves.end()) {
            leaves.push_back(leaf);
          }
        }
      }
      add(
          fmt::format("Faults of {} that would change nothing are left out; -v "
                      "names them.",
                      counted(leaves.size(), "leaf", "leaves")));
      return;
    }
    for (const OmittedFaults& each : left_out) {
      add(fmt::format("Left out, as {}: {} of {}.", each.why,
                      kind_words(each.kinds),
                      names_in_text(tree_, each.leaves, each.leaves.size())));
    }
  }

  // --- Single faults ------------------------------------------------------

  void tell_rows(Harm harm) {
    FaultSets sets(rows().size());
    std::vector<std::string> said(rows().size());
    std::size_t count = 0;
    const bool is_brief = harm == Harm::NotAsked ||
                          (harm == Harm::Survives && !choices_.tells_all);
    for (std::size_t i = 0; i < rows().size(); ++i) {
      if (rows()[i].harm != harm) continue;
      ++count;
      sets[i] = rows()[i].faults;
      said[i] = is_brief ? recovery_text(tree_, rows()[i]) : said_of(rows()[i]);
    }
    if (count == 0) return;
    const auto groups = grouped_singles(sets, said);
    if (harm == Harm::NotAsked) {
      tell_not_asked(groups, count);
      return;
    }
    text_ += '\n';
    add(fmt::format("{} ({}): {}", facts_of(harm).word, count,
                    heading_of(harm)));
    for (const FaultGroup& group : groups) {
      if (is_brief) {
        tell_briefly(group);
      } else {
        tell(group);
      }
    }
  }

  // What has to be the same of rows that are told together.
  std::string said_of(const FaultRow& row) const {
    std::string said = what_of(row) + recovery_text(tree_, row);
    if (row.notice) {
      said += fmt::format(" {} {}", index(row.notice->node),
                          answer_word(row.notice->what));
    }
    return said;
  }

  // What the heading does not say already.
  std::string what_of(const FaultRow& row) const {
    switch (row.harm) {
      case Harm::Silent:
      case Harm::RuleBreaks:
      case Harm::LeftOn:
        return fmt::format("the mission {}", harm_text(tree_, result_, row));
      case Harm::Survives:
        return row.effect.succeeds && !row.effect.fails
                   ? "the mission succeeds all the same"
                   : "";
      default:
        return "";
    }
  }

  void tell(const FaultGroup& group) {
    const FaultRow& row = rows()[group.places[0]];
    begin_entry(ranges_text(group.places, 0),
                subject_of(group) + " " + kinds_text(group.kinds));
    std::vector<std::string> parts;
    const std::string what = what_of(row);
    if (!what.empty()) parts.push_back(what);
    if (row.harm != Harm::Silent) {
      const std::string noticed = noticed_of(group);
      if (!noticed.empty()) parts.push_back(noticed);
    }
    const std::string run = run_of(row);
    if (!run.empty()) parts.push_back(run);
    if (!parts.empty()) detail(fmt::format("{}", fmt::join(parts, "; ")));
    detail(recovery_text(tree_, row));
  }

  std::string subject_of(const FaultGroup& group) const {
    return group.leaves.size() == 1
               ? name_in_text(tree_, group.leaves[0])
               : fmt::format("each of {}", names_in_text(tree_, group.leaves,
                                                         group.leaves.size()));
  }

  std::string noticed_of(const FaultGroup& group) const {
    const FaultRow& row = rows()[group.places[0]];
    if (!row.notice) {
      const bool is_reported =
          row.harm == Harm::Fails || row.harm == Harm::MayFail;
      return is_reported ? "looks like a run without a fault" : "";
    }
    std::string text = fmt::format("noticed: {}", notice_text(tree_, row));
    int most = 0;
    for (const std::size_t place : group.places) {
      const auto& within = rows()[place].within;
      if (!within) return text;
      most = std::max(most, *within);
    }
    if (most > row.notice->ticks) {
      text += fmt::format(
          ", on other runs up to {}",
          counted(static_cast<std::uint64_t>(most), "tick", "ticks"));
    }
    return text;
  }

  // Where it matters: when it strikes, and when the mission is over.
  static std::string run_of(const FaultRow& row) {
    const bool is_told = is_bad(row.harm) || row.harm == Harm::MayFail;
    if (!is_told || row.struck_in == 0) return "";
    if (row.harm == Harm::NeverEnds) {
      return fmt::format("struck in tick {}", row.struck_in);
    }
    return fmt::format("struck in tick {}, over in tick {}", row.struck_in,
                       row.ended_in);
  }

  void tell_briefly(const FaultGroup& group) {
    const FaultRow& row = rows()[group.places[0]];
    std::string text =
        fmt::format("{}: {}", names_in_text(tree_, group.leaves, 6),
                    kind_words(group.kinds));
    const std::string recovery = recovery_text(tree_, row);
    if (!recovery.empty()) text += "; " + recovery;
    begin_entry(ranges_text(group.places, 0), text);
  }

  // A leaf that nobody asks has no fault that strikes: one line for all.
  void tell_not_asked(const std::vector<FaultGroup>& groups,
                      std::size_t count) {
    std::vector<NodeId> leaves;
    std::vector<std::size_t> places;
    for (const FaultGroup& group : groups) {
      for (const NodeId leaf : group.leaves) {
        if (std::ranges::find(leaves, leaf) == leaves.end()) {
          leaves.push_back(leaf);
        }
      }
      places.insert(places.end(), group.places.begin(), group.places.end());
    }
    std::ranges::sort(leaves);
    text_ += '\n';
    add(fmt::format("not-asked ({}): {}", count, heading_of(Harm::NotAsked)));
    const std::size_t most = choices_.tells_all ? leaves.size() : 12;
    begin_entry(ranges_text(places, 0), names_in_text(tree_, leaves, most));
  }

  void begin_entry(const std::string& numbers, const std::string& text) {
    if (numbers.size() + 2 > kIndent) {
      add(numbers, 2);
      detail(text);
      return;
    }
    text_ += fmt::format("{:>{}}  {}\n", numbers, kIndent - 2,
                         wrapped(text, kIndent, choices_.width));
  }
  void detail(const std::string& text) {
    if (text.empty()) return;
    add(text, kIndent);
  }

  // --- Pairs, and what they come to ----------------------------------------

  void tell_pairs() {
    if (result_.order < 2) return;
    text_ += '\n';
    const auto& pairs = result_.pairs;
    const auto open = static_cast<std::size_t>(
        std::ranges::count(pairs, Harm::Undecided, &FaultRow::harm));
    add(fmt::format(
        "pairs ({} of {}, of which {} were searched): what neither fault does "
        "alone",
        pairs.size() - open, grouped(result_.pairs_in_all),
        grouped(result_.pairs_searched)));
    FaultSets sets(pairs.size());
    std::vector<std::string> said(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (pairs[i].harm == Harm::Undecided) continue;
      sets[i] = pairs[i].faults;
      said[i] =
          fmt::format("the mission {}", harm_text(tree_, result_, pairs[i]));
    }
    const auto groups = grouped_pairs(sets, said);
    const std::size_t told = choices_.tells_all
                                 ? groups.size()
                                 : std::min(groups.size(), kMostPairs);
    for (std::size_t i = 0; i < told; ++i) {
      begin_entry(ranges_text(groups[i].places, rows().size()),
                  pair_text(groups[i]));
      detail(said[groups[i].places[0]]);
    }
    std::size_t rest = 0;
    for (std::size_t i = told; i < groups.size(); ++i) {
      rest += groups[i].places.size();
    }
    if (rest > 0) {
      detail(fmt::format("and {} that are no worse",
                         counted(rest, "pair", "pairs")));
    }
    if (open > 0) {
      detail(
          fmt::format("{} not decided", counted(open, "pair is", "pairs are")));
    }
  }

  std::string pair_text(const PairGroup& group) const {
    return fmt::format("{} {}, and {} {}", one_of(group.first),
                       kinds_text(group.first.kinds), one_of(group.second),
                       kinds_text(group.second.kinds));
  }
  std::string one_of(const FaultGroup& group) const {
    return group.leaves.size() == 1
               ? name_in_text(tree_, group.leaves[0])
               : fmt::format("one of {}", names_in_text(tree_, group.leaves,
                                                        group.leaves.size()));
  }

  void tell_cut_sets() {
    bool is_first = true;
    for (const CutSets& cut : result_.cut_sets) {
      if (cut.sets.empty()) continue;
      if (std::exchange(is_first, false)) text_ += '\n';
      std::size_t singles = 0;
      for (const auto& set : cut.sets) singles += set.size() == 1;
      add(fmt::format(
          "{}: {}{}", event_text(result_, cut.event),
          counted(singles, "single point of failure",
                  "single points of failure"),
          singles == cut.sets.size()
              ? ""
              : fmt::format(", and {}", counted(cut.sets.size() - singles,
                                                "pair", "pairs"))));
      const std::vector<std::string> said(cut.sets.size());
      std::string text;
      for (const FaultGroup& group : grouped_singles(cut.sets, said)) {
        text +=
            fmt::format("{}{} ({})", text.empty() ? "" : "; ",
                        names_in_text(tree_, group.leaves, group.leaves.size()),
                        kind_words(group.kinds));
      }
      detail(text);
      tell_pairs_of(cut, said);
    }
  }

  void tell_pairs_of(const CutSets& cut, const std::vector<std::string>& said) {
    const auto groups = grouped_pairs(cut.sets, said);
    constexpr std::size_t kMost = 4;
    const std::size_t told =
        choices_.tells_all ? groups.size() : std::min(groups.size(), kMost);
    std::size_t rest = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (i < told) {
        detail(fmt::format("{} ({}) with {} ({})", one_of(groups[i].first),
                           kind_words(groups[i].first.kinds),
                           one_of(groups[i].second),
                           kind_words(groups[i].second.kinds)));
      } else {
        rest += groups[i].places.size();
      }
    }
    if (rest > 0) {
      detail(fmt::format("and {}", counted(rest, "more pair", "more pairs")));
    }
  }

  void tell_scores() {
    text_ += '\n';
    add(fmt::format("The mission: {}.", score_text(result_.score())));
    std::size_t left = 0;
    std::size_t told = 0;
    for (const NodeId part : scored_parts(tree_)) {
      const Score score = result_.score_below(tree_, part);
      if (score.total() == 0) continue;
      if (told++ >= kMostParts && !choices_.tells_all) {
        ++left;
        continue;
      }
      text_ += fmt::format(
          "  {}\n", wrapped(fmt::format("{}: {}", name_in_text(tree_, part),
                                        score_text(score)),
                            4, choices_.width));
    }
    if (left > 0) {
      add(fmt::format("and {}", counted(left, "more part", "more parts")), 2);
    }
    tell_limit();
  }

  void tell_limit() {
    StopReason stopped = result_.stopped;
    for (const FaultRow& row : rows()) {
      const bool is_open = row.harm == Harm::Undecided;
      if (is_open && stopped == StopReason::None) stopped = row.effect.stopped;
    }
    if (stopped == StopReason::None) return;
    SearchProgress progress;
    progress.states = result_.healthy.states;
    for (const FaultRow& row : rows()) progress.states += row.effect.states;
    for (const FaultRow& row : result_.pairs) {
      progress.states += row.effect.states;
    }
    text_ += '\n';
    add(fmt::format("UNDECIDED {}", stop_text(stopped, progress)));
  }

  const BehaviorTree& tree_;
  const WhatIf& result_;
  const TableChoices& choices_;
  std::string text_;
};

}  // namespace

std::string what_if_text(const BehaviorTree& tree, const WhatIf& result,
                         const TableChoices& choices) {
  return Table(tree, result, choices).take();
}

}  // namespace btcheck
