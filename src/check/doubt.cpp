// SPDX-License-Identifier: MIT
//
// A state variable of an entry stands for all values that the engine may have
// there, sometimes for more. A rule about all runs that holds does so in the
// engine, too. What a run shows is asked of the run (real_values.hpp); what
// holds because some run exists cannot be asked, and needs exact values.
#include "check/doubt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "check/real_values.hpp"
#include "model/btcpp/entry_programs.hpp"

namespace btcheck {
namespace {

struct Doubt {
  std::set<std::size_t> groups;
  std::string words;
};

class Doubts {
 public:
  Doubts(const BehaviorTree& tree, const Network& network)
      : tree_(tree), network_(network) {}

  std::optional<Doubt> of(const std::optional<Run>& run) const {
    if (!run) return std::nullopt;
    const auto refuted = refutation_of(tree_, network_, *run);
    if (!refuted) return std::nullopt;
    Doubt doubt{groups_of(tree_, refuted->program), refuted->words};
    const std::string reasons = rough_words(tree_, doubt.groups);
    if (!reasons.empty()) doubt.words += "; " + reasons;
    return doubt;
  }

  std::optional<Doubt> of_branching() const {
    if (!has_rough_entries(tree_)) return std::nullopt;
    Doubt doubt{rough_groups(tree_), {}};
    doubt.words = rough_words(tree_, doubt.groups);
    return doubt;
  }

  std::optional<Doubt> of(const PropertyVerdict& verdict) const {
    if (verdict.verdict == Verdict::Undecided) return std::nullopt;
    if (verdict.property->form == PropertyForm::Branching) {
      return of_branching();
    }
    return of(verdict.run);
  }

  std::optional<Doubt> of(const TreeReport& report) const {
    const bool is_promise = report.question == TreeQuestion::CanAlwaysEnd ||
                            report.question == TreeQuestion::CanAlwaysSucceed;
    if (is_promise && report.verdict != Verdict::Undecided) {
      return of_branching();
    }
    return of(report.run);
  }

 private:
  const BehaviorTree& tree_;
  const Network& network_;
};

enum class Then : std::uint8_t { Keep, Withdraw };

// Calls `see` with the doubt there is about an answer of the default report,
// if any; a run takes much room, so nothing is copied.
template <class Report, class See>
void for_each_doubt(const Doubts& doubts, Report& report, Then then, See see) {
  const auto ask = [&](const auto& answer) {
    const auto doubt = doubts.of(answer);
    if (doubt) see(*doubt);
    return doubt && then == Then::Withdraw;
  };
  for (auto& answer : report.tree) {
    if (!ask(answer)) continue;
    if constexpr (!std::is_const_v<Report>) {
      answer.verdict = Verdict::Undecided;
      answer.run.reset();
    }
  }
  for (auto& node : report.nodes) {
    for (auto& answer : node.answers) {
      if (!ask(answer.run)) continue;
      if constexpr (!std::is_const_v<Report>) answer = {};
    }
  }
  const auto is_doubtful = [&](const auto& found) { return ask(found.run); };
  if constexpr (std::is_const_v<Report>) {
    for (const auto& found : report.stale_guards) is_doubtful(found);
    for (const auto& found : report.left_running) is_doubtful(found);
  } else {
    std::erase_if(report.stale_guards, is_doubtful);
    std::erase_if(report.left_running, is_doubtful);
  }
}

bool has_programs(const CheckResult& result) {
  return result.tree && result.tree->programs &&
         !result.tree->programs->programs.empty();
}

}  // namespace

std::set<std::size_t> groups_in_doubt(const CheckResult& result) {
  std::set<std::size_t> groups;
  if (!has_programs(result)) return groups;
  const auto take = [&](const Doubt& doubt) {
    groups.insert(doubt.groups.begin(), doubt.groups.end());
  };
  for (const CheckedFile& file : result.files) {
    const Doubts doubts(*result.tree, *file.network);
    for (const PropertyVerdict& verdict : file.verdicts) {
      if (const auto doubt = doubts.of(verdict)) take(*doubt);
    }
    if (!file.defaults) continue;
    for_each_doubt(doubts, *file.defaults, Then::Keep, take);
  }
  return groups;
}

bool look_closer(const BehaviorTree& tree, const std::set<std::size_t>& groups,
                 btcpp::ScriptDetail& detail) {
  bool is_closer = false;
  for (const btcpp::ProgramEntry& entry : tree.programs->entries) {
    if (!groups.contains(entry.group) || entry.is_foreign) continue;
    int& level = detail.levels[{entry.subtree, entry.key}];
    if (level == btcpp::ScriptDetail::kMostLevels) continue;
    ++level;
    is_closer = true;
  }
  return is_closer;
}

void withdraw_doubtful(CheckResult& result) {
  if (!has_programs(result)) return;
  for (CheckedFile& file : result.files) {
    const Doubts doubts(*result.tree, *file.network);
    for (PropertyVerdict& verdict : file.verdicts) {
      const auto doubt = doubts.of(verdict);
      if (!doubt) continue;
      verdict.verdict = Verdict::Undecided;
      verdict.stopped = StopReason::OpenEntries;
      verdict.open = doubt->words;
      verdict.run.reset();
      verdict.shown_at.reset();
      verdict.watched.clear();
      verdict.unshown.clear();
    }
    if (!file.defaults) continue;
    DefaultReport& report = *file.defaults;
    for_each_doubt(doubts, report, Then::Withdraw, [&](const Doubt& doubt) {
      report.stopped = StopReason::OpenEntries;
      if (report.open.empty()) report.open = doubt.words;
    });
  }
}

}  // namespace btcheck
