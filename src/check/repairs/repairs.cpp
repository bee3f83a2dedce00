// SPDX-License-Identifier: MIT
//
// A repair is not believed but tried: the edits are made in the texts, the tree
// is read, lowered and searched again like any other, with the same options and
// the same rules. What it costs is bounded in states, so that the same input
// has the same repairs on a slow machine.
#include "check/repairs/repairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "check/repairs/kept_guards.hpp"
#include "check/repairs/problems.hpp"
#include "model/edits/edited_files.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

constexpr int kMostTrials = 16;
constexpr std::uint64_t kLeastBudget = 20'000;
constexpr std::uint64_t kMostBudget = 200'000;

// Ends a search before the limits of the whole check would.
class SpareTime : public SearchMonitor {
 public:
  explicit SpareTime(SearchMonitor* whole) : whole_(whole) {}

  StopReason observe(const SearchProgress& progress) override {
    if (whole_ == nullptr) return StopReason::None;
    return whole_->has_spare() ? whole_->observe(progress)
                               : StopReason::Timeout;
  }
  bool may_tell() override { return whole_ == nullptr || whole_->has_spare(); }
  bool has_spare() override { return may_tell(); }

 private:
  SearchMonitor* whole_;
};

// The files of the tree beside its own.
auto others_of(auto& reading) {
  return std::array{&reading.included, &reading.neighbours};
}

// The tree with its files as they were edited.
TreeInput input_of(const TreeInput& tree, const EditedFiles& files) {
  TreeInput edited = tree;
  edited.text = files.files().front().text;
  auto file = files.files().begin();
  for (auto* others : others_of(edited.reading)) {
    for (InputFile& each : *others) each.text = (++file)->text;
  }
  return edited;
}

EditedFiles files_of(const TreeInput& tree) {
  std::vector<InputFile> files = {{tree.name, tree.text}};
  for (const auto* others : others_of(tree.reading)) {
    for (const InputFile& each : *others) {
      files.push_back({each.name, each.text});
    }
  }
  return EditedFiles(std::move(files));
}

CheckedRepair told(const EditedFiles& edited) {
  CheckedRepair repair;
  for (std::size_t i = 0; i < edited.files().size(); ++i) {
    const auto& [name, text] = edited.files()[i];
    const std::string& before = edited.originals()[i].text;
    if (before != text) {
      repair.files.push_back(changed_lines(name, before, text));
    }
  }
  return repair;
}

class Repairing {
 public:
  Repairing(const TreeInput& tree, const std::vector<InputFile>& properties,
            const CheckOptions& options, CheckResult& result)
      : tree_(tree),
        properties_(properties),
        options_(options),
        result_(result),
        problems_(problems_of(result)),
        spare_(options.limits.monitor),
        states_(most_states(result)),
        budget_(std::clamp(2 * states_, kLeastBudget, kMostBudget)) {}

  void run() {
    std::size_t asked = 0;
    for_all([&](auto& found, const Problem& problem) {
      if (is_asked(found) && ++asked > kShownQuestions) return;
      mend(problem, nodes_of(found), found.repairs, found.repair);
    });
    // What has no repair of its own may be mended by that of another.
    for_all([&](auto& found, const Problem& problem) {
      if (!found.repair) found.repair = repair_of_other(problem);
    });
  }

 private:
  // A repair that holds, and what else it mends.
  struct Mended {
    Problem problem;
    CheckedRepair repair;
    std::vector<Problem> gone;
  };

  // Calls visit(what was found, its problem) for diagnostics and findings.
  template <class Visit>
  void for_all(const Visit& visit) {
    for (Diagnostic& each : result_.diagnostics) visit(each, problem_of(each));
    for (CheckedFile& file : result_.files) {
      for (TreeFinding& each : file.findings) {
        visit(each, problem_of(each, *result_.tree));
      }
    }
  }

  static bool is_asked(const Diagnostic&) { return false; }
  static bool is_asked(const TreeFinding& finding) {
    return is_question(finding);
  }

