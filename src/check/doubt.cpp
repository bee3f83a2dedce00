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
#include "check/replay/replay.hpp"
#include "model/btcpp/tree/entry_programs.hpp"

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
    return because(groups_of(tree_, refuted->program), refuted->words);
  }

  std::optional<Doubt> of(const std::optional<KeptRun>& run) const {
    return run ? of(std::optional(run->told())) : std::nullopt;
  }

  std::optional<Doubt> of_branching() const {
    Doubt doubt{rough_groups(tree_), {}};
    if (doubt.groups.empty()) return std::nullopt;
    doubt.words = rough_words(tree_, doubt.groups);
    return doubt;
  }

  std::optional<Doubt> of(const PropertyVerdict& verdict) const {
    if (verdict.verdict == Verdict::Undecided) return std::nullopt;
    const bool is_branching = verdict.property->form == PropertyForm::Branching;
    auto doubt = is_branching ? of_branching() : of(verdict.run);
    for (const OpenComparison& comparison : verdict.comparisons) {
      if (doubt) break;
      if (!is_branching && is_known_along(verdict.run, comparison)) continue;
      doubt = because(groups_with(comparison), comparison.refusal.message);
    }
    return doubt;
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
  Doubt because(std::set<std::size_t> groups, std::string words) const {
    const std::string reasons = rough_words(tree_, groups);
    if (!reasons.empty()) words += "; " + reasons;
    return {std::move(groups), std::move(words)};
  }

  std::set<std::size_t> groups_with(const OpenComparison& comparison) const {
    std::set<std::size_t> groups;
    for (const btcpp::ProgramEntry& entry : tree_.programs->entries) {
      const auto& about = comparison.entries;
      if (entry.variable && std::find(about.begin(), about.end(),
                                      *entry.variable) != about.end()) {
        groups.insert(entry.group);
      }
    }
    return groups;
  }

  // Only of what a run shows: without one, it is about all states.
  bool is_known_along(const std::optional<Run>& run,
                      const OpenComparison& comparison) const {
    if (!run) return false;
    const NetworkInterpreter interpreter(network_);
    for (std::size_t i = 0; i < run->state_count(); ++i) {
      if (interpreter.is_true(comparison.where, run->state(i))) return false;
    }
    return true;
  }

  const BehaviorTree& tree_;
  const Network& network_;
};

// Calls `see` with the doubt there is about an answer of the default report, if
// any, which is then withdrawn unless the report is const; a run takes much
// room, so nothing is copied.
template <class Report, class See>
void for_each_doubt(const Doubts& doubts, Report& report, See see) {
  const auto ask = [&](const auto& answer) {
    const auto doubt = doubts.of(answer);
    if (doubt) see(*doubt);
    return doubt.has_value();
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
    if (const auto doubt = doubts.of(file.fault)) take(*doubt);
    if (!file.defaults) continue;
    for_each_doubt(doubts, std::as_const(*file.defaults), take);
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
    if (const auto doubt = doubts.of(file.fault)) {
      file.has_faults = false;
      file.fault.reset();
      file.open_fault = doubt->words;
    }
    if (!file.defaults) continue;
    DefaultReport& report = *file.defaults;
    for_each_doubt(doubts, report, [&](const Doubt& doubt) {
      report.stopped = StopReason::OpenEntries;
      if (report.open.empty()) report.open = doubt.words;
    });
  }
}

}  // namespace btcheck