  // Those that a finding speaks of.
  static std::vector<NodeId> nodes_of(const Diagnostic&) { return {}; }
  static std::vector<NodeId> nodes_of(const TreeFinding& finding) {
    std::vector<NodeId> nodes = finding.others;
    nodes.push_back(finding.node);
    return nodes;
  }

  void mend(const Problem& problem, const std::vector<NodeId>& about,
            const std::vector<Repair>& repairs,
            std::optional<CheckedRepair>& to) {
    for (const Repair& each : repairs) {
      if (!try_out(problem, about, each)) continue;
      to = mended_.back().repair;
      return;
    }
  }

  bool try_out(const Problem& problem, const std::vector<NodeId>& about,
               const Repair& repair) {
    EditedFiles edited = files_of(tree_);
    if (!edited.apply(repair)) return false;
    CheckedRepair made = told(edited);
    if (made.files.empty() || !may_search()) return false;
    const CheckResult after =
        check(input_of(tree_, edited), properties_, narrow_options());
    ++trials_;
    budget_ -=
        std::min(budget_, std::max(most_states(after), std::uint64_t{1}));
    if (!is_complete(after) || breaks_something(result_, after) ||
        !keeps_guards(*result_.tree, *after.tree, edited, problem.code,
                      about)) {
      return false;
    }
    const auto gone = gone_after(after, edited);
    if (!gone) return false;
    const bool is_gone = std::ranges::any_of(
        *gone, [&](const Problem& each) { return each.is_at(problem); });
    if (!is_gone) return false;
    mended_.push_back({problem, std::move(made), *gone});
    return true;
  }

  bool may_search() {
    return trials_ < kMostTrials && budget_ > 0 && spare_.may_tell();
  }

  CheckOptions narrow_options() {
    CheckOptions narrow = options_;
    narrow.wants_shortest = false;
    narrow.earlier = &result_;
    Limits& limits = narrow.limits;
    limits.monitor = &spare_;
    limits.max_states = std::min(limits.max_states, budget_);
    limits.max_bytes /= 2;
    return narrow;
  }

  // What the edits have mended; nothing where they bring up something else.
  std::optional<std::vector<Problem>> gone_after(
      const CheckResult& after, const EditedFiles& edited) const {
    const std::vector<Problem> left = problems_of(after);
    std::vector<bool> is_known(left.size());
    std::vector<Problem> gone;
    for (const Problem& before : problems_) {
      const auto now = moved(before, edited);
      bool is_left = false;
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (!now || !now->is_at(left[i])) continue;
        is_left = is_known[i] = true;
      }
      if (!is_left) gone.push_back(before);
    }
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (!is_known[i] && !left[i].is_note) return std::nullopt;
    }
    return gone;
  }

  std::optional<CheckedRepair> repair_of_other(const Problem& problem) const {
    if (problem.is_note) return std::nullopt;
    for (const Mended& mended : mended_) {
      const bool is_gone = std::ranges::any_of(
          mended.gone,
          [&](const Problem& each) { return each.is_at(problem); });
      if (!is_gone) continue;
      CheckedRepair shared = mended.repair;
      shared.comes_from = fmt::format("{} in line {}", mended.problem.code,
                                      mended.problem.place.line);
      return shared;
    }
    return std::nullopt;
  }

  const TreeInput& tree_;
  const std::vector<InputFile>& properties_;
  const CheckOptions& options_;
  CheckResult& result_;
  const std::vector<Problem> problems_;
  SpareTime spare_;
  std::uint64_t states_;
  std::uint64_t budget_;  // states that may still be searched
  int trials_ = 0;
  std::vector<Mended> mended_;
};

}  // namespace

CheckResult check_and_repair(const TreeInput& tree,
                             const std::vector<InputFile>& properties,
                             const CheckOptions& options) {
  CheckResult result = check(tree, properties, options);
  add_repairs(tree, properties, options, result);
  return result;
}

void add_repairs(const TreeInput& tree,
                 const std::vector<InputFile>& properties,
                 const CheckOptions& options, CheckResult& result) {
  if (!options.tries_repairs || !is_complete(result)) return;
  try {
    Repairing(tree, properties, options, result).run();
  } catch (const BudgetSpent&) {
    // Then what was found is told with fewer repairs.
  }
}

}  // namespace btcheck
